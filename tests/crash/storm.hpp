// SPDX-License-Identifier: GPL-3.0-or-later

// Many commands at once on one store and its shards. Most of them are killed.
#pragma once

#include <filesystem>
#include <optional>
#include <random>
#include <string>

#include "support/temporary_folder.hpp"

namespace haff::tests {

class Storm {
 public:
  // `tau_max` sets the length of the campaign.
  explicit Storm(double tau_max);

  // Runs a storm with these random numbers. Returns what went wrong, or nothing.
  std::optional<std::string> fault(std::mt19937_64& random,
                                   const std::filesystem::path& folder) const;

  int kills() const { return kills_; }

 private:
  double tau_max_;
  std::string expected_;  // the rows of an undisturbed campaign
  mutable int kills_ = 0;
};

}  // namespace haff::tests
