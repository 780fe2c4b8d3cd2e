// SPDX-License-Identifier: GPL-3.0-or-later

// What a claim is held to. A tolerance chosen by hand may be so wide that a wrong theory passes:
// here the nearest theories that are known to be wrong set it. A measured value agrees with a
// theory if it lies nearer to it than half the way to the nearest of its rivals.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace haff::campaign {

// A theory that a claim must tell from the one it is held to, and what it says.
struct Rival {
  std::string name;
  double value = 0;
};

struct Judgement {
  std::optional<bool> holds = {};  // nothing: the error is too large to tell
  std::string criterion = {};
};

// half_interval: half the 95 % interval of the value, NaN where nothing is known of it. Where the
// interval is wider than the tolerance the claim is refuted at most, never confirmed. `most` is a
// tolerance that is not exceeded however far the rivals are.
Judgement judge(double value, double half_interval, double reference,
                const std::vector<Rival>& rivals,
                double most = std::numeric_limits<double>::infinity());

}  // namespace haff::campaign
