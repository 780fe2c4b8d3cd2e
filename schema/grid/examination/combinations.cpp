// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/examination/combinations.hpp"

#include <cmath>

#include "schema/grid/effects.hpp"
#include "schema/grid/rules.hpp"

namespace haff::schema {

namespace {

// A constant e, or a law that gives every collision its own.
void has_one_restitution(const std::string& file, const Source& source, const Effects& effects) {
  const auto e = source.find("e");
  const auto law = law_without_e(effects);
  if (e && law)
    throw fault(file, e->where,
                shown(e->value) + " does not go together with the " + *law +
                    " law, which gives every collision an e of its own; expected one of the two");
  if (!e && !law)
    throw fault(
        file, source.where(),
        "has no \"e\"" +
            std::string(!source.where().empty() ? ", and there is none beside \"grids\"" : "") +
            "; expected " + description("e"));
}

void loses_energy(const std::string& file, const Source& source) {
  const auto e = source.find("e");
  if (!e) return;
  for (const Placed& item : items(*e))
    if (item.value.get<double>() == 1)
      throw fault(file, item.where,
                  "1 and a thermostat do not go together: an elastic gas would grow hotter "
                  "without end; expected e < 1, or roughness with beta between -1 and 1");
}

void collides_between_shuffles(const std::string& file, const Source& source,
                               const Placed& effects) {
  for (const Placed& shuffle : asked(effects, "shuffle"))
    for (const Placed& every : items(shuffle, "every"))
      for (const double N : source.list<double>("N"))
        if (every.value.get<double>() * N < 2)
          throw fault(file, every.where,
                      shown(every.value) + " is less than one collision of " + text(N) +
                          " particles; expected at least 2/N = " + rounded(2 / N));
}

void has_both_species(const std::string& file, const Source& source, const Placed& effects) {
  for (const Placed& mixture : asked(effects, "mixture"))
    for (const Placed& fraction : items(mixture, "fraction"))
      for (const double N : source.list<double>("N"))
        if (const double second = std::round(fraction.value.get<double>() * N);
            second < 1 || second > N - 1)
          throw fault(file, fraction.where,
                      shown(fraction.value) + " of " + text(N) +
                          " particles leaves a species without any; expected at least one of each");
}

// Realizations that start from one state differ by what their effects draw at random.
void tells_seeds_apart(const std::string& file, const Source& source, const Placed& start) {
  for (const Json& one : expanded(source["effects"].value))
    if (!one.contains("shuffle") && !one.contains("thermostat"))
      throw fault(file, source["seeds"].where,
                  shown(source["seeds"].value) +
                      " makes realizations that are all the same: they "
                      "start from " +
                      shown(start.value) + ", and nothing in them is random; expected one seed");
}

}  // namespace

void must_go_together(const std::string& file, const Source& source) {
  const Placed effects = source["effects"];
  for (const Placed& listed : items(effects))
    for (const Json& one : expanded(listed.value)) {
      const Effects effects_of_one(one.dump());
      if (const auto why = nonsense(effects_of_one)) throw fault(file, listed.where, *why);
      has_one_restitution(file, source, effects_of_one);
      if (effects_of_one.contains("thermostat") && !lose_energy_at_e_1(effects_of_one))
        loses_energy(file, source);
    }
  collides_between_shuffles(file, source, effects);
  has_both_species(file, source, effects);
}

void must_have_a_start(const std::string& file, const Source& source) {
  const Placed seeds = source["seeds"];
  const bool has_several_seeds =
      seeds.value.is_number() ? seeds.value.get<double>() > 1 : seeds.value.size() > 1;
  bool is_equilibrated = false;
  for (const Placed& start : items(source["start"])) {
    const bool is_file = start.value.is_object() && start.value.contains("file");
    is_equilibrated = is_equilibrated || !(is_file || start.value == "crystal");
    if (is_file && has_several_seeds) tells_seeds_apart(file, source, start);
  }
  const auto equilibrate = source.find("equilibrate");
  if (!is_equilibrated && source.is_given("equilibrate"))
    throw fault(file, equilibrate->where,
                shown(equilibrate->value) +
                    " does not go together with \"start\": " + shown(source["start"].value) +
                    ", which is not equilibrated; expected a grid without it");
}

}  // namespace haff::schema
