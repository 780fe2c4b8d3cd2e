// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/published.hpp"

#include <fmt/format.h>

#include <vector>

namespace haff::campaign {

std::optional<double> published_tau_c(const schema::Job& job) {
  if (job.d != 3 || job.n != published_density || !job.effects.none()) return std::nullopt;
  for (const PublishedTauC& published : published_tau_cs)
    if (published.e == job.e) return published.tau_c;
  return std::nullopt;
}

std::string published_tau_c_text() {
  std::vector<std::string> restitutions, crossovers;
  restitutions.reserve(published_tau_cs.size());
  crossovers.reserve(published_tau_cs.size());
  for (const PublishedTauC& published : published_tau_cs) {
    restitutions.push_back(fmt::format("{:.2f}", published.e));
    crossovers.push_back(fmt::format("{:g}", published.tau_c));
  }
  return fmt::format("τ_c = {} for e = {}.", fmt::join(crossovers, ", "),
                     fmt::join(restitutions, ", "));
}

}  // namespace haff::campaign
