-- The store, version 13: a campaign on several machines. Its pending jobs are lent to shards, stores
-- of their own that are run elsewhere, and what was computed comes home row by row.

-- A job that a shard holds is neither pending nor running here.
UPDATE job_status SET position = -position WHERE position >= 2;
UPDATE job_status SET position = 1 - position WHERE position < 0;
INSERT INTO job_status (position, status, meaning) VALUES
  (2, 'lent', 'a shard holds it; merge or recall brings it home');

-- One row: which campaign this store belongs to.
CREATE TABLE campaign (
  campaign_id TEXT NOT NULL,  -- 32 hexadecimal digits, drawn at random; the same in all its shards
  shard       TEXT            -- the name of this shard; NULL in the store that lends
) STRICT;

INSERT INTO campaign (campaign_id, shard) VALUES (lower(hex(randomblob(16))), NULL);

-- The shards that this store has lent jobs to.
CREATE TABLE shards (
  shard    TEXT PRIMARY KEY,  -- shard-001, ...
  path     TEXT NOT NULL,     -- where it was written
  lent     TEXT NOT NULL,     -- UTC, like the following
  merged   TEXT,              -- when it was last merged; NULL: never
  returned TEXT               -- when it had ended all its jobs, or was recalled; NULL: it is out
) STRICT;

-- The jobs of each shard, with the CPU time that it has spent on them so far as merges have shown.
CREATE TABLE loans (
  shard              TEXT NOT NULL REFERENCES shards (shard),
  job_id             INTEGER NOT NULL REFERENCES jobs (job_id),
  cpu_seconds_before REAL NOT NULL,            -- of the job when it was lent [s]
  cpu_seconds_spent  REAL NOT NULL DEFAULT 0,  -- by this shard [s]
  PRIMARY KEY (shard, job_id)
) STRICT, WITHOUT ROWID;

CREATE INDEX loans_by_job ON loans (job_id);
