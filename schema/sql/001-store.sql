-- The store, version 1. The program embeds this file and runs it once, in one transaction, when
-- it makes a store; later versions are further files, 002-....sql, run in order. The comments
-- within the tables stay in the store: `sqlite3 campaign.db .schema` shows them.
--
-- Units: length sigma (diameter), mass m, energy E(0) (kinetic energy per particle when cooling
-- starts), hence time sigma sqrt(m/E(0)). tau counts collisions suffered per particle:
-- tau = 2 C / N after C pair collisions. SQLite ignores case, so the paper's n and N are the
-- columns n and particles.

CREATE TABLE job_status (
  position INTEGER PRIMARY KEY,  -- order in which tables of jobs list them
  status   TEXT NOT NULL UNIQUE,
  meaning  TEXT NOT NULL
) STRICT;

INSERT INTO job_status (position, status, meaning) VALUES
  (0, 'pending',   'waits to be run, or to be gone on with'),
  (1, 'running',   'a worker holds its lease'),
  (2, 'done',      'reached tau_max; samples and results are complete'),
  (3, 'failed',    'gave up after repeated errors; its last error is kept'),
  (4, 'collapsed', 'ended in inelastic collapse; samples up to then are kept');

CREATE TABLE jobs (
  job_id           INTEGER PRIMARY KEY,

  -- The physics. It never changes.
  identity         TEXT NOT NULL UNIQUE,     -- the columns of this paragraph as one JSON object
  kind             TEXT NOT NULL CHECK (kind IN ('equilibration', 'cooling')),
  d                INTEGER NOT NULL CHECK (d IN (2, 3)),            -- dimension
  e                REAL NOT NULL CHECK (e BETWEEN 0 AND 1),         -- restitution; equilibration: 1
  n                REAL NOT NULL CHECK (n > 0),                     -- number density [sigma^-d]
  particles        INTEGER NOT NULL CHECK (particles >= 2),         -- N
  seed             INTEGER NOT NULL CHECK (seed >= 0),              -- realization
  equilibrate      REAL NOT NULL CHECK (equilibrate > 0),           -- elastic tau before cooling
  sample_every     REAL NOT NULL CHECK (sample_every > 0),          -- interval of samples [tau]
  precision        TEXT NOT NULL CHECK (precision IN ('double', 'single')),
  effects          TEXT NOT NULL CHECK (json_type(effects) = 'object'),     -- {}: none
  observables      TEXT NOT NULL CHECK (json_type(observables) = 'array'),  -- names, sorted

  -- How far, and from where.
  tau_max          REAL NOT NULL CHECK (tau_max > 0),               -- a later plan may enlarge it
  checkpoint_every REAL NOT NULL CHECK (checkpoint_every > 0),      -- interval of checkpoints [tau]
  equilibration_id INTEGER REFERENCES jobs (job_id),                -- job whose end is the start

  -- How it goes.
  status           TEXT NOT NULL DEFAULT 'pending' REFERENCES job_status (status),
  attempts         INTEGER NOT NULL DEFAULT 0,   -- errors in a row without a new checkpoint
  error            TEXT,                         -- the last error; NULL if there was none
  tau              REAL NOT NULL DEFAULT 0,      -- reached: last report while running, else stored
  collisions       INTEGER NOT NULL DEFAULT 0,   -- pair collisions at tau
  cpu_seconds      REAL NOT NULL DEFAULT 0,      -- spent, all attempts [s]
  expected_cpu_seconds REAL,                     -- from 0 to tau_max [s]; NULL if unknown
  created          TEXT NOT NULL,                -- UTC, 2003-09-05T12:00:00.000Z
  started          TEXT,                         -- first claim
  finished         TEXT,                         -- when it became done, failed or collapsed
  code_version     TEXT,                         -- of the program that last worked on it
  host             TEXT,                         -- where it was last worked on

  -- The lease of a running job: the process that alone may write to it; NULL when not running.
  lease            INTEGER NOT NULL DEFAULT 0,   -- grows by 1 with each claim
  owner_boot_id    TEXT,                         -- of the host's present boot
  owner_pid        INTEGER,
  owner_started    INTEGER,                      -- process start, clock ticks since boot
  renewed          TEXT,                         -- last sign of life, UTC

  CHECK ((status = 'running') = (owner_pid IS NOT NULL)),
  CHECK ((kind = 'cooling') = (equilibration_id IS NOT NULL)),
  CHECK (kind = 'cooling' OR e = 1)
) STRICT;

CREATE INDEX jobs_by_status ON jobs (status);
CREATE INDEX jobs_by_equilibration ON jobs (equilibration_id);

-- One row per sample, taken after ceil(tau N / 2) pair collisions. An observable the job does not
-- list is NULL. Rows are written once and never change.
CREATE TABLE samples (
  job_id         INTEGER NOT NULL REFERENCES jobs (job_id),
  tau            REAL NOT NULL,   -- k sample_every, k = 0, 1, 2, ...
  time           REAL NOT NULL,   -- true time [sigma sqrt(m/E(0))]
  temperature    REAL,            -- granular temperature T = (m/d) <v^2> [E(0)]
  gamma_ratio    REAL,            -- decay rate gamma/gamma_0 = ln(E_{k-1}/E_k) / (2 gamma_0 dtau),
                                  -- 2 gamma_0 = (1 - e^2)/d: an average over the interval before
                                  -- tau, so it belongs to tau - sample_every/2. NULL at k = 0, e = 1
  collision_rate REAL,            -- omega: collisions suffered per particle and unit of time, over
                                  -- the interval before tau; NULL at k = 0
  pressure       REAL,            -- n T + collisional virial [E(0) sigma^-d], over the interval
                                  -- before tau; NULL at k = 0
  a2             REAL,            -- Laguerre (Sonine) coefficients of the velocity distribution
  a3             REAL,
  a4             REAL,
  a5             REAL,
  a6             REAL,
  PRIMARY KEY (job_id, tau)
) STRICT, WITHOUT ROWID;

-- One row per finished cooling job. NULL: not reached within tau_max.
CREATE TABLE results (
  job_id INTEGER PRIMARY KEY REFERENCES jobs (job_id),
  tau_c  REAL,   -- first tau with T_Haff = T/2; ln(T/T_Haff) interpolated between samples
  time_c REAL    -- the time of tau_c [sigma sqrt(m/E(0))]
) STRICT;

-- The newest state of a job, from which it goes on: an equilibration's last one is where the
-- cooling jobs start. Written in the transaction that writes the samples before it.
CREATE TABLE checkpoints (
  job_id     INTEGER PRIMARY KEY REFERENCES jobs (job_id),
  tau        REAL NOT NULL,
  collisions INTEGER NOT NULL,   -- pair collisions at tau
  bytes      INTEGER NOT NULL,   -- of all chunks together
  checksum   INTEGER NOT NULL,   -- FNV-1a, 64 bits, of all bytes in the order of the chunks
  created    TEXT NOT NULL       -- UTC
) STRICT;

CREATE TABLE checkpoint_chunks (
  job_id   INTEGER NOT NULL REFERENCES checkpoints (job_id),
  position INTEGER NOT NULL,     -- 0, 1, 2, ...
  bytes    BLOB NOT NULL,        -- at most 16 MiB
  PRIMARY KEY (job_id, position)
) STRICT;

-- ---- averages over realizations ---------------------------------------------------------------
--
-- Jobs that differ in nothing but the seed are realizations of one series. Only cooling jobs that
-- are done count. x_se is the standard error of the mean, sqrt(sum (x - mean)^2 / (R - 1) / R),
-- NULL for one realization; deviations are taken from the mean itself, since <x^2> - <x>^2 loses
-- every digit of a late temperature. Sums run over windows ordered by seed, so that an average
-- does not depend, even in the last bit, on the order in which jobs were planned or finished.

-- The cooling jobs that are done, numbered by series: equal numbers differ in nothing but the seed.
CREATE VIEW realizations AS
SELECT dense_rank() OVER (ORDER BY d, n, particles, e, equilibrate, sample_every, precision,
                                   effects, observables) AS series,
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
           a6,             avg(a6) OVER realization AS mean_a6
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
           mean_a6, sqrt(sum((a6 - mean_a6) * (a6 - mean_a6)) OVER realization / pairs) AS a6_se
    FROM means
    WINDOW realization AS (PARTITION BY series, tau ORDER BY seed
                           ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
  )
SELECT d, e, n, particles, equilibrate, sample_every, precision, effects, observables,
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
       mean_a6 AS a6, a6_se
FROM errors JOIN jobs USING (job_id)
WHERE place = 1
ORDER BY d, n, particles, e, equilibrate, sample_every, precision, effects, observables,
         errors.tau;

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
       realizations, reached, mean_tau_c AS tau_c, tau_c_se
FROM errors JOIN jobs USING (job_id)
WHERE place = 1
ORDER BY d, n, particles, e, equilibrate, sample_every, precision, effects, observables;
