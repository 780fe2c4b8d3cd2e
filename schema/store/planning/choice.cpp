// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/planning/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>
#include <variant>

#include "schema/database/database.hpp"
#include "schema/database/sql_names.hpp"
#include "schema/grid/suggestion.hpp"
#include "schema/store/planning/claiming.hpp"
#include "schema/store/rows/checked_rows.hpp"

namespace haff::schema {

namespace {

constexpr const char* condition_example = "expected e.g. \"e = 0.9 AND N < 10000\"";
constexpr const char* order_example = "expected e.g. \"seed, N DESC\"";

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::vector<std::string> texts(const Reader& store, const std::string& sql) {
  std::vector<std::string> all;
  Query rows = store.query(sql);
  while (const auto row = rows.next())
    if (const auto* text = std::get_if<std::string>(row->data())) all.push_back(*text);
  return all;
}

// "roughness.beta" of all gases of the store.
std::vector<std::string> effect_parameters(const Reader& store) {
  std::set<std::string> all;
  for (const std::string& text : texts(store, "SELECT DISTINCT effects FROM jobs")) {
    const Effects effects(text);
    for (const auto& [effect, parameters] : effects.by_name())
      for (const auto& [parameter, value] : parameters)
        all.insert(std::string(effect).append(".").append(parameter));
  }
  return {all.begin(), all.end()};
}

bool is_of_table(std::string_view name) {
  const std::string table = lower(name.substr(0, name.find('.')));
  return table == "jobs" || table == "samples" || table == "results" || table == "profiles";
}

// The user's SQL in the columns of jobs.
std::string translated(const Reader& store, const std::string& option, const std::string& typed) {
  std::optional<std::vector<std::string>> known;
  return with_names(typed, [&](std::string_view name) {
    if (name == "N") return std::string("particles");
    if (name.find('.') == std::string_view::npos || is_of_table(name)) return std::string(name);
    if (!known) known = effect_parameters(store);
    if (std::ranges::find(*known, name) == known->end())
      throw QueryError(
          fmt::format("{} \"{}\": no job of the store has a {}{}", option, typed, name,
                      known->empty() ? "" : "; " + suggestion(std::string(name), *known)));
    return fmt::format("(effects ->> '$.{}')", name);
  });
}

// The words of SQLite, with the column that could have been meant in place of an unknown one, or
// with an example.
std::string explained(const Reader& store, std::string reason, const char* example) {
  constexpr std::string_view sql = "SQL: ", unknown = "no such column: ";
  if (reason.starts_with(sql)) reason.erase(0, sql.size());
  if (!reason.starts_with(unknown)) return reason + "; " + example;
  std::vector<std::string> known =
      texts(store, "SELECT name FROM pragma_table_info('jobs') WHERE name NOT LIKE 'owner%'");
  known.emplace_back("N");
  return reason + "; " + suggestion(reason.substr(unknown.size()), known);
}

// What an option takes, in the words of a complaint.
struct Expected {
  const char* option;
  const char* form;
  const char* example;
};
constexpr Expected a_condition{"--where", "a condition over the table jobs", condition_example};
constexpr Expected an_order{"--order", "a list of terms to sort the table jobs by", order_example};

// Compiles a statement around what was typed, and returns its first value.
Value first_value(const Reader& store, const std::string& sql, const std::string& typed,
                  const Expected& expected) {
  try {
    Query query = store.query(sql);
    const auto row = query.next();
    return row ? row->front() : Value(Null{});
  } catch (const QueryError& error) {
    throw QueryError(fmt::format("{} \"{}\" is not {}: {}", expected.option, typed, expected.form,
                                 explained(store, error.what(), expected.example)));
  }
}

std::string shown(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return "'" + *text + "'";
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return "a BLOB";
}

// The text gets a line of its own, so that a comment at its end ends there.
std::string in_brackets(const std::string& sql) {
  return "(" + sql + "\n)";
}

void must_be_condition(const Reader& store, const std::string& typed,
                       const std::string& condition) {
  first_value(store, "SELECT 1 FROM jobs WHERE " + condition + " LIMIT 0", typed, a_condition);
  const Value other = first_value(
      store, fmt::format("SELECT {0} FROM jobs WHERE {0} NOT IN (0, 1) LIMIT 1", condition), typed,
      a_condition);
  if (!std::holds_alternative<Null>(other))
    throw QueryError(
        fmt::format("--where \"{}\" is not {}: it gives {}, neither true nor false; {}", typed,
                    a_condition.form, shown(other), a_condition.example));
}

// Rows of the table jobs, pending and chosen, each as `chosen` beside what is to be done next for
// it, as `jobs`: the job itself, or the equilibration that it waits for.
std::string from_claimable(const Choice& choice) {
  return fmt::format(R"(
    FROM (SELECT *, {} AS place FROM jobs WHERE status = 'pending' AND {}) AS chosen
    LEFT JOIN jobs AS start ON start.job_id = chosen.equilibration_id
    JOIN jobs ON jobs.job_id = iif(start.status = 'pending', start.job_id, chosen.job_id)
    WHERE (chosen.kind = 'equilibration' OR start.status IN ('done', 'pending'))
      AND {} <= :seconds)",
                     choice.order().empty() ? std::string("0")
                                            : "row_number() OVER (ORDER BY " + choice.order() + ")",
                     choice.condition(), seconds_to_next_tau);
}

// The chosen jobs, and the equilibrations that they wait for or have begun at.
std::string counted(const Choice& choice) {
  return fmt::format(R"(
    (SELECT job_id FROM jobs WHERE {0}
     UNION
     SELECT start.job_id FROM (SELECT * FROM jobs WHERE {0}) AS chosen
     JOIN jobs AS start ON start.job_id = chosen.equilibration_id
     WHERE chosen.status IN ('pending', 'running') OR start.status = 'done'))",
                     choice.condition());
}

}  // namespace

Choice::Choice(const Reader& store, const std::string& where, const std::string& order)
    : where_(where), order_(order) {
  if (!where.empty()) {
    const auto names = names_in(lower(where));
    const auto is_named = [&](const char* name) {
      return std::ranges::any_of(names, [&](const std::string& one) {
        return one == name || one == std::string("jobs.") + name;
      });
    };
    names_realizations_ = is_named("seed") || is_named("job_id");
    const std::string condition = in_brackets(translated(store, "--where", where));
    must_be_condition(store, where, condition);
    const bool chooses_any_kind = is_named("kind") || is_named("job_id");
    condition_ = chooses_any_kind ? condition : "(kind = 'cooling' AND " + condition + ")";
  }
  if (!order.empty()) {
    sorted_ = translated(store, "--order", order) + "\n";
    first_value(store,
                fmt::format("SELECT row_number() OVER (ORDER BY {}) FROM jobs LIMIT 0", sorted_),
                order, an_order);
  }
}

std::set<std::int64_t> chosen_jobs(const Reader& store, const Choice& choice) {
  std::set<std::int64_t> ids;
  Query rows = store.query("SELECT job_id FROM jobs WHERE " + choice.condition());
  while (const auto row = rows.next()) ids.insert(std::get<std::int64_t>(row->front()));
  return ids;
}

Summary Selection::summary() const {
  if (choice_.is_everything()) return Store::summary();
  return database().snapshot([&] {
    return summary_of(database().sqlite(),
                      fmt::format("(SELECT * FROM jobs WHERE job_id IN {})", counted(choice_)));
  });
}

bool Selection::has_claimable(const std::optional<Fit>& fit) const {
  if (choice_.is_everything()) return Store::has_claimable(fit);
  return database().guarded([&] {
    SQLite::Statement statement(database().sqlite(),
                                "SELECT 1" + from_claimable(choice_) + " LIMIT 1");
    bind_fit(statement, fit);
    return statement.executeStep();
  });
}

std::optional<double> Selection::least_seconds_to(double tau) const {
  if (choice_.is_everything()) return Store::least_seconds_to(tau);
  return database().guarded([&]() -> std::optional<double> {
    SQLite::Statement statement(
        database().sqlite(),
        fmt::format("SELECT min({}) AS seconds{}", seconds_to_next_tau, from_claimable(choice_)));
    bind_fit(statement, Fit{.seconds = std::numeric_limits<double>::max(), .tau = tau});
    if (!statement.executeStep()) return std::nullopt;
    return optional_real(statement, "seconds");
  });
}

std::optional<Claim> Selection::claim(const Owner& owner, const std::string& code_version,
                                      const std::optional<Fit>& fit) {
  if (choice_.is_everything()) return Store::claim(owner, code_version, fit);
  const std::string select = fmt::format("SELECT jobs.job_id{} ORDER BY chosen.place, {} LIMIT 1",
                                         from_claimable(choice_), usual_order);
  return database().transaction(
      [&] { return claim_first(database(), select, owner, code_version, fit); });
}

std::set<std::int64_t> Selection::job_ids() const {
  std::set<std::int64_t> ids;
  Query rows = query("SELECT job_id FROM jobs WHERE job_id IN " + counted(choice_));
  while (const auto row = rows.next()) ids.insert(std::get<std::int64_t>(row->front()));
  return ids;
}

std::set<std::string> Selection::series() const {
  const auto all = texts(
      *this, "SELECT DISTINCT series FROM jobs WHERE kind = 'cooling' AND " + choice_.condition());
  return {all.begin(), all.end()};
}

}  // namespace haff::schema
