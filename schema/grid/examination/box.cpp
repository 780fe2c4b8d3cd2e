// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/examination/box.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <numbers>
#include <vector>

#include "schema/grid/observables.hpp"

namespace haff::schema {

namespace {

// In a smaller box a sphere could meet another one and its image at once. [sigma]
constexpr double smallest_box = 2;

// The engine keeps a particle's number in 28 bits, beside four bits about its cell.
constexpr double most_particles = 0x1p28;

std::string gigabytes(double bytes) {
  return rounded(bytes / 1e9) + " GB";
}

// The part of the volume that the densest packing of equal spheres, or disks, fills.
double close_packing(int d) {
  return d == 2 ? std::numbers::pi / std::sqrt(12.0) : std::numbers::pi / std::sqrt(18.0);
}

// What effects say about sizes; equal particles are a mixture without a second species.
struct Mixture {
  double fraction = 0;  // of species 2
  double diameter_ratio = 1;

  // clang-tidy 14 takes the zero that <=> compares with for a null pointer.
  auto operator<=>(const Mixture&) const = default;  // NOLINT(modernize-use-nullptr)
};

Mixture mixture_in(const Json& effects) {
  if (!effects.contains("mixture")) return {};
  return {effects["mixture"]["fraction"].get<double>(),
          effects["mixture"]["diameter_ratio"].get<double>()};
}

// The part of the volume that the particles fill.
double packing_fraction(int d, double n, const Mixture& mixture) {
  const double largest = d == 2 ? std::numbers::pi / 4 : std::numbers::pi / 6;  // [sigma^d]
  return n * largest *
         (1 - mixture.fraction + mixture.fraction * std::pow(mixture.diameter_ratio, d));
}

void fits_in_memory(const std::string& file, const Placed& particles, double N,
                    const Memory& memory) {
  const double bytes = N * memory.bytes_per_particle;
  if (bytes > memory.bytes || N >= most_particles)
    throw fault(file, particles.where,
                shown(particles.value) + " particles need " + gigabytes(bytes) +
                    "; expected at most the " + gigabytes(memory.bytes) +
                    " of this machine, and N below 2^28");
}

void fits_in_box(const std::string& file, const Placed& particles, double N, double n, int d) {
  if (N / n >= std::pow(smallest_box, d)) return;
  throw fault(file, particles.where,
              shown(particles.value) + (d == 2 ? " disks" : " particles") + " at n = " + text(n) +
                  " have a box of " + rounded(N / n) + " sigma^" + std::to_string(d) +
                  "; expected a side of at least " + text(smallest_box) +
                  " sigma, N >= " + text(std::ceil(std::pow(smallest_box, d) * n)));
}

void suffices_for_observables(const std::string& file, const Source& source,
                              const Placed& particles, double N, double n, int d) {
  for (const Placed& observable : items(source["observables"])) {
    const auto name = observable.value.get<std::string>();
    const double least = find_observable(name)->widest_refused_box;
    if (N / n > std::pow(least, d)) continue;
    throw fault(file, observable.where,
                shown(observable.value) + " needs a box wider than " + text(least) +
                    " sigma, which " + shown(particles.value) + " particles at n = " + text(n) +
                    " do not fill; expected N above " + rounded(std::pow(least, d) * n));
  }
}

void can_be_started(const std::string& file, const Source& source, int d, double n, double packing,
                    const Mixture& mixture, const Refusal& cannot_start) {
  if (!cannot_start) return;
  for (const Placed& particles : items(source["N"])) {
    const auto N = static_cast<std::uint32_t>(particles.value.get<double>());
    const bool is_mixed = mixture.fraction > 0 && mixture.diameter_ratio < 1;
    for (const Placed& start : items(source["start"])) {
      if (start.value.is_object() && start.value.contains("file")) continue;  // it is prepared
      if (const auto why = cannot_start({d, n, N, packing, is_mixed, start.value == "crystal"}))
        throw fault(file, particles.where, shown(particles.value) + " " + *why);
    }
  }
}

}  // namespace

void must_fit(const std::string& file, const Source& source, const Memory& memory) {
  for (const Placed& particles : items(source["N"])) {
    const double N = particles.value.get<double>();
    fits_in_memory(file, particles, N, memory);
    for (const int d : source.list<int>("d"))
      for (const double n : source.list<double>("n")) {
        fits_in_box(file, particles, N, n, d);
        suffices_for_observables(file, source, particles, N, n, d);
      }
  }
}

void must_be_packable(const std::string& file, const Source& source, const Refusal& cannot_start) {
  std::vector<Mixture> mixtures;
  for (const Json& one : expanded(source["effects"].value)) mixtures.push_back(mixture_in(one));
  std::sort(mixtures.begin(), mixtures.end());
  mixtures.erase(std::unique(mixtures.begin(), mixtures.end()), mixtures.end());
  for (const int d : source.list<int>("d"))
    for (const Placed& density : items(source["n"]))
      for (const Mixture& mixture : mixtures) {
        const double n = density.value.get<double>();
        const double packing = packing_fraction(d, n, mixture);
        if (packing >= close_packing(d))
          throw fault(file, density.where,
                      shown(density.value) + " is too dense: " + (d == 2 ? "disks" : "spheres") +
                          " would fill " + rounded(packing) +
                          " of their box; expected less than close packing, " +
                          (d == 2 ? "pi/sqrt(12) = 0.907" : "pi/sqrt(18) = 0.740") + ", n below " +
                          rounded(n * close_packing(d) / packing));
        can_be_started(file, source, d, n, packing, mixture, cannot_start);
      }
}

}  // namespace haff::schema
