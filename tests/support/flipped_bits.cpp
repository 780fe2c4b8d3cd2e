#include "support/flipped_bits.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace haff::tests {

namespace {

// Small gases, so that rows are as much of the file as states. Every effect, and every observable
// of equal spheres.
constexpr const char* every_effect_and_observable = R"({
  "n": 0.05, "N": 40, "seeds": 1, "tau_max": 4, "equilibrate": 20,
  "observables": ["temperature", "laguerre"],
  "grids": [
    {"e": 0.8, "profiles_every": 2, "fields_at": [2],
     "observables": ["temperature", "laguerre", "distribution", "correlations", "structure",
                     "clusters", "fields"]},
    {"e": 0.8, "effects": [{"restitution": {"law": "threshold", "speed": 0.1}},
                           {"restitution": {"law": "tc", "t_c": 1e-3}}, {"shuffle": {"every": 2}},
                           {"thermostat": {"rate": 0.05}}, {"roughness": {"beta": 0.5, "q": 0.4}},
                           {"mixture": {"fraction": 0.5, "diameter_ratio": 0.8, "mass_ratio": 0.1}}]},
    {"effects": [{"restitution": {"law": "viscoelastic", "A": 0.1}},
                 {"restitution": {"law": "plastic", "speed": 0.1}}]},
    {"d": 2, "e": 0.9}]})";

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// Every value of every table, and the schema; what cannot be read says so.
std::string said(const std::filesystem::path& path) {
  try {
    const SQLite::Database store(path.string(), SQLite::OPEN_READONLY);
    std::string all;
    std::vector<std::string> tables;
    SQLite::Statement schema(
        store, "SELECT type, name, tbl_name, coalesce(sql, '') FROM sqlite_schema ORDER BY 1, 2");
    while (schema.executeStep()) {
      for (int c = 0; c < 4; ++c) all += schema.getColumn(c).getString() + '\n';
      if (schema.getColumn(0).getString() == "table")
        tables.push_back(schema.getColumn(1).getString());
    }
    for (const std::string& table : tables) {
      SQLite::Statement rows(store, "SELECT * FROM \"" + table + "\" NOT INDEXED ORDER BY 1, 2");
      while (rows.executeStep())
        for (int c = 0; c < rows.getColumnCount(); ++c) {
          const SQLite::Column value = rows.getColumn(c);
          all += static_cast<char>('0' + value.getType());
          if (value.isFloat()) {
            char bits[sizeof(double)];
            const double real = value.getDouble();
            std::memcpy(bits, &real, sizeof real);
            all.append(bits, sizeof bits);
          } else {
            all += value.getString();
          }
          all += '\n';
        }
    }
    return all;
  } catch (const SQLite::Exception& error) {
    return std::string("unreadable: ") + error.what();
  }
}

}  // namespace

FlippedBits flip_bits(std::uint64_t seed, int flips) {
  const Folder folder;
  folder.write("grid.json", every_effect_and_observable);
  const Outcome planned = campaign(folder, {"plan", "grid.json"});
  CAPTURE(planned.err);
  REQUIRE(planned.exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  REQUIRE(campaign(folder, {"verify"}).exit_code == 0);
  const std::string sound = bytes_of(folder.store());
  const std::string before = said(folder.store());

  FlippedBits result;
  std::mt19937_64 random(seed);
  for (int k = 0; k < flips; ++k) {
    const std::size_t byte = random() % sound.size();
    const unsigned bit = static_cast<unsigned>(random() % 8);
    std::string damaged = sound;
    damaged[byte] = static_cast<char>(static_cast<unsigned char>(damaged[byte]) ^ (1U << bit));
    write(folder.store(), damaged);
    ++result.flips;
    if (said(folder.store()) == before) continue;
    ++result.telling;
    const Outcome outcome = campaign(folder, {"verify"});
    CAPTURE(byte);
    CAPTURE(bit);
    CAPTURE(outcome.out);
    CHECK(outcome.exit_code != 0);
    CHECK(outcome.exit_code < 128);
    result.found += outcome.exit_code != 0 ? 1 : 0;
  }
  return result;
}

}  // namespace haff::tests
