// SPDX-License-Identifier: GPL-3.0-or-later

// Which jobs a user wants, and in which order: SQL that a user has typed, read as one condition and
// one list of terms over the table jobs.
//
// Beside the columns of jobs it may say N for the number of particles (SQLite ignores case, so that
// N alone would be the density n) and roughness.beta for a parameter of an effect.
//
// A condition chooses cooling jobs, and with them the equilibrations that they start from. These
// have neither an e nor effects to be chosen by, and are run when a chosen job waits for them. Only
// a condition that names kind or job_id also chooses among equilibrations.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::schema {

class Choice {
 public:
  // All jobs, in the order of Store::claim.
  Choice() = default;
  // `where` and `order` as typed, `names` being what messages call them ("--where"); empty: all,
  // and the usual order. Throws QueryError if SQLite does not take them for a condition and for
  // terms to sort by, or if they would write.
  Choice(const Reader& store, const std::string& where, const std::string& order = {});

  bool is_everything() const { return where_.empty() && order_.empty(); }
  // Whether it says which seeds, or which jobs by their numbers: no realization is then added.
  bool names_realizations() const { return names_realizations_; }

  // SQL over a row of jobs: the condition ("1" for all), and the terms to sort by (empty: none).
  std::string condition() const { return condition_; }
  const std::string& order() const { return sorted_; }

 private:
  std::string where_, order_;
  std::string condition_ = "1", sorted_;
  bool names_realizations_ = false;
};

// The jobs that a condition chooses, without what they start from.
std::set<std::int64_t> chosen_jobs(const Reader& store, const Choice& choice);

// A store of which only the chosen jobs are run. A function that hides one of Store does the same
// for the chosen jobs and the equilibrations that they wait for.
class Selection : public Store {
 public:
  Selection(Store store, Choice choice) : Store(std::move(store)), choice_(std::move(choice)) {}

  const Choice& choice() const { return choice_; }
  Summary summary() const;
  bool has_claimable(const std::optional<Fit>& fit) const;
  std::optional<double> least_seconds_to(double tau) const;
  std::optional<Claim> claim(const Owner& owner, const std::string& code_version,
                             const std::optional<Fit>& fit = {});

  // The numbers of the jobs that summary() counts, and the series of the chosen ones.
  std::set<std::int64_t> job_ids() const;
  std::set<std::string> series() const;

 private:
  Choice choice_;
};

}  // namespace haff::schema
