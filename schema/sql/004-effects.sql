-- The store, version 4: a gas need not have an e. Its law of restitution may give every collision one
-- of its own (viscoelastic); e, gamma_ratio and tau_c are then NULL, and equal among realizations.
--
-- SQLite can change a constraint in no other way than by its text (lang_altertable.html); the rows
-- stay as they are.

PRAGMA writable_schema = ON;

UPDATE sqlite_schema
SET sql = replace(sql, 'REAL NOT NULL CHECK (e BETWEEN 0 AND 1), ', 'REAL CHECK (e BETWEEN 0 AND 1), ')
WHERE type = 'table' AND name = 'jobs';

PRAGMA writable_schema = RESET;

-- What selects by effects, without JSON: one row an effect and key, e.g. (7, 'shuffle', 'every', 1.0).
CREATE VIEW job_effects AS
SELECT job_id, effect.key AS effect, parameter.key AS parameter, parameter.value AS value
FROM jobs, json_each(jobs.effects) AS effect, json_each(effect.value) AS parameter;
