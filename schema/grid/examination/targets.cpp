// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/examination/targets.hpp"

#include <algorithm>

#include "schema/grid/effects.hpp"
#include "schema/grid/grid.hpp"

namespace haff::schema {

namespace {

// gamma_ratio and tau_c compare with Haff's law.
void cools_by_haff(const std::string& file, const Source& source, const Pointer& where) {
  const auto e = source.e();
  if (e.empty() || std::count(e.begin(), e.end(), 1.0) > 0)
    throw fault(file, where, "does not exist without a constant e below 1");
  for (const Json& one : expanded(source["effects"].value))
    if (const auto effect = beyond_haffs_law(Effects(one.dump())))
      throw fault(file, where,
                  "does not exist with " + *effect +
                      ", which changes Haff's law; expected a grid without it, or another target");
}

void starts_by_haff(const std::string& file, const Source& source, const Pointer& where) {
  for (const Placed& start : items(source["start"])) {
    const std::string text = start.value.dump();
    for (const char* name : {"shear wave", "two temperatures"})
      if (text.find(name) != std::string::npos)
        throw fault(file, where,
                    "does not exist where a gas starts as " + shown(start.value) +
                        ": Haff's law is of a uniform one; expected another start or target");
  }
}

void within_run(const std::string& file, const Source& source, const Pointer& where,
                const Json& window, const std::vector<double>& tau_max) {
  const double from = window[0].get<double>(), to = window[1].get<double>();
  const double shortest = *std::min_element(tau_max.begin(), tau_max.end());
  if (to > shortest)
    throw fault(
        file, where / 1,
        shown(window[1]) + " is beyond the run; expected at most tau_max = " + text(shortest));
  for (const double sample_every : source.list<double>("sample_every"))
    if (to - from < sample_every)
      throw fault(file, where,
                  shown(window) +
                      " holds no interval between samples; expected a window of at "
                      "least sample_every = " +
                      text(sample_every));
}

}  // namespace

void must_be_reachable(const std::string& file, const Source& source,
                       const std::vector<double>& tau_max) {
  const auto target = source.find("target");
  if (!target) return;
  const Placed pilots = source["seeds"];
  const double count = pilots.value.is_number() ? pilots.value.get<double>()
                                                : static_cast<double>(pilots.value.size());
  if (count < static_cast<double>(fewest_pilots))
    throw fault(file, pilots.where,
                shown(pilots.value) + " are too few pilot runs for a target; expected at least " +
                    std::to_string(fewest_pilots) + " seeds");
  const auto names = source.observables();
  for (const auto& [quantity, wish] : target->value.items()) {
    const Pointer where = target->where / quantity;
    const std::string observable = quantity[0] == 'a' ? "laguerre" : "temperature";
    if (!std::binary_search(names.begin(), names.end(), observable))
      throw fault(
          file, where,
          "is not measured; expected \"" + observable + "\" among the observables of this grid");
    if (quantity[0] != 'a') cools_by_haff(file, source, where);
    if (quantity[0] != 'a') starts_by_haff(file, source, where);
    if (wish.contains("tau")) within_run(file, source, where / "tau", wish["tau"], tau_max);
  }
}

}  // namespace haff::schema
