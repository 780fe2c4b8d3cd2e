// SPDX-License-Identifier: GPL-3.0-or-later

// A wanted error, as given on the command line.
#include "campaign/accuracy/cost/target.hpp"

#include <doctest/doctest.h>

using namespace haff;
using namespace haff::campaign;

TEST_CASE("cost target: a target is a quantity and an error") {
  CHECK(target_from_text("a2=5e-4") == CostTarget{.measure = Measure::a2, .error = 5e-4});
  const auto quantity = [](const char* text) { return target_from_text(text).value().quantity; };
  CHECK(quantity("a2@3:8=5e-4") == Quantity{.measure = Measure::a2, .from = 3, .to = 8});
  CHECK(quantity("gamma_ratio@20=1e-3") ==
        Quantity{.measure = Measure::gamma_ratio, .from = 18, .to = 22});
  CHECK(quantity("gamma_ratio@15:25=1e-3") ==
        Quantity{.measure = Measure::gamma_ratio, .from = 15, .to = 25});
  CHECK(quantity("G_parallel@30=1e-5") ==
        Quantity{.measure = Measure::correlation, .from = 30, .to = 30, .r = 5});
  for (const char* text :
       {"a2", "a2=", "a2=0", "a2=-1", "a2=x", "b=1", "a2=1x", "a2@=1", "a2@5=1", "a2@8:3=1",
        "a2@-1:3=1", "a2@3:=1", "gamma_ratio@1=1", "tau_c@5=1", "ln_temperature@3:8=1", "=@"}) {
    CAPTURE(text);
    CHECK_FALSE(target_from_text(text));
  }
}
