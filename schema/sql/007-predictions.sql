-- The store, version 7: what was expected of a target when its pilot runs were done, to be compared
-- with what it took.

CREATE TABLE target_predictions (
  series       TEXT NOT NULL,
  quantity     TEXT NOT NULL,
  tau_from     REAL NOT NULL,
  tau_to       REAL NOT NULL,
  se           REAL NOT NULL,     -- asked for then: a target may be planned again with another
  realizations INTEGER NOT NULL,  -- in all, pilot runs included
  cpu_seconds  REAL NOT NULL,     -- of them all, equilibrations included [s]
  created      TEXT NOT NULL,     -- UTC
  PRIMARY KEY (series, quantity, tau_from, tau_to, se),
  FOREIGN KEY (series, quantity, tau_from, tau_to)
    REFERENCES targets (series, quantity, tau_from, tau_to)
) STRICT;

-- Prediction beside outcome: realizations of the series that are done, and what they took. Targets
-- of one series are served by the same realizations, so the one that needs most decides.
CREATE VIEW target_outcomes AS
SELECT series, quantity, tau_from, tau_to, se,
       target_predictions.realizations AS predicted_realizations,
       target_predictions.cpu_seconds AS predicted_cpu_seconds,
       target_predictions.created AS predicted,
       count(cooling.job_id) AS realizations,
       total(cooling.cpu_seconds + equilibration.cpu_seconds) AS cpu_seconds
FROM target_predictions
LEFT JOIN jobs AS cooling
  ON cooling.kind = 'cooling' AND cooling.status = 'done'
     AND json_set(cooling.identity, '$.seed', 0) = series
LEFT JOIN jobs AS equilibration ON equilibration.job_id = cooling.equilibration_id
GROUP BY series, quantity, tau_from, tau_to, se;
