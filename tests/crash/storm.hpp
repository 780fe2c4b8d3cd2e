// SPDX-License-Identifier: GPL-3.0-or-later

// Many commands at once on one store and its shards, and most of them killed.
#pragma once

#include <filesystem>
#include <optional>
#include <random>
#include <string>

#include "support/temporary_folder.hpp"

namespace haff::tests {

class Storm {
 public:
  // `tau_max` says how long the campaign is that the storm comes over.
  explicit Storm(double tau_max);

  // What went wrong in the storm of these random numbers, or nothing.
  std::optional<std::string> fault(std::mt19937_64& random,
                                   const std::filesystem::path& folder) const;

  int kills() const { return kills_; }

 private:
  double tau_max_;
  std::string expected_;  // the rows of a campaign that is left alone
  mutable int kills_ = 0;
};

}  // namespace haff::tests
