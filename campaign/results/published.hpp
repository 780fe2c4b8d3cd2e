// What has been published of the cooling gas, for comparison.
#pragma once

#include <optional>

#include "schema/grid/job.hpp"

namespace haff::campaign {

// tau_c of R. Kawahara and H. Nakanishi, cond-mat/0309130: smooth spheres at n = 0.40 with
// N = 600 000; nothing for other gases.
std::optional<double> published_tau_c(const schema::Job& job);

inline constexpr const char* published_source =
    "R. Kawahara and H. Nakanishi, cond-mat/0309130 (N = 600 000)";

}  // namespace haff::campaign
