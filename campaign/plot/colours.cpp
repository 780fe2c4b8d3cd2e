// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/plot/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace haff::campaign {
namespace {

// Colours by Okabe and Ito (without yellow, which is faint on white), and steps of viridis (S.
// van der Walt and N. Smith), from dark to light but for its faint yellow.
constexpr std::array<std::string_view, 6> okabe_ito = {"#0072B2", "#D55E00", "#009E73",
                                                       "#CC79A7", "#E69F00", "#56B4E9"};
constexpr std::array<std::array<double, 3>, 7> viridis = {{{68, 1, 84},
                                                           {70, 50, 126},
                                                           {54, 92, 141},
                                                           {39, 127, 142},
                                                           {31, 161, 135},
                                                           {74, 193, 109},
                                                           {160, 218, 57}}};

}  // namespace

std::string colour(std::size_t place, std::size_t of) {
  if (of <= okabe_ito.size()) return std::string(okabe_ito[place % okabe_ito.size()]);
  return shade(place, of);
}

std::string shade(std::size_t place, std::size_t of) {
  const double at = static_cast<double>(place) /
                    static_cast<double>(std::max<std::size_t>(of, 2) - 1) *
                    static_cast<double>(viridis.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const double share = at - static_cast<double>(low);
  std::array<int, 3> mixed{};
  for (std::size_t i = 0; i < 3; ++i) {
    mixed[i] = static_cast<int>(viridis[low][i] + share * (viridis[low + 1][i] - viridis[low][i]));
  }
  return fmt::format("#{:02X}{:02X}{:02X}", mixed[0], mixed[1], mixed[2]);
}

}  // namespace haff::campaign
