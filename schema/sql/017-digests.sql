-- The store, version 17: digests, which find any bit that has flipped in a row since it was written.
--
-- A word is mixed as in SplitMix64 (Steele, Lea and Flood, OOPSLA 2014):
--   mix(z): z = (z xor z >> 30) * 0xbf58476d1ce4e5b9, z = (z xor z >> 27) * 0x94d049bb133111eb,
--           z xor z >> 31, all in 64 bits
-- The digest of a row begins with FNV-1a (as in checkpoints) of its table's name. Each column whose
-- value is not the column's default, in the table's order and without job_id (jobs have it), turns h
-- into mix(h xor FNV-1a(name of the column)), then into mix(h + type), then into mix(h xor value):
-- type is 0 for NULL, 1 for an integer, 2 for a real, 3 for a text, 4 for a BLOB, value its 64 bits,
-- a real's with 0 for -0, and FNV-1a of the bytes of a text or a BLOB. So a column that a later version
-- adds changes no digest.
-- The digest of several rows is that of each, with xor between them, and with FNV-1a of the table's
-- name: it does not depend on their order, and further rows cost their own digests alone.
-- NULL: there is none, since a program of an older version wrote these rows.

-- One row per job, written in the transaction that writes what it is of. `campaign verify` compares,
-- and so does whatever averages.
CREATE TABLE digests (
  job_id      INTEGER PRIMARY KEY REFERENCES jobs (job_id),
  jobs        INTEGER,  -- of its row in this table
  samples     INTEGER,  -- of all its rows in the table of this name, and so on
  profiles    INTEGER,
  fields      INTEGER,
  results     INTEGER,
  invariants  INTEGER,
  checkpoints INTEGER,  -- which has a checksum of the state's own bytes
  loans       INTEGER
) STRICT;

-- The same of tables that are not of one job each, as a whole.
CREATE TABLE table_digests (
  name   TEXT PRIMARY KEY,  -- campaign, job_status, shards, targets, target_predictions
  digest INTEGER NOT NULL
) STRICT;

-- Rows that are there have none, as nothing says that they are as they were written.
INSERT INTO digests (job_id) SELECT job_id FROM jobs;
