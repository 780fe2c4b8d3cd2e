-- The store, version 8: the engine computes in double precision alone (engine/decisions/
-- double-precision.md), so that a precision is no part of what a job is.
--
-- A job's identity and a target's series lose it, and so do the table and its views. Equal jobs stay
-- equal: a grid that is planned again adds nothing.

PRAGMA defer_foreign_keys = ON;  -- predictions refer to targets by their series

UPDATE jobs SET identity = replace(identity, ',"precision":"double"', '');
UPDATE targets SET series = replace(series, ',"precision":"double"', '');
UPDATE target_predictions SET series = replace(series, ',"precision":"double"', '');

PRAGMA writable_schema = ON;

UPDATE sqlite_schema SET sql = replace(sql, ' precision,', '') WHERE type = 'view';

PRAGMA writable_schema = RESET;

ALTER TABLE jobs DROP COLUMN precision;
