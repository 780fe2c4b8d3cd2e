-- The store, version 5: standard errors to be reached by as many realizations as it takes.
--
-- Realizations are added until the standard error of the mean of all is at most se. Scatter alone
-- decides, so the mean is unbiased; mean +- t s / sqrt(R), with s of the pilot runs alone and
-- Student's t of pilots - 1 degrees of freedom, covers as it says (after C. Stein, Ann. Math.
-- Stat. 16, 243 (1945)).

CREATE TABLE targets (
  series   TEXT NOT NULL,   -- identity of its jobs, with seed 0 in place of theirs
  quantity TEXT NOT NULL,   -- a2, a3, a4, gamma_ratio: mean over the window; or tau_c
  tau_from REAL NOT NULL,   -- the window, both ends included; 0 and 0 for tau_c
  tau_to   REAL NOT NULL,
  se       REAL NOT NULL CHECK (se > 0),                       -- standard error to reach
  pilots   TEXT NOT NULL CHECK (json_type(pilots) = 'array'),  -- seeds; never change
  PRIMARY KEY (series, quantity, tau_from, tau_to)
) STRICT;
