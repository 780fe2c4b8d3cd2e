// SPDX-License-Identifier: GPL-3.0-or-later

// The effects of a gas beyond constant restitution, which a grid asks for and a job has, parsed
// once; and what a JSON schema cannot say of them: which do not go together, which matter at e = 1,
// and which leave Haff's law as it is.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace haff::schema {

// Of each effect the parameters by name, which are all numbers. The law of restitution, which has a
// name, stands apart.
class Effects {
 public:
  using Parameters = std::map<std::string, double>;
  using ByName = std::map<std::string, Parameters, std::less<>>;

  Effects() = default;
  // A JSON object as in a grid, without lists: {"roughness":{"beta":0.5,"q":0.4}}. Throws
  // std::invalid_argument if it is none.
  Effects(std::string_view json);
  Effects(const char* json) : Effects(std::string_view(json)) {}
  Effects(const std::string& json) : Effects(std::string_view(json)) {}

  // JSON with sorted keys and without spaces: a part of a job's identity, as in the column
  // jobs.effects.
  const std::string& text() const { return text_; }

  bool none() const { return by_name_.empty(); }
  bool contains(std::string_view effect) const { return by_name_.contains(effect); }
  const ByName& by_name() const { return by_name_; }

  // The parameter of an effect, or nothing where the gas has no such effect or the effect has no
  // such parameter.
  std::optional<double> parameter(std::string_view effect, const std::string& name) const;

  // The name of the law of restitution; "constant" where none is asked for. Its parameters are
  // those of the effect "restitution".
  const std::string& law() const { return law_; }

  bool operator==(const Effects& other) const { return text_ == other.text_; }
  auto operator<=>(const Effects& other) const { return text_ <=> other.text_; }

 private:
  std::string text_ = "{}";
  std::string law_ = "constant";
  ByName by_name_;
};

// The law of restitution that gives every collision an e of its own, if they name one; there is
// then no e to choose.
std::optional<std::string> law_without_e(const Effects& effects);

// Why a gas cannot have all these effects at once, or nothing.
std::optional<std::string> nonsense(const Effects& effects);

// One of them with which a gas of constant e does not cool as Haff's law says, or nothing.
std::optional<std::string> beyond_haffs_law(const Effects& effects);

// Whether collisions lose energy even where e = 1: those of rough spheres do, unless the surfaces
// slip freely or grip perfectly.
bool lose_energy_at_e_1(const Effects& effects);

// Those of a job's effects that its equilibration has too, since they change the equilibrium.
Effects effects_of_equilibration(const Effects& effects);

}  // namespace haff::schema
