-- The store, version 6: temperatures of parts of the motion, where a scene's effects make them
-- differ. They belong to the observable temperature; NULL without the effect.

ALTER TABLE samples ADD COLUMN
  rotational_temperature REAL;  -- (I/3) <omega^2> of rough spheres (roughness) [E(0)]; temperature
                                -- beside it is that of translation
ALTER TABLE samples ADD COLUMN
  temperature_1 REAL;  -- (m_1/3) <v^2> of species 1 alone (mixture) [E(0)]; temperature beside it is
ALTER TABLE samples ADD COLUMN
  temperature_2 REAL;  -- that of all, (1/3) <m v^2>; and of species 2

-- Their averages over realizations, beside those of the view mean_series. Only series that have
-- them.
CREATE VIEW mean_temperatures AS
WITH
  means AS (
    SELECT series, job_id, seed, tau, count(*) OVER realization AS realizations,
           count(*) OVER realization * (count(*) OVER realization - 1) AS pairs,
           temperature,
           avg(temperature) OVER realization AS mean_temperature,
           rotational_temperature,
           avg(rotational_temperature) OVER realization AS mean_rotational_temperature,
           temperature_1,
           avg(temperature_1) OVER realization AS mean_temperature_1,
           temperature_2,
           avg(temperature_2) OVER realization AS mean_temperature_2
    FROM realizations JOIN samples USING (job_id)
    WHERE rotational_temperature IS NOT NULL OR temperature_1 IS NOT NULL
    WINDOW realization AS (PARTITION BY series, tau ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  ),
  errors AS (
    SELECT job_id, tau, realizations, row_number() OVER realization AS place,
           mean_temperature,
           sqrt(sum((temperature - mean_temperature)
                    * (temperature - mean_temperature))
                OVER realization / pairs) AS temperature_se,
           mean_rotational_temperature,
           sqrt(sum((rotational_temperature - mean_rotational_temperature)
                    * (rotational_temperature - mean_rotational_temperature))
                OVER realization / pairs) AS rotational_temperature_se,
           mean_temperature_1,
           sqrt(sum((temperature_1 - mean_temperature_1)
                    * (temperature_1 - mean_temperature_1))
                OVER realization / pairs) AS temperature_1_se,
           mean_temperature_2,
           sqrt(sum((temperature_2 - mean_temperature_2)
                    * (temperature_2 - mean_temperature_2))
                OVER realization / pairs) AS temperature_2_se
    FROM means
    WINDOW realization AS (PARTITION BY series, tau ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  )
SELECT d, e, n, particles, equilibrate, sample_every, precision, effects, observables,
       profiles_every, fields_at,
       errors.tau AS tau, realizations,
       mean_temperature AS temperature, temperature_se,
       mean_rotational_temperature AS rotational_temperature, rotational_temperature_se,
       mean_temperature_1 AS temperature_1, temperature_1_se,
       mean_temperature_2 AS temperature_2, temperature_2_se
FROM errors JOIN jobs USING (job_id)
WHERE place = 1
ORDER BY d, n, particles, e, equilibrate, sample_every, precision, effects, observables,
         profiles_every, fields_at, errors.tau;
