// SPDX-License-Identifier: GPL-3.0-or-later

// Published values of the cooling gas, for comparison.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "schema/grid/job.hpp"

namespace haff::campaign {

// tau_c of R. Kawahara and H. Nakanishi, cond-mat/0309130: smooth spheres at this density with
// N = 600 000. Every comparison takes the numbers from here.
struct PublishedTauC {
  double e;
  double tau_c;
};
inline constexpr double published_density = 0.40;  // [sigma^-3]
inline constexpr std::array<PublishedTauC, 4> published_tau_cs{
    {{0.80, 58}, {0.85, 82}, {0.90, 134}, {0.95, 309}}};

// That of a gas; nothing for gases that the paper does not have.
std::optional<double> published_tau_c(const schema::Job& job);

// "τ_c = 58, 82, 134, 309 for e = 0.80, 0.85, 0.90, 0.95."
std::string published_tau_c_text();

inline constexpr const char* published_source =
    "R. Kawahara and H. Nakanishi, cond-mat/0309130 (N = 600 000)";

}  // namespace haff::campaign
