// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/rules.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "schema/embedded.hpp"
#include "schema/grid/suggestion.hpp"

namespace haff::schema {

namespace {

// ---- the schema -------------------------------------------------------------------------------

const Json& schema() {
  static const Json parsed = [] {
    for (const Embedded& file : embedded())
      if (file.name == "grid.schema.json") return Json::parse(file.text);
    throw std::logic_error("the program was built without grid.schema.json");
  }();
  return parsed;
}

const valijson::Schema& compiled() {
  static const valijson::Schema* const rules = [] {
    auto* made = new valijson::Schema;  // never freed: it lives as long as the program
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema()), *made);
    return made;
  }();
  return *rules;
}

const Json& grid_properties() {
  return schema()["definitions"]["grid"]["properties"];
}

// The rule itself where this one only refers to it.
const Json& resolved(const Json& rule) {
  if (!rule.contains("$ref")) return rule;
  return schema().at(Pointer(rule["$ref"].get<std::string>().substr(1)));
}

// The rule for the member or item `token` of what `rule` describes; null if there is none.
const Json* rule_within(const Json& rule, const std::string& token) {
  const Json& here = resolved(rule);
  if (here.contains("properties") && here["properties"].contains(token))
    return &resolved(here["properties"][token]);
  const bool is_place = token.find_first_not_of("0123456789") == std::string::npos;
  if (here.contains("items") && is_place) return &resolved(here["items"]);
  if (here.contains("additionalProperties") && here["additionalProperties"].is_object())
    return &resolved(here["additionalProperties"]);
  if (here.contains("anyOf"))
    for (const Json& alternative : here["anyOf"])
      if (const Json* found = rule_within(alternative, token)) return found;
  return nullptr;
}

const Json* rule_at(const Pointer& where) {
  std::vector<std::string> tokens;
  for (Pointer rest = where; !rest.empty(); rest.pop_back()) tokens.push_back(rest.back());
  const Json* rule = &schema();
  for (auto token = tokens.rbegin(); rule && token != tokens.rend(); ++token)
    rule = rule_within(*rule, *token);
  return rule;
}

// ---- words ------------------------------------------------------------------------------------

std::string quoted(const std::string& word) {
  return '"' + word + '"';
}

// ---- the message ------------------------------------------------------------------------------

// valijson names a place as "<root>", "[grids]", "[1]", "[e]".
Pointer pointer_to(const std::vector<std::string>& context) {
  Pointer pointer;
  for (std::size_t i = 1; i < context.size(); ++i)
    pointer.push_back(context[i].substr(1, context[i].size() - 2));
  return pointer;
}

// Keys that earlier versions knew.
std::optional<std::string> retired(const std::string& key) {
  if (key == "precision") return "is no longer a key: every run is in double; leave it out";
  return std::nullopt;
}

std::optional<std::string> unknown_key(const Json& value, const Json& rule) {
  if (!value.is_object() || !rule.contains("properties")) return std::nullopt;
  for (const auto& [key, member] : value.items())
    if (!rule["properties"].contains(key)) return key;
  return std::nullopt;
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [key, member] : object.items()) names.push_back(key);
  return names;
}

// The words a value may be, if it is one of a few.
std::vector<std::string> enumerated(const Json& rule) {
  if (rule.contains("enum")) return rule["enum"].get<std::vector<std::string>>();
  if (rule.contains("anyOf"))
    for (const Json& alternative : rule["anyOf"])
      if (auto words = enumerated(resolved(alternative)); !words.empty()) return words;
  return {};
}

// All rules that hold for an object: the rule itself, its alternative for objects, and what follows
// from the object's own values ("if" a member has this value, "then").
std::vector<const Json*> rules_of_object(const Json& rule, const Json& value) {
  const Json& here = resolved(rule);
  if (here.contains("anyOf"))
    for (const Json& alternative : here["anyOf"])
      if (resolved(alternative).value("type", "") == "object")
        return rules_of_object(alternative, value);
  std::vector<const Json*> rules{&here};
  if (!here.contains("allOf")) return rules;
  for (const Json& condition : here["allOf"])
    for (const auto& [key, member] : condition["if"]["properties"].items())
      if (value.contains(key) && value[key] == member["const"]) rules.push_back(&condition["then"]);
  return rules;
}

// A key is unknown, or one is missing.
std::optional<GridError> wrong_keys(const Json& value, const Json& rule, const std::string& file,
                                    const Pointer& where) {
  if (!value.is_object() || where.empty()) return std::nullopt;
  const auto rules = rules_of_object(rule, value);
  for (const Json* one : rules)
    if (const auto key = unknown_key(value, *one))
      return fault(file, where / *key,
                   "unknown key; " + suggestion(*key, keys((*one)["properties"])));
  for (const Json* one : rules) {
    if (!one->contains("required")) continue;
    for (const Json& key : (*one)["required"])
      if (!value.contains(key))
        return fault(
            file, where,
            "has no " + quoted(key) + "; expected " +
                resolved((*rules.front())["properties"][key.get<std::string>()])["description"]
                    .get<std::string>());
  }
  return std::nullopt;
}

GridError explanation(const Json& document, const std::string& file, const Pointer& where) {
  const Json& value = document.at(where);
  const Json* rule = rule_at(where);
  if (!rule) throw std::logic_error("grid.schema.json has no rule for " + where.to_string());

  if (const auto key = unknown_key(value, *rule))
    return fault(
        file, where / *key,
        retired(*key).value_or("unknown key; " + suggestion(*key, keys((*rule)["properties"]))));

  // A law of restitution among the effects may take the place of e (examination/combinations.hpp).
  if (value.is_object() && where.empty() && !value.contains("e") && !value.contains("effects"))
    return fault(file, where, "has no \"e\"; expected " + description("e"));
  if (value.is_object() && where.empty())
    for (const std::string& key : required_keys())
      if (!value.contains(key))
        return fault(file, where, "has no " + quoted(key) + "; expected " + description(key));

  if (const auto wrong = wrong_keys(value, *rule, file, where)) return *wrong;

  // Where only one word is possible, the description says more.
  const auto words = enumerated(*rule);
  if (value.is_string() && words.size() > 1)
    return fault(file, where,
                 shown(value) + " is not accepted; " + suggestion(value.get<std::string>(), words));

  return fault(
      file, where,
      shown(value) + " is not accepted; expected " + (*rule)["description"].get<std::string>());
}

}  // namespace

void check_rules(const Json& document, const std::string& file) {
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  if (validator.validate(compiled(), valijson::adapters::NlohmannJsonAdapter(document), &results))
    return;
  // Each enclosing object fails too, and so does each alternative: the deepest one is the cause.
  const auto cause = std::max_element(results.begin(), results.end(), [](auto& a, auto& b) {
    return a.context.size() < b.context.size();
  });
  throw explanation(document, file, pointer_to(cause->context));
}

std::vector<std::string> required_keys() {
  return schema()["then"]["required"].get<std::vector<std::string>>();
}

std::string description(const std::string& key) {
  return grid_properties()[key]["description"].get<std::string>();
}

bool decides_e(const std::string& law) {
  for (const Json& condition : schema()["definitions"]["law"]["allOf"])
    if (condition["if"]["properties"]["law"]["const"] == law)
      return condition["then"].value("decides_e", false);
  return false;
}

Json default_value(const std::string& key) {
  return grid_properties()[key].value("default", Json());
}

}  // namespace haff::schema
