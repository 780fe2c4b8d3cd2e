// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/extended_xyz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <istream>
#include <iterator>
#include <map>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <string_view>

#include "engine/mixture.hpp"

namespace haff::campaign {
namespace {

constexpr double radius_of_species_1 =
    0.5;  // the other's is in proportion, if there are two [sigma]
constexpr std::array<const char*, 2> elements{"H", "He"};

// The box and its periods; disks lie in the middle of a layer one diameter high.
std::string cell(const engine::State& state) {
  if (state.d == 2)
    return fmt::format(R"(Lattice="{0} 0 0 0 {0} 0 0 0 1" Origin="0 0 -0.5" pbc="T T F")",
                       state.box);
  return fmt::format(R"(Lattice="{0} 0 0 0 {0} 0 0 0 {0}" Origin="0 0 0" pbc="T T T")", state.box);
}

// Speeds of the surfaces of rough particles, three numbers each by id, scaled like the velocities.
const std::vector<double>* spins_of(const engine::State& state) {
  const auto found = state.memory.find("spin");
  return found == state.memory.end() ? nullptr : &found->second;
}

std::vector<std::size_t> places_by_id(const engine::State& state) {
  std::vector<std::size_t> places(state.id.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(),
            [&](std::size_t a, std::size_t b) { return state.id[a] < state.id[b]; });
  return places;
}

}  // namespace

std::string quoted_for_xyz(const std::string& text) {
  const bool has_double = text.find('"') != std::string::npos;
  if (has_double && text.find('\'') != std::string::npos)
    throw std::invalid_argument(fmt::format("has quotes of both kinds: {}", text));
  const char quote = has_double ? '\'' : '"';
  return quote + text + quote;
}

void write_xyz(const engine::State& state, const std::string& facts, std::ostream& out) {
  constexpr std::size_t chunk = std::size_t{1} << 20;  // [bytes]
  fmt::memory_buffer text;
  const auto flush = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  const auto mixture = mixture_in(state);
  const auto* spins = spins_of(state);
  fmt::format_to(std::back_inserter(text),
                 "{}\n{} Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1{} {}\n",
                 state.particles(), cell(state), spins ? ":omega:R:3" : "", facts);
  for (const std::size_t place : places_by_id(state)) {
    const auto& r = state.position[place];
    const auto& v = state.velocity[place];
    const std::uint32_t id = state.id[place];
    const auto scaled = [&](double value) { return std::ldexp(value, -state.exponent); };
    const double size =
        mixture ? radius_of_species_1 * mixture->diameter_of(id) : radius_of_species_1;
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {} {} {}",
                   elements.at(mixture && mixture->is_second(id) ? 1 : 0), r[0], r[1], r[2],
                   scaled(v[0]), scaled(v[1]), scaled(v[2]), size,
                   mixture ? mixture->mass_of(id) : 1.0, id);
    if (spins != nullptr)
      for (std::size_t axis = 0; axis < 3; ++axis)
        fmt::format_to(std::back_inserter(text), " {}", scaled(spins->at(3 * id + axis)) / size);
    text.push_back('\n');
    if (text.size() > chunk) flush();
  }
  flush();
}

// ---- reading ----------------------------------------------------------------------------------

namespace {

std::invalid_argument wrong(std::size_t line, const std::string& what) {
  return std::invalid_argument(fmt::format("line {}: {}", line, what));
}

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string_view> words;
  for (;;) {
    const auto begin = line.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return words;
    const auto end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

template <class Number>
Number number(std::string_view word, std::size_t line, const char* what) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
  bool is_one = read.ec == std::errc() && read.ptr == word.data() + word.size();
  if constexpr (std::is_floating_point_v<Number>) is_one = is_one && std::isfinite(value);
  if (!is_one) throw wrong(line, fmt::format("'{}' is no {}", word.substr(0, 40), what));
  return value;
}

// key=value, key="a value" and key='a value' of the second line; ASE writes a backslash before a
// quote in quotes.
std::map<std::string, std::string, std::less<>> facts_of(std::string_view line) {
  std::map<std::string, std::string, std::less<>> facts;
  std::size_t at = 0;
  while (at < line.size()) {
    const auto equals = line.find('=', at);
    if (equals == std::string_view::npos) break;
    const auto before = line.find_last_of(" \t", equals);
    const std::size_t begin = before == std::string_view::npos ? at : std::max(at, before + 1);
    std::string value;
    std::size_t end = equals + 1;
    if (end < line.size() && (line[end] == '"' || line[end] == '\'')) {
      const char quote = line[end];
      for (++end; end < line.size() && line[end] != quote; ++end) {
        if (line[end] == '\\' && end + 1 < line.size()) ++end;
        value += line[end];
      }
      ++end;
    } else {
      while (end < line.size() && line[end] != ' ' && line[end] != '\t' && line[end] != '\r')
        value += line[end++];
    }
    facts.insert_or_assign(std::string(line.substr(begin, equals - begin)), value);
    at = end;
  }
  return facts;
}

struct Column {
  std::size_t at = 0, width = 0;
};

// "species:S:1:pos:R:3" as where each column stands, and how many words a line has.
std::map<std::string, Column, std::less<>> columns_of(const std::string& properties,
                                                      std::size_t& words) {
  std::vector<std::string> parts(1);
  for (const char c : properties)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  if (parts.size() % 3 != 0) throw wrong(2, "Properties are not name:kind:width, three by three");
  std::map<std::string, Column, std::less<>> columns;
  words = 0;
  constexpr std::size_t widest = 1000;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    const auto width = number<std::size_t>(parts[k + 2], 2, "width of a column");
    if (width == 0 || width > widest || words > widest) throw wrong(2, "a column is too wide");
    columns[parts[k]] = {words, width};
    words += width;
  }
  return columns;
}

std::vector<double> numbers_of(const std::string& text, const char* what, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(text))
    numbers.push_back(number<double>(word, 2, what));
  if (numbers.size() != count)
    throw wrong(2, fmt::format("{} has {} numbers, and {} expected", what, numbers.size(), count));
  return numbers;
}

void read_cell(const std::map<std::string, std::string, std::less<>>& facts, Frame& frame) {
  const auto lattice = facts.find("Lattice");
  if (lattice == facts.end()) throw wrong(2, "has no Lattice, the cell of the gas");
  const auto axes = numbers_of(lattice->second, "Lattice", 9);
  for (std::size_t k = 0; k < 9; ++k)
    if (k % 4 != 0 && axes[k] != 0)
      throw wrong(2, "the axes of the cell (Lattice) are not x, y and z");
  frame.side = {axes[0], axes[4], axes[8]};
  if (const auto origin = facts.find("Origin"); origin != facts.end()) {
    const auto numbers = numbers_of(origin->second, "Origin", 3);
    std::copy(numbers.begin(), numbers.end(), frame.origin.begin());
  }
  if (const auto pbc = facts.find("pbc"); pbc != facts.end()) {
    const auto words = words_of(pbc->second);
    for (std::size_t k = 0; k < std::min<std::size_t>(3, words.size()); ++k)
      frame.is_periodic[k] = words[k] == "T" || words[k] == "1" || words[k] == "True";
  }
}

}  // namespace

Frame read_xyz(std::istream& in) {
  std::string line;
  if (!std::getline(in, line)) throw wrong(1, "is empty; expected extended XYZ");
  const auto first = words_of(line);
  if (first.size() != 1) throw wrong(1, "is not a number of particles alone");
  const auto count = number<std::uint32_t>(first[0], 1, "number of particles");
  if (!std::getline(in, line)) throw wrong(2, "is missing");
  const auto facts = facts_of(line);
  Frame frame;
  read_cell(facts, frame);
  const auto properties = facts.find("Properties");
  if (properties == facts.end())
    throw wrong(2, "has no Properties, the columns of the lines that follow");
  std::size_t width = 0;
  const auto columns = columns_of(properties->second, width);
  const auto find = [&](std::string_view name, std::size_t wide) -> const Column* {
    const auto found = columns.find(name);
    if (found == columns.end()) return nullptr;
    if (found->second.width != wide)
      throw wrong(2, fmt::format("the column {} has {} numbers, and {} expected", name,
                                 found->second.width, wide));
    return &found->second;
  };
  const Column* pos = find("pos", 3);
  const Column* velo = columns.contains("velo") ? find("velo", 3) : find("vel", 3);
  if (pos == nullptr || velo == nullptr)
    throw wrong(2, "Properties have no pos:R:3 and velo:R:3, positions and velocities");
  if (columns.contains("angular_velocity"))
    throw wrong(2,
                "the column angular_velocity, as earlier versions wrote it, holds speeds of the "
                "surface; divided by the radius they are the column omega");
  const Column *spin = find("omega", 3), *size = find("radius", 1), *mass = find("mass", 1),
               *species = find("species", 1), *id = find("id", 1);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::size_t place = std::size_t{k} + 3;
    if (!std::getline(in, line))
      throw wrong(place, fmt::format("is missing: {} particles expected", count));
    const auto words = words_of(line);
    if (words.size() != width)
      throw wrong(place, fmt::format("has {} columns, and {} expected", words.size(), width));
    const auto vector = [&](const Column& column) {
      engine::Vector v{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        v[axis] = number<double>(words[column.at + axis], place, "finite number");
      return v;
    };
    frame.position.push_back(vector(*pos));
    frame.velocity.push_back(vector(*velo));
    if (spin != nullptr) frame.angular_velocity.push_back(vector(*spin));
    if (size != nullptr) frame.radius.push_back(number<double>(words[size->at], place, "radius"));
    if (mass != nullptr) frame.mass.push_back(number<double>(words[mass->at], place, "mass"));
    frame.species.emplace_back(species == nullptr ? "H" : words[species->at]);
    if (id != nullptr) frame.id.push_back(number<std::uint32_t>(words[id->at], place, "id"));
  }
  while (std::getline(in, line))
    if (!words_of(line).empty())
      throw std::invalid_argument(
          "holds more than one gas; expected one, as campaign export JOB --at TAU writes it");
  return frame;
}

}  // namespace haff::campaign
