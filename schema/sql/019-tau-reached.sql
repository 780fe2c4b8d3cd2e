-- The store, version 19: a sample and its job have no column in common but job_id.
--
-- How far a job is, is jobs.tau_reached; tau is that of a sample alone, so that
--   SELECT ... FROM samples JOIN jobs USING (job_id) WHERE tau = 20
-- means what it says. Digests of jobs go on under the old name of the column (017-digests.sql): the
-- same row has the same digest before and after.

ALTER TABLE jobs RENAME COLUMN tau TO tau_reached;

-- What SQLite is to know of sizes: there are many more samples than jobs, and many more points of
-- profiles than samples. So it begins with the jobs, and looks up in the keys of the others what a
-- condition on a gas or on tau asks for; without this it reads all samples.
ANALYZE sqlite_schema;
INSERT INTO sqlite_stat1 (tbl, idx, stat) VALUES
  ('jobs', NULL, '1000'),
  ('samples', 'samples', '200000 200 1'),
  ('profiles', 'profiles', '10000000 10000 5000 500 1');
ANALYZE sqlite_schema;  -- reads the numbers
