// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/document.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <vector>

namespace haff::schema {

namespace {

// Numbers that differ by less come from arithmetic, not from a person: 0.1 + 0.2 is read as 0.3.
// [relative]
constexpr double same_number = 1e-12;

// A grid is nested four deep. Far beyond that, code that follows a value into its depth would run
// out of stack.
constexpr std::size_t deepest = 64;

// "[json.exception.parse_error.101] parse error at line 3, column 7: syntax error while ..."
std::string place_and_reason(const std::string& said) {
  const auto line = said.find("line ");
  return line == std::string::npos ? said : said.substr(line);
}

// Walks through the text and knows at each value where it is.
class Scout : public nlohmann::json_sax<Json> {
 public:
  explicit Scout(std::string file) : file_(std::move(file)) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t number, const string_t& token) override {
    const std::string digits = token.substr(0, token.find_first_of("eE"));
    if (number == 0 && digits.find_first_of("123456789") != std::string::npos)
      throw fault(file_, here(),
                  token + " is too small; expected 0 or a number that a double holds");
    return value();
  }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }

  bool start_object(std::size_t) override { return enter(true); }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override { return enter(false); }
  bool end_array() override { return leave(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.keys.insert(name).second)
      throw fault(file_, here(), "the key is there twice; expected each key once");
    return true;
  }

  bool parse_error(std::size_t, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    constexpr int number_overflow = 406;
    if (error.id == number_overflow)
      throw fault(file_, here(), token + " is too large; expected a finite number");
    throw GridError(file_ + ": is not JSON: " + place_and_reason(error.what()));
  }

 private:
  struct Level {
    bool object;
    std::set<std::string> keys;
    std::string key;
    std::size_t index = 0;
  };

  Pointer here() const {
    Pointer pointer;
    for (const Level& level : levels_)
      if (level.object)
        pointer.push_back(level.key);
      else
        pointer.push_back(std::to_string(level.index));
    return pointer;
  }

  bool enter(bool object) {
    if (levels_.size() == deepest)
      throw fault(file_, here(), "is nested too deeply; expected a grid");
    levels_.push_back({.object = object, .keys = {}, .key = {}});
    return true;
  }

  bool leave() {
    levels_.pop_back();
    return value();
  }

  bool value() {
    if (!levels_.empty()) ++levels_.back().index;
    return true;
  }

  std::string file_;
  std::vector<Level> levels_;
};

// Leaves out what is meant for other programs and for people, and writes each number in one way.
void tidy(Json& value) {
  if (value.is_number_float()) value = shortest_decimal(value.get<double>());
  if (value.is_array())
    for (Json& item : value) tidy(item);
  if (!value.is_object()) return;
  for (auto member = value.begin(); member != value.end();)
    if (member.key().starts_with('_')) {
      member = value.erase(member);
    } else {
      tidy(*member);
      ++member;
    }
}

}  // namespace

GridError fault(const std::string& file, const Pointer& where, const std::string& what) {
  return GridError(file + ": " + (where.empty() ? "" : where.to_string() + ": ") + what);
}

std::string shown(const Json& value) {
  constexpr std::size_t longest = 60;
  const std::string text = value.dump();
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

double shortest_decimal(double value) {
  // Whole numbers, such as seeds, keep their digits.
  if (!std::isfinite(value) || value == std::trunc(value)) return value;
  std::array<char, 32> text;
  constexpr int most_digits = 17;
  for (int digits = 1; digits < most_digits; ++digits) {
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::scientific, digits - 1);
    double shorter = 0;
    std::from_chars(text.data(), end.ptr, shorter);
    if (std::abs(shorter - value) <= same_number * std::abs(value)) return shorter;
  }
  return value;
}

Json read_document(std::string_view text, const std::string& file) {
  Scout scout(file);
  Json::sax_parse(text, &scout);
  Json document = Json::parse(text);
  tidy(document);
  if (document.is_object()) document.erase("$schema");
  return document;
}

}  // namespace haff::schema
