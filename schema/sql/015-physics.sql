-- The store, version 15: which bits a job was computed with.

-- engine::physics_version of the program that computed it, NULL before its first checkpoint. Such
-- numbers were first given to the trajectories of version 1.
ALTER TABLE jobs ADD COLUMN physics_version INTEGER;
UPDATE jobs SET physics_version = 1 WHERE collisions > 0;

-- Series whose finished realizations were computed with more than one physics version: each is exact,
-- but no program computes all of them.
CREATE VIEW mixed_physics AS
SELECT series, group_concat(DISTINCT physics_version) AS physics_versions,
       count(*) AS realizations, min(job_id) AS job_id
FROM jobs
WHERE kind = 'cooling' AND status = 'done'
GROUP BY series
HAVING count(DISTINCT physics_version) > 1;
