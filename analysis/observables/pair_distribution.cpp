// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/pair_distribution.hpp"

#include <cmath>
#include <stdexcept>

#include "analysis/observables/pairs.hpp"
#include "analysis/theory/gas.hpp"

namespace haff::analysis {
namespace {

constexpr double smallest_pair_box = 4;  // [sigma]

// Tolerance for counting bins: (4 - 1) / 0.05 is 60 bins, however it is rounded.
constexpr double rounding = 1e-9;

// Particles in contact overlap by less than this, because of rounding; a pair that overlaps by more
// is not one of hard particles. [sigma]
constexpr double overlap = 1e-6;

// A pair that has just collided is as near to contact as rounding allows; a pair that collided
// earlier has separated by 1e-5 or more. At random moments no pair is so near. [sigma]
constexpr double in_touch = 1e-9;

double reach_in(double box, double reach = pair_reach) {
  return std::min(reach, box / 2);
}

// W of the header, for x in 0 ... 1.
double contact_weight(double x) {
  const double t = 2 * x - 1;
  const double square = t * t;
  return (1 - 3 * t + 5 * (1.5 * square - 0.5) - 7 * (2.5 * square - 1.5) * t) / contact_range;
}

// Pairs in bins and at contact, each relative to the number for particles at random positions.
class Counts {
 public:
  Counts(double box, int d, double contact, double pairs, double reach)
      : d_(d),
        contact_(contact),
        density_(pairs * unit_sphere_surface(d) / std::pow(box, d)),
        bins_(static_cast<std::size_t>((reach - contact) / pair_bin + rounding)) {}

  void add(double distance2) {
    const double r = std::sqrt(distance2);
    const double beyond = r - contact_;
    if (beyond < -overlap || std::abs(beyond) < in_touch) return;
    if (beyond < contact_range)
      at_contact_ += contact_weight(std::max(beyond, 0.0) / contact_range) / (d_ == 3 ? r * r : r);
    const auto bin = static_cast<std::size_t>(std::max(beyond, 0.0) / pair_bin);
    if (bin < bins_.size()) ++bins_[bin];
  }

  PairDistribution result() const {
    PairDistribution all{.r = {contact_}, .g = {at_contact_ / density_}};
    for (std::size_t b = 0; b < bins_.size(); ++b) {
      const double low = contact_ + static_cast<double>(b) * pair_bin, high = low + pair_bin;
      const double shell =
          (d_ == 3 ? high * high * high - low * low * low : high * high - low * low) / d_ *
          density_;
      all.r.push_back(contact_ + (static_cast<double>(b) + 0.5) * pair_bin);
      all.g.push_back(bins_[b] / shell);
    }
    return all;
  }

 private:
  int d_;
  double contact_;
  double density_;  // of pairs, over r^(d-1) dr
  std::vector<double> bins_;
  double at_contact_ = 0;
};

void must_fit(double box) {
  if (!(box >= smallest_pair_box))
    throw std::invalid_argument("a pair distribution needs a box of 4 sigma");
}

}  // namespace

PairDistribution pair_distribution(std::span<const Vector> position, double box, int d,
                                   double contact, double reach) {
  must_fit(box);
  if (position.size() < 2) throw std::invalid_argument("a pair distribution needs two particles");
  const auto particles = static_cast<double>(position.size());
  const double within = reach_in(box, reach);
  Counts counts(box, d, contact, particles * (particles - 1) / 2, within);
  Pairs(position, box, d, within).for_each([&](std::size_t, std::size_t, double distance2) {
    counts.add(distance2);
  });
  return counts.result();
}

PairDistribution pair_distribution(std::span<const Vector> one, std::span<const Vector> other,
                                   double box, double contact, int d) {
  must_fit(box);
  if (one.empty() || other.empty())
    throw std::invalid_argument("a pair distribution of two species needs both");
  std::vector<Vector> all(one.begin(), one.end());
  all.insert(all.end(), other.begin(), other.end());
  Counts counts(box, d, contact,
                static_cast<double>(one.size()) * static_cast<double>(other.size()), reach_in(box));
  Pairs(all, box, d, reach_in(box)).for_each([&](std::size_t i, std::size_t j, double distance2) {
    if ((i < one.size()) != (j < one.size())) counts.add(distance2);
  });
  return counts.result();
}

}  // namespace haff::analysis
