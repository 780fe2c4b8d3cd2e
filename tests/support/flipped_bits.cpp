// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/flipped_bits.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace haff::tests {

namespace {

// Small gases, so that rows take as much of the file as states: every effect, and every observable
// of equal spheres. tau_max is to be put in front.
constexpr const char* every_effect_and_observable = R"(
  "n": 0.05, "N": 40, "seeds": 1, "equilibrate": 20,
  "observables": ["temperature", "laguerre"],
  "grids": [
    {"e": 0.8, "profiles_every": 2, "fields_at": [2],
     "sample_at": {"tau": [0.3], "time": {"log": 2}}, "snapshots_at": {"tau": [0, 2.5], "time": [1]},
     "observables": ["temperature", "laguerre", "distribution", "tail", "correlations",
                     "structure", "pair_distribution", "energy_spectrum", "clusters",
                     "cluster_sizes", "collision_statistics", "msd", "vacf@2", "fields"]},
    {"e": 0.8, "effects": [{"restitution": {"law": "threshold", "speed": 0.1}},
                           {"restitution": {"law": "tc", "t_c": 1e-3}}, {"shuffle": {"every": 2}},
                           {"thermostat": {"rate": 0.05}}, {"roughness": {"beta": 0.5, "q": 0.4}},
                           {"mixture": {"fraction": 0.5, "diameter_ratio": 0.8, "mass_ratio": 0.1}}]},
    {"effects": [{"restitution": {"law": "viscoelastic", "A": 0.1}},
                 {"restitution": {"law": "plastic", "speed": 0.1}}]},
    {"d": 2, "e": 0.9, "start": ["uniform", "crystal", "shear wave", "two temperatures"]}]})";

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// Every value of every table, and the schema; an unreadable store gives the error instead.
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
      SQLite::Statement rows(store, "SELECT * FROM \"" + table + "\" NOT INDEXED");
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

std::string grid(int tau_max) {
  return "{\"tau_max\": " + std::to_string(tau_max) + "," + every_effect_and_observable;
}

// ---- which bit --------------------------------------------------------------------------------

struct Bit {
  std::size_t byte = 0;
  unsigned number = 0;  // in that byte
  std::string where = {};

  std::string flipped(std::string bytes) const {
    bytes[byte] = static_cast<char>(static_cast<unsigned char>(bytes[byte]) ^ (1U << number));
    return bytes;
  }
};

Bit anywhere(const std::string& bytes, std::mt19937_64& random) {
  const std::size_t byte = random() % bytes.size();
  return {byte, static_cast<unsigned>(random() % 8), "anywhere"};
}

// A value as it stands in the file, or a piece of it where it is long: SQLite writes a real with
// its first byte first, and texts and BLOBs as they are. Empty for values that are too short to be
// found.
std::string form_in_file(const SQLite::Column& value, std::mt19937_64& random) {
  constexpr std::size_t enough = 8, piece = 24;
  if (value.isFloat()) {
    auto bits = std::bit_cast<std::uint64_t>(value.getDouble());
    std::string bytes(sizeof bits, '\0');
    for (std::size_t k = bytes.size(); k-- > 0; bits >>= 8U)
      bytes[k] = static_cast<char>(static_cast<unsigned char>(bits));
    return bytes;
  }
  if (!value.isText() && !value.isBlob()) return "";
  const std::string bytes(static_cast<const char*>(value.getBlob()),
                          static_cast<std::size_t>(value.getBytes()));
  if (bytes.size() < enough) return "";
  return bytes.size() <= piece ? bytes : bytes.substr(random() % (bytes.size() - piece), piece);
}

// The tables from which means and figures are made, or a job goes on.
constexpr std::array tables{
    "samples",         "samples",           "profiles", "fields",     "snapshots",
    "snapshot_chunks", "checkpoint_chunks", "results",  "invariants", "jobs"};

// A bit of a value in a random row; nothing where its bytes stand in several places.
std::optional<Bit> of_a_value(SQLite::Database& store, const std::string& bytes,
                              std::mt19937_64& random) {
  const std::string table = tables[random() % tables.size()];
  const int rows = store.execAndGet("SELECT count(*) FROM " + table).getInt();
  if (rows == 0) return std::nullopt;
  SQLite::Statement row(store, "SELECT * FROM " + table + " LIMIT 1 OFFSET ?");
  row.bind(1, static_cast<int>(random() % static_cast<unsigned>(rows)));
  row.executeStep();
  const int column = static_cast<int>(random() % static_cast<unsigned>(row.getColumnCount()));
  const std::string form = form_in_file(row.getColumn(column), random);
  const std::size_t at = form.empty() ? std::string::npos : bytes.find(form);
  if (at == std::string::npos || bytes.find(form, at + 1) != std::string::npos) return std::nullopt;
  return Bit{at + random() % form.size(), static_cast<unsigned>(random() % 8),
             table + "." + row.getColumnName(column)};
}

// ---- a store and what becomes of it -----------------------------------------------------------

class Flips {
 public:
  Flips(std::uint64_t seed, bool half_run) : random_(seed), is_half_run_(half_run) {
    plan(half_run ? 5 : 10);
    must_succeed({"run"});
    if (half_run) plan(10);
    must_succeed({"verify"});
    sound_ = bytes_of(folder_.store());
    before_ = said(folder_.store());
    REQUIRE(before_.find("unreadable: ") == std::string::npos);
    must_succeed({"run"});
    expected_ = rows(folder_);
  }

  FlippedBits flip(int flips, BitsOf of) {
    write(folder_.store(), sound_);
    std::vector<Bit> bits;
    {
      SQLite::Database store(folder_.store().string(), SQLite::OPEN_READONLY);
      while (bits.size() < static_cast<std::size_t>(flips))
        if (const auto bit = of == BitsOf::values ? of_a_value(store, sound_, random_)
                                                  : anywhere(sound_, random_))
          bits.push_back(*bit);
    }
    FlippedBits result;
    for (const Bit& bit : bits) try_one(bit, of, result);
    return result;
  }

 private:
  void plan(int tau_max) {
    folder_.write("grid.json", grid(tau_max));
    must_succeed({"plan", "grid.json"});
  }

  void must_succeed(const std::vector<std::string>& words) const {
    const Outcome outcome = campaign(folder_, words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
  }

  int exit_code(const std::vector<std::string>& words) {
    outcome_ = campaign(folder_, words);
    said_ += words.front() + (words.size() > 1 ? " " + words[1] : "") + ": exit " +
             std::to_string(outcome_.exit_code) + "\n" + outcome_.out + outcome_.err;
    CHECK(outcome_.exit_code < 128);
    return outcome_.exit_code;
  }

  void try_one(const Bit& bit, BitsOf of, FlippedBits& result) {
    write(folder_.store(), bit.flipped(sound_));
    ++result.flips;
    if (said(folder_.store()) == before_) return;
    ++result.telling;
    said_.clear();
    CAPTURE(bit.where);
    CAPTURE(bit.byte);
    CAPTURE(bit.number);
    // A run may end well, if it computes the wrong rows again, or it may stop at them; it never
    // ends well with other rows.
    const bool is_found =
        is_half_run_ && random_() % 2 == 0
            ? exit_code({"run"}) != 0 || exit_code({"verify"}) != 0 || rows(folder_) == expected_
            : exit_code({"verify"}) != 0;
    CAPTURE(said_);
    CHECK(is_found);
    result.found += is_found ? 1 : 0;
    // Where the bit is one of SQLite's own, only a backup helps.
    if (of != BitsOf::values) return;
    const bool is_mended = mend();
    CAPTURE(said_);
    CHECK(is_mended);
    result.mended += is_mended ? 1 : 0;
  }

  // Mends as verify advises. Returns whether all rows are then those of the store without the flip.
  bool mend() {
    exit_code({"verify", "--repair"});
    exit_code({"retry"});
    return exit_code({"run"}) == 0 && exit_code({"verify"}) == 0 && rows(folder_) == expected_;
  }

  Folder folder_;
  std::mt19937_64 random_;
  bool is_half_run_;
  std::string sound_, before_, expected_, said_;
  Outcome outcome_;
};

}  // namespace

FlippedBits flip_bits(std::uint64_t seed, int flips, BitsOf of, Store store) {
  return Flips(seed, store == Store::half_run).flip(flips, of);
}

}  // namespace haff::tests
