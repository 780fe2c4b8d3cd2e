// SPDX-License-Identifier: GPL-3.0-or-later

// A plan that is revised: jobs that are no longer wanted go, others end earlier, a grid replaces
// what was planned before.
//
// Computed rows are never dropped unless that is asked for. Each change can be looked at first:
// revision_of_… say what a function of Revised would do, and change nothing.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "schema/store/planning/choice.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

enum class Fate {
  removed,  // goes, with whatever is stored of it
  ends,     // was begun: ends where it is stored, and the next run completes it there
  kept,     // stays as it is
  held      // a worker or a shard has it: stays as it is, too
};

struct Dismissal {
  JobRow row;
  Fate fate = Fate::kept;
  std::string why;           // "is done"
  double tau_max = 0;        // from now on
  std::int64_t samples = 0;  // rows that it has
  std::int64_t bytes = 0;    // of its state
};

// What becomes of jobs that are not wanted, and of the targets that would plan them again.
struct Revision {
  std::vector<Dismissal> jobs = {};  // by job_id
  std::vector<Target> targets = {};  // those that go
  std::vector<Outcome> outcomes =
      {};  // of a grid that replaces the plan: of its jobs, in their order
  std::vector<Dismissal> shortened = {};  // and those that were to run longer than it asks
};

// Chosen jobs are cancelled: planned ones go, begun ones end where they are stored, and those that
// have ended stay; with their rows, all of them go. Equilibrations go with the last job that starts
// from them, done ones only with their rows. Targets of their series go.
Revision revision_of_cancel(const Reader& store, const Choice& choice, bool with_rows);

// A grid replaces the plan: its jobs are added or extended, end at its tau_max (or where they are
// stored, if that is beyond), and jobs that it does not have go unless they were begun. Targets
// that it does not have go.
Revision revision_of_replace(const Reader& store, const std::vector<Planned>& plan,
                             const std::vector<Target>& targets);

class Revised : public Store {
 public:
  explicit Revised(Store store) : Store(std::move(store)) {}

  // Each is one transaction.
  Revision cancel(const Choice& choice, bool with_rows);
  Revision replace(const std::vector<Planned>& plan, const std::vector<Target>& targets);

  // Makes the file as small as what it holds. False if others use the store: its free pages are
  // used again by what is stored next.
  bool give_back_space();
};

}  // namespace haff::schema
