-- What a series is, once for all: a column of jobs with an index. And how a job is taken up again
-- when its state is damaged, what is looked for when the next job is claimed, and a name.

-- The averages are made by the program from its table of columns (views.cpp).
DROP VIEW mean_temperatures;
DROP VIEW mean_profiles;
DROP VIEW mean_tau_c;
DROP VIEW mean_series;
DROP VIEW realizations;
DROP VIEW target_outcomes;  -- again below

-- Jobs of one series are realizations of each other: they differ in nothing but the seed. The text
-- is the identity with the seed 0.
ALTER TABLE jobs ADD COLUMN
  series TEXT AS (iif(json_valid(identity), json_set(identity, '$.seed', 0), identity)) VIRTUAL;
CREATE INDEX jobs_by_series ON jobs (series, seed);

-- Its state is not to be used, since it is damaged: the next attempt begins at the start. The state
-- stays until a new one takes its place.
ALTER TABLE jobs ADD COLUMN
  starts_over INTEGER NOT NULL DEFAULT 0 CHECK (starts_over IN (0, 1));

-- In the order in which jobs are claimed (Store::claim): equilibrations first, then what takes
-- longest.
CREATE INDEX jobs_to_claim ON jobs (
  kind = 'equilibration' DESC,
  coalesce(expected_cpu_seconds, 0) * (1 - tau / tau_max) DESC,
  particles * (tau_max - tau) DESC,
  job_id
) WHERE status = 'pending';

-- Finished realizations by what one asks for (the views mean_...).
CREATE INDEX jobs_averaged ON jobs (e, n, particles) WHERE kind = 'cooling' AND status = 'done';

ALTER TABLE invariants RENAME COLUMN watchdog_trips TO unresolved_collisions;

-- Prediction beside outcome: realizations of the series that are done, and what they took. Targets
-- of one series are served by the same realizations, so the one that needs most decides.
CREATE VIEW target_outcomes AS
SELECT target_predictions.series AS series, quantity, tau_from, tau_to, se,
       target_predictions.realizations AS predicted_realizations,
       target_predictions.cpu_seconds AS predicted_cpu_seconds,
       target_predictions.created AS predicted,
       count(cooling.job_id) AS realizations,
       total(cooling.cpu_seconds + equilibration.cpu_seconds) AS cpu_seconds
FROM target_predictions
LEFT JOIN jobs AS cooling
  ON cooling.series = target_predictions.series AND cooling.kind = 'cooling'
     AND cooling.status = 'done'
LEFT JOIN jobs AS equilibration ON equilibration.job_id = cooling.equilibration_id
GROUP BY target_predictions.series, quantity, tau_from, tau_to, se;
