// SPDX-License-Identifier: GPL-3.0-or-later

// Constant restitution: the same e at every collision.
#pragma once

#include <string_view>

#include "engine/restitution/restitution_model.hpp"

namespace haff::engine {

class ConstantRestitution : public Memoryless {
 public:
  static constexpr std::string_view name = "constant";

  explicit ConstantRestitution(double e, const Parameters& = {}) : e_(e) {}

  double operator()(const Impact&) const { return e_; }

 private:
  double e_;
};

}  // namespace haff::engine
