// SPDX-License-Identifier: GPL-3.0-or-later

// A definite integral of a smooth function by GSL's adaptive quadrature (QAG with 21 points).
// For the .cpp files of this room only.
#pragma once

#include <gsl/gsl_integration.h>

#include "analysis/gsl.hpp"

namespace haff::analysis {

// int_a^b f(x) dx to the relative or absolute tolerance asked for, whichever is met first. Throws
// std::runtime_error if neither is met.
template <class Function>
double integral(const Function& f, double a, double b, double relative, double absolute) {
  constexpr std::size_t most_intervals = 400;
  gsl::report_errors();
  const gsl::Owned<gsl_integration_workspace, gsl_integration_workspace_free> workspace(
      gsl_integration_workspace_alloc(most_intervals));
  gsl::Called called(f);
  const gsl_function function = called.view();
  double result = 0;
  double error = 0;
  called.check(gsl_integration_qag(&function, a, b, absolute, relative, most_intervals,
                                   GSL_INTEG_GAUSS21, workspace.get(), &result, &error),
               "quadrature");
  return result;
}

}  // namespace haff::analysis
