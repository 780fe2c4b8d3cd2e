// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/start.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "schema/grid/source.hpp"

namespace haff::schema {

namespace {

bool is_digest(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

std::string start_text(const Start& start) {
  switch (start.kind) {
    case Start::Kind::uniform:
      return R"("uniform")";
    case Start::Kind::crystal:
      return R"("crystal")";
    case Start::Kind::shear_wave:
      return R"({"shear wave":{"amplitude":)" + text(start.amplitude) + R"(,"waves":)" +
             std::to_string(start.waves) + "}}";
    case Start::Kind::two_temperatures:
      return R"({"two temperatures":{"ratio":)" + text(start.ratio) + "}}";
    case Start::Kind::file:
      return R"({"file":")" + start.digest + R"("})";
  }
  throw std::logic_error("unknown start");
}

Start start_in(const std::string& text) {
  const Json value = Json::parse(text);
  Start start;
  if (value == "crystal") {
    start.kind = Start::Kind::crystal;
  } else if (value.is_object() && value.contains("shear wave")) {
    start.kind = Start::Kind::shear_wave;
    start.amplitude = value["shear wave"].at("amplitude").get<double>();
    start.waves = value["shear wave"].at("waves").get<int>();
    if (!(start.amplitude > 0 && start.amplitude <= largest_amplitude && start.waves > 0))
      throw std::invalid_argument("no gas flows in such a wave");
  } else if (value.is_object() && value.contains("two temperatures")) {
    start.kind = Start::Kind::two_temperatures;
    start.ratio = value["two temperatures"].at("ratio").get<double>();
    if (!(start.ratio > 0)) throw std::invalid_argument("a ratio of temperatures is not above 0");
  } else if (value.is_object() && value.contains("file")) {
    start.kind = Start::Kind::file;
    start.digest = value["file"].get<std::string>();
    if (!is_digest(start.digest)) throw std::invalid_argument("a digest is not 16 digits");
  } else {
    throw std::invalid_argument("no start is written so");
  }
  return start;
}

}  // namespace haff::schema
