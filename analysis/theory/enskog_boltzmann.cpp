#include "analysis/theory/enskog_boltzmann.hpp"

#include <cmath>

namespace haff::analysis {
namespace {

double source(double e, int d) {
  return (e * e - 1) * (2 * e * e - 1) / (d * (d + 2));
}

double relaxation(double e, int d) {
  const double bracket = 9 + 24 * d + 8 * e * d - 41 * e + 30 * (1 - e) * e * e;
  return -(1 + e) * bracket / (16 * d * (d + 2));
}

}  // namespace

double boltzmann_a2(double tau, double e, int d) {
  return boltzmann_a2_plateau(e, d) * -std::expm1(relaxation(e, d) * tau);
}

double boltzmann_a2_plateau(double e, int d) {
  return -source(e, d) / relaxation(e, d);
}

double heated_a2(double e, int d) {
  const double bracket = 73 + 56 * d - 24 * e * d - 105 * e + 30 * (1 - e) * e * e;
  return 16 * (1 - e) * (1 - 2 * e * e) / bracket;
}

double boltzmann_rate_ratio(double a2) {
  return 1 - a2 / 16;
}

double boltzmann_gamma_ratio(double a2) {
  return (1 + 3 * a2 / 16) / boltzmann_rate_ratio(a2);
}

}  // namespace haff::analysis
