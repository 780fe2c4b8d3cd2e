-- The store, version 20: samples and snapshots at moments of their own, in tau or in time.

-- Beside the samples of sample_every; NULL: none. {"tau":[0.5,2]}, {"tau":{"from":0.1,"log":20}} (so
-- many a decade), {"time":...}, or both. What is sampled in time is in profiles: names end in
-- _at_time, tau is 0, x the time.
ALTER TABLE jobs ADD COLUMN
  sample_at TEXT CHECK (json_type(sample_at) = 'object');
ALTER TABLE jobs ADD COLUMN
  snapshots_at TEXT CHECK (json_type(snapshots_at) = 'object');  -- the same form; NULL: none

-- The whole gas at a moment, to be looked at (campaign export); no job goes on from it. Written once.
CREATE TABLE snapshots (
  job_id     INTEGER NOT NULL REFERENCES jobs (job_id),
  time       REAL NOT NULL,      -- of the gas [sigma sqrt(m/E(0))]
  tau        REAL NOT NULL,      -- that of the moment; of a moment in time 2 collisions / N
  collisions INTEGER NOT NULL,   -- pair collisions until then
  bytes      INTEGER NOT NULL,   -- of all chunks together
  checksum   INTEGER NOT NULL,   -- FNV-1a, 64 bits, of all bytes in the order of the chunks
  PRIMARY KEY (job_id, time)
) STRICT, WITHOUT ROWID;

CREATE TABLE snapshot_chunks (
  job_id   INTEGER NOT NULL,
  time     REAL NOT NULL,
  position INTEGER NOT NULL,     -- 0, 1, 2, ...
  bytes    BLOB NOT NULL,        -- at most 16 MiB
  PRIMARY KEY (job_id, time, position),
  FOREIGN KEY (job_id, time) REFERENCES snapshots (job_id, time)
) STRICT;

-- Jobs of before have none: theirs is the digest of no rows (017-digests.sql).
ALTER TABLE digests ADD COLUMN
  snapshots INTEGER;
UPDATE digests SET snapshots = 1238446449531573158;
