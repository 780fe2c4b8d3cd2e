// SPDX-License-Identifier: GPL-3.0-or-later

// Shared by all files of this room that use GSL: errors become exceptions instead of aborting the
// program, resources free themselves, and functions of one variable can be lambdas. For the .cpp
// files of this room only.
#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace haff::analysis::gsl {

// GSL's own handler aborts the program. To be called before the first use of GSL that may fail.
inline void report_errors() {
  gsl_set_error_handler_off();
}

inline void check(int status, const char* doing) {
  if (status != GSL_SUCCESS) {
    throw std::runtime_error(std::string(doing) + ": " + gsl_strerror(status));
  }
}

template <auto free>
struct Free {
  template <class T>
  void operator()(T* held) const {
    free(held);
  }
};

template <class T, auto free>
using Owned = std::unique_ptr<T, Free<free>>;

// An exception must not cross the C functions of GSL that have called us: it is kept, and thrown
// again once GSL has returned.
class Caught {
 public:
  // Does the work, and returns the status for GSL.
  template <class Work>
  int status_of(Work&& work) noexcept {
    try {
      work();
      return GSL_SUCCESS;
    } catch (...) {
      exception_ = std::current_exception();
      return GSL_EBADFUNC;
    }
  }
  void rethrow() {
    if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
  }

 private:
  std::exception_ptr exception_;
};

// Any callable double(double) as a gsl_function. Both must outlive it.
template <class Function>
class Called {
 public:
  explicit Called(const Function& function) : function_(function) {}

  gsl_function view() { return {call, this}; }
  void check(int status, const char* doing) {
    caught_.rethrow();
    gsl::check(status, doing);
  }

 private:
  static double call(double x, void* self) {
    auto& called = *static_cast<Called*>(self);
    double value = GSL_NAN;
    called.caught_.status_of([&] { value = called.function_(x); });
    return value;
  }

  const Function& function_;
  Caught caught_;
};

}  // namespace haff::analysis::gsl
