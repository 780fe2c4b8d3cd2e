#include "campaign/results/published.hpp"

#include <array>

namespace haff::campaign {
namespace {

struct Entry {
  double e;
  double tau_c;
};

constexpr double published_density = 0.40;
constexpr std::array<Entry, 4> published{{{0.80, 58}, {0.85, 82}, {0.90, 134}, {0.95, 309}}};

}  // namespace

std::optional<double> published_tau_c(const schema::Job& job) {
  if (job.d != 3 || job.n != published_density || !job.effects.none()) return std::nullopt;
  for (const Entry& entry : published)
    if (entry.e == job.e) return entry.tau_c;
  return std::nullopt;
}

}  // namespace haff::campaign
