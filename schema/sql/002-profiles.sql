-- The store, version 2: what a gas looks like in space and in velocity, beside the samples.
--
--   profiles       curves of one variable: rho(c), G(r), S(k); one row a point
--   mean_profiles  their averages over realizations
--   fields         the gas on a mesh of cells, as BLOBs (README.md reads one in Python)
--
-- Units as in 001-store.sql. An observable that the job's `observables` do not list has no rows.

-- When they are taken: part of a job's physics, like sample_every.
ALTER TABLE jobs ADD COLUMN
  profiles_every REAL CHECK (profiles_every > 0);  -- interval of profiles [tau]; NULL: takes none
ALTER TABLE jobs ADD COLUMN
  fields_at      TEXT CHECK (json_type(fields_at) = 'array');  -- [tau, ...]; NULL: takes none

-- Numbers that need the whole gas in space, taken where profiles are; NULL elsewhere.
ALTER TABLE samples ADD COLUMN
  correlation_trace REAL;  -- Tr G^+(0), modes up to k_M = 2 pi n^(1/d) 0.30 [E(0)/m] (correlations)
ALTER TABLE samples ADD COLUMN
  largest_cluster   REAL;  -- part of the particles in the largest dense region, 0 ... 1 (clusters)

-- name              observable    x                           value
-- ----------------  ------------  --------------------------  ------------------------------------
-- rho               distribution  c = v/v_0, middle of a bin  rho, a Gaussian gas is exp(-c^2)
-- G_parallel        correlations  r [sigma], mean of a shell  G_parallel^+ [E(0)/m]
-- G_perpendicular   correlations  r [sigma], mean of a shell  G_perpendicular^+ [E(0)/m]
-- S                 structure     k [1/sigma], mean of shell  static structure factor S(k)
--
-- The x of a name are the same at every tau and for every e and seed of equal (d, n, particles).
-- Rows are written once and never change.
CREATE TABLE profiles (
  job_id INTEGER NOT NULL REFERENCES jobs (job_id),
  name   TEXT NOT NULL,
  tau    REAL NOT NULL,   -- k profiles_every, the tau of a sample
  x      REAL NOT NULL,
  value  REAL NOT NULL,
  PRIMARY KEY (job_id, name, tau, x)
) STRICT, WITHOUT ROWID;

-- name         components  a cell's value
-- -----------  ----------  ----------------------------------------------------------------------
-- density      1           particles / volume [sigma^-d]
-- velocity     d           mean velocity u [sqrt(E(0)/m)]; NaN where there is no particle
-- temperature  1           (m/d) <(v - u)^2>, corrected for the mean of few [E(0)]; NaN for one or
--                          none
--
-- data: IEEE doubles, little-endian, in C order of [x][y][z][component] (3-d), so that the value
-- of component a in cell (i, j, k), which begins at (i, j, k) box / cells, is number
-- ((i cells + j) cells + k) components + a. Rows are written once and never change.
CREATE TABLE fields (
  job_id     INTEGER NOT NULL REFERENCES jobs (job_id),
  name       TEXT NOT NULL,
  tau        REAL NOT NULL,      -- one of fields_at
  cells      INTEGER NOT NULL,   -- along each axis
  components INTEGER NOT NULL,
  box        REAL NOT NULL,      -- side L of the periodic box [sigma]
  data       BLOB NOT NULL CHECK (length(data) % 8 = 0),
  PRIMARY KEY (job_id, name, tau)
) STRICT;

-- ---- averages over realizations ---------------------------------------------------------------
--
-- The views of 001-store.sql again, now that a series is also told apart by profiles_every and
-- fields_at, and samples have two columns more.

DROP VIEW mean_tau_c;
DROP VIEW mean_series;
DROP VIEW realizations;

-- The cooling jobs that are done, numbered by series: equal numbers differ in nothing but the seed.
CREATE VIEW realizations AS
SELECT dense_rank() OVER (ORDER BY d, n, particles, e, equilibrate, sample_every, precision,
                                   effects, observables, profiles_every, fields_at) AS series,
       job_id, seed
FROM jobs
WHERE kind = 'cooling' AND status = 'done';

-- Units as in samples. A row averages the realizations that have a sample at tau: their number can
-- fall along a series whose jobs were run to different tau_max.
CREATE VIEW mean_series AS
WITH
  means AS (
    SELECT series, job_id, seed, tau, count(*) OVER realization AS realizations,
           count(*) OVER realization * (count(*) OVER realization - 1) AS pairs,
           time,           avg(time) OVER realization AS mean_time,
           temperature,    avg(temperature) OVER realization AS mean_temperature,
           gamma_ratio,    avg(gamma_ratio) OVER realization AS mean_gamma_ratio,
           collision_rate, avg(collision_rate) OVER realization AS mean_collision_rate,
           pressure,       avg(pressure) OVER realization AS mean_pressure,
           a2,             avg(a2) OVER realization AS mean_a2,
           a3,             avg(a3) OVER realization AS mean_a3,
           a4,             avg(a4) OVER realization AS mean_a4,
           a5,             avg(a5) OVER realization AS mean_a5,
           a6,             avg(a6) OVER realization AS mean_a6,
           correlation_trace, avg(correlation_trace) OVER realization AS mean_correlation_trace,
           largest_cluster,   avg(largest_cluster) OVER realization AS mean_largest_cluster
    FROM realizations JOIN samples USING (job_id)
    WINDOW realization AS (PARTITION BY series, tau ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  ),
  errors AS (
    SELECT job_id, tau, realizations, row_number() OVER realization AS place,
           mean_time,
           sqrt(sum((time - mean_time) * (time - mean_time))
                OVER realization / pairs) AS time_se,
           mean_temperature,
           sqrt(sum((temperature - mean_temperature) * (temperature - mean_temperature))
                OVER realization / pairs) AS temperature_se,
           mean_gamma_ratio,
           sqrt(sum((gamma_ratio - mean_gamma_ratio) * (gamma_ratio - mean_gamma_ratio))
                OVER realization / pairs) AS gamma_ratio_se,
           mean_collision_rate,
           sqrt(sum((collision_rate - mean_collision_rate) * (collision_rate - mean_collision_rate))
                OVER realization / pairs) AS collision_rate_se,
           mean_pressure,
           sqrt(sum((pressure - mean_pressure) * (pressure - mean_pressure))
                OVER realization / pairs) AS pressure_se,
           mean_a2, sqrt(sum((a2 - mean_a2) * (a2 - mean_a2)) OVER realization / pairs) AS a2_se,
           mean_a3, sqrt(sum((a3 - mean_a3) * (a3 - mean_a3)) OVER realization / pairs) AS a3_se,
           mean_a4, sqrt(sum((a4 - mean_a4) * (a4 - mean_a4)) OVER realization / pairs) AS a4_se,
           mean_a5, sqrt(sum((a5 - mean_a5) * (a5 - mean_a5)) OVER realization / pairs) AS a5_se,
           mean_a6, sqrt(sum((a6 - mean_a6) * (a6 - mean_a6)) OVER realization / pairs) AS a6_se,
           mean_correlation_trace,
           sqrt(sum((correlation_trace - mean_correlation_trace)
                    * (correlation_trace - mean_correlation_trace))
                OVER realization / pairs) AS correlation_trace_se,
           mean_largest_cluster,
           sqrt(sum((largest_cluster - mean_largest_cluster)
                    * (largest_cluster - mean_largest_cluster))
                OVER realization / pairs) AS largest_cluster_se
    FROM means
    WINDOW realization AS (PARTITION BY series, tau ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  )
SELECT d, e, n, particles, equilibrate, sample_every, precision, effects, observables,
       profiles_every, fields_at,
       errors.tau AS tau, realizations,
       mean_time AS time, time_se,
       mean_temperature AS temperature, temperature_se,
       mean_gamma_ratio AS gamma_ratio, gamma_ratio_se,
       mean_collision_rate AS collision_rate, collision_rate_se,
       mean_pressure AS pressure, pressure_se,
       mean_a2 AS a2, a2_se,
       mean_a3 AS a3, a3_se,
       mean_a4 AS a4, a4_se,
       mean_a5 AS a5, a5_se,
       mean_a6 AS a6, a6_se,
       mean_correlation_trace AS correlation_trace, correlation_trace_se,
       mean_largest_cluster AS largest_cluster, largest_cluster_se
FROM errors JOIN jobs USING (job_id)
WHERE place = 1
ORDER BY d, n, particles, e, equilibrate, sample_every, precision, effects, observables,
         profiles_every, fields_at, errors.tau;

-- tau_c and its standard error over those realizations that reached it: where reached is smaller
-- than realizations, tau_max was too small and the mean is biased low.
CREATE VIEW mean_tau_c AS
WITH
  means AS (
    SELECT series, job_id, seed, tau_c,
           count(*)     OVER realization AS realizations,
           count(tau_c) OVER realization AS reached,
           avg(tau_c)   OVER realization AS mean_tau_c
    FROM realizations JOIN results USING (job_id)
    WINDOW realization AS (PARTITION BY series ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  ),
  errors AS (
    SELECT job_id, realizations, reached, mean_tau_c, row_number() OVER realization AS place,
           sqrt(sum((tau_c - mean_tau_c) * (tau_c - mean_tau_c)) OVER realization
                / (reached - 1) / reached) AS tau_c_se
    FROM means
    WINDOW realization AS (PARTITION BY series ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  )
SELECT d, e, n, particles, equilibrate, sample_every, precision, effects, observables,
       profiles_every, fields_at,
       realizations, reached, mean_tau_c AS tau_c, tau_c_se
FROM errors JOIN jobs USING (job_id)
WHERE place = 1
ORDER BY d, n, particles, e, equilibrate, sample_every, precision, effects, observables,
         profiles_every, fields_at;

-- Averages of profiles: one row a point.
CREATE VIEW mean_profiles AS
WITH
  means AS (
    SELECT series, job_id, seed, name, tau, x, value,
           count(*) OVER realization AS realizations,
           avg(value) OVER realization AS mean_value
    FROM realizations JOIN profiles USING (job_id)
    WINDOW realization AS (PARTITION BY series, name, tau, x ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  ),
  errors AS (
    SELECT job_id, name, tau, x, realizations, mean_value,
           row_number() OVER realization AS place,
           sqrt(sum((value - mean_value) * (value - mean_value)) OVER realization
                / (realizations - 1) / realizations) AS value_se
    FROM means
    WINDOW realization AS (PARTITION BY series, name, tau, x ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  )
SELECT d, e, n, particles, equilibrate, sample_every, precision, effects, observables,
       profiles_every, fields_at,
       name, errors.tau AS tau, x, realizations, mean_value AS value, value_se
FROM errors JOIN jobs USING (job_id)
WHERE place = 1
ORDER BY d, n, particles, e, equilibrate, sample_every, precision, effects, observables,
         profiles_every, fields_at, name, errors.tau, x;
