// What every use of GSL in this room shares: errors become exceptions instead of aborting the
// program, resources free themselves, and functions of one variable can be lambdas.
// For the .cpp files of this room only.
#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace haff::analysis::gsl {

// GSL's own handler aborts. To be called before the first use that may fail.
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

// A view of any callable double(double) as a gsl_function; the callable must outlive it.
template <class Function>
gsl_function view(const Function& function) {
  return {[](double x, void* self) { return (*static_cast<const Function*>(self))(x); },
          const_cast<void*>(static_cast<const void*>(&function))};
}

}  // namespace haff::analysis::gsl
