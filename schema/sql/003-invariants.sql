-- The store, version 3: whether the physics of each run held.

-- One row per job, written with its samples and checkpoints. What each value may be at most, and
-- why, is in engine/soundness.hpp and engine/watchdog.hpp; campaign verify compares.
CREATE TABLE invariants (
  job_id           INTEGER PRIMARY KEY REFERENCES jobs (job_id),
  largest_overlap  REAL NOT NULL,     -- deepest overlap of two particles when they collided [sigma]
  past_events      INTEGER NOT NULL,  -- events whose time had passed when their turn came
  watchdog_trips   INTEGER NOT NULL,  -- collisions too slow to be resolved; three are a collapse
  energy_mismatch  REAL NOT NULL,     -- largest |loss summed over collisions - change of kinetic
                                      -- energy| between two synchronizations, relative to it
  momentum_removed REAL NOT NULL      -- largest total momentum set to zero at a synchronization, in
                                      -- units of sqrt(N) times the rms speed
) STRICT;
