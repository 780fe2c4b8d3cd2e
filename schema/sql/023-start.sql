-- The store, after version 20: what a job starts from, where that is not the usual equilibrated gas.

-- "crystal" (with its quotes), {"shear wave":{"amplitude":0.5,"waves":1}},
-- {"two temperatures":{"ratio":4}}, {"file":"0123456789abcdef"}: the digest of the state; NULL:
-- uniform. Of an equilibration: there is nothing to run, and its checkpoint is that state.
ALTER TABLE jobs ADD COLUMN
  start TEXT CHECK (json_type(start) IN ('text', 'object'));

-- An equilibration of a crystal or of a given state takes no collisions.
PRAGMA writable_schema = ON;

UPDATE sqlite_schema
SET sql = replace(sql, 'CHECK (equilibrate > 0)', 'CHECK (equilibrate >= 0)')
WHERE type = 'table' AND name = 'jobs';

PRAGMA writable_schema = RESET;
