// SPDX-License-Identifier: GPL-3.0-or-later

// Rows that have changed are found, refused and repaired; finished jobs are computed again.
#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

constexpr const char* grid =
    R"({"e": 0.8, "n": 0.2, "N": 300, "seeds": 2, "tau_max": 6, "equilibrate": 20,
        "profiles_every": 3, "fields_at": [3],
        "observables": ["temperature", "laguerre", "distribution", "structure", "fields"]})";

void run(const Folder& folder, const char* text = grid) {
  folder.write("grid.json", text);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
}

// Flips the lowest bit of a real at its first place in the file.
void flip_a_bit_of(const Folder& folder, double value) {
  auto bits = std::bit_cast<std::uint64_t>(value);
  std::string form(sizeof bits, '\0');  // as SQLite writes it
  for (std::size_t k = form.size(); k-- > 0; bits >>= 8U)
    form[k] = static_cast<char>(static_cast<unsigned char>(bits));
  std::ifstream in(folder.store(), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = bytes.find(form);
  REQUIRE(at != std::string::npos);
  bytes[at + form.size() - 1] = static_cast<char>(bytes[at + form.size() - 1] ^ 1);
  std::ofstream(folder.store(), std::ios::binary | std::ios::trunc) << bytes;
}

bool holds(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

const char* const harm[] = {
    "UPDATE samples SET pressure = pressure * 1.0000001 WHERE job_id = 3 AND tau = 4",
    "UPDATE profiles SET value = value + 1 WHERE job_id = 3 AND tau = 6 AND name = 'rho'",
    "UPDATE fields SET data = zeroblob(length(data)) WHERE job_id = 3",
    "DELETE FROM samples WHERE job_id = 3 AND tau = 6",
    "UPDATE results SET tau_c = 3 WHERE job_id = 3",
    "UPDATE invariants SET past_events = 7 WHERE job_id = 3",
    // A change that is smaller than the differences between two C libraries.
    "UPDATE samples SET gamma_ratio = gamma_ratio * (1 + 1e-14) WHERE job_id = 3 AND tau = 4",
};

}  // namespace

TEST_CASE("digests: a changed row is found, named, not averaged, and repaired") {
  for (const char* sql : harm) {
    CAPTURE(std::string(sql));
    const Folder folder;
    run(folder);
    const std::string before = rows(folder);
    edit_rows(folder, sql);

    const Outcome verified = campaign(folder, {"verify"});
    CHECK(verified.exit_code == 1);
    CHECK(holds(verified.out, "job 3 "));
    CHECK(holds(verified.out, "not as they were written"));
    CHECK(holds(verified.out, "verify --repair"));
    if (std::string(sql).find("samples") != std::string::npos) {
      const Outcome figures = campaign(folder, {"figures", "--out", "figures", "--only", "1"});
      CHECK(figures.exit_code == 1);
      CHECK(holds(figures.err, "job 3: its samples are not as they were written"));
    }

    const Outcome repaired = campaign(folder, {"verify", "--repair"});
    CHECK(repaired.exit_code == 0);
    CHECK(holds(repaired.out, "computed again"));
    CHECK(rows(folder) == before);
    CHECK(campaign(folder, {"verify"}).exit_code == 0);
  }
}

TEST_CASE("digests: a changed row enters no average, and is itself shown with a warning") {
  struct Case {
    const char* harm;
    std::vector<std::string> refused, shown;
  };
  const std::vector<std::string> report{"report"}, plot{"plot", "temperature"};
  for (const Case& one :
       {Case{harm[0],
             {"SELECT avg(pressure) FROM mean_series", "SELECT count(*) FROM Mean_Series"},
             {"SELECT pressure FROM samples WHERE job_id = 3"}},
        Case{harm[1], {"SELECT * FROM mean_profiles"}, {"SELECT count(*) FROM profiles"}},
        Case{harm[2], {}, {"SELECT name, length(data) FROM fields"}},
        Case{harm[4], {"SELECT tau_c FROM mean_tau_c"}, {"SELECT * FROM results"}},
        Case{"UPDATE jobs SET e = 0.9 WHERE job_id = 3",
             {"SELECT * FROM mean_series", "SELECT * FROM mean_tau_c"},
             {}}}) {
    CAPTURE(std::string(one.harm));
    const Folder folder;
    run(folder);
    edit_rows(folder, one.harm);
    for (const std::string& sql : one.refused) {
      CAPTURE(sql);
      const Outcome outcome = campaign(folder, {"query", sql});
      CHECK(outcome.exit_code == 1);
      CHECK(outcome.out.empty());
      CHECK(holds(outcome.err, "job 3"));
      CHECK(holds(outcome.err, "campaign verify --repair"));
    }
    for (const std::string& sql : one.shown) {
      CAPTURE(sql);
      const Outcome outcome = campaign(folder, {"query", sql});
      CHECK(outcome.exit_code == 0);
      CHECK_FALSE(outcome.out.empty());
      CHECK(holds(outcome.err, "Warning: "));
      CHECK(holds(outcome.err, "job 3: "));
    }
    if (one.harm == harm[0])
      for (const auto& words : {report, plot}) {
        const Outcome outcome = campaign(folder, words);
        CHECK(outcome.exit_code == 1);
        CHECK(holds(outcome.err, "job 3: its samples are not as they were written"));
      }
    const Outcome other = campaign(folder, {"query", "SELECT job_id FROM jobs"});
    CHECK(other.exit_code == 0);
    CHECK(other.err.empty());
  }
}

TEST_CASE("digests: retry computes a job with changed rows again") {
  const Folder folder;
  run(folder);
  const std::string before = rows(folder);
  edit_rows(folder, harm[0]);
  const Outcome retried = campaign(folder, {"retry"});
  CHECK(retried.exit_code == 0);
  CHECK(holds(retried.out, "job 3 "));
  CHECK(holds(retried.out, "dropped"));
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(rows(folder) == before);
}

TEST_CASE("digests: finished jobs have the same rows when computed again") {
  const Folder folder;
  run(folder);
  const Outcome all = campaign(folder, {"verify", "--recompute", "all"});
  CHECK(all.exit_code == 0);
  CHECK(holds(all.out, "4 finished jobs computed again, every bit the same"));
  const Outcome half = campaign(folder, {"verify", "--recompute", "50%"});
  CHECK(holds(half.out, "2 finished jobs computed again"));
  const Outcome one = campaign(folder, {"verify", "--recompute", "3"});
  CHECK(holds(one.out, "1 finished job computed again"));

  for (const char* word : {"0", "none", "101%", "-5%", "0%", "3x", ""}) {
    CAPTURE(std::string(word));
    CHECK(campaign(folder, {"verify", "--recompute", word}).exit_code == 2);
  }
  CHECK(campaign(folder, {"verify", "--recompute", "99"}).exit_code == 2);
}

TEST_CASE("digests: a value that was already wrong when written is found by computing it again") {
  const Folder folder;
  run(folder);
  const std::string before = rows(folder);
  edit_unnoticed(folder, "UPDATE samples SET a4 = a4 + 1e-9 WHERE job_id = 4 AND tau = 2");
  CHECK(campaign(folder, {"verify"}).exit_code == 0);  // the digests match
  const Outcome outcome = campaign(folder, {"verify", "--recompute", "all"});
  CHECK(outcome.exit_code == 1);
  CHECK(holds(outcome.out, "job 4 "));
  CHECK(holds(outcome.out, "tau = 2: a4 is "));
  CHECK(holds(outcome.out, "verify --recompute all --repair"));

  // verify --repair alone cannot see this, as the digests are those of the wrong value.
  CHECK(campaign(folder, {"verify", "--repair"}).exit_code == 0);
  CHECK(rows(folder) != before);
  const Outcome repaired = campaign(folder, {"verify", "--recompute", "4", "--repair"});
  CHECK(repaired.exit_code == 0);
  CHECK(holds(repaired.out, "a third computation is like the second; 1 row is replaced"));
  CHECK_FALSE(holds(repaired.out, "so is its state"));
  CHECK(rows(folder) == before);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(campaign(folder, {"verify", "--recompute", "all", "--repair"}).exit_code == 0);
}

TEST_CASE("digests: rows of an older program have no digest, and get one") {
  const Folder folder;
  run(folder);
  edit_unnoticed(folder, "SELECT 1");
  const Outcome without = campaign(folder, {"verify"});
  CHECK(without.exit_code == 0);
  CHECK(holds(without.out, "4 of its jobs have no digest"));
  CHECK(campaign(folder, {"verify", "--repair"}).exit_code == 0);
  const Outcome with = campaign(folder, {"verify"});
  CHECK(with.exit_code == 0);
  CHECK_FALSE(holds(with.out, "digest"));
}

TEST_CASE("digests: a flipped bit in a job's parameters is repaired") {
  const Folder folder;
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  edit_rows(folder, "UPDATE jobs SET tau_max = 3 WHERE job_id = 3");  // one bit from 6
  const Outcome outcome = campaign(folder, {"run"});
  CHECK(outcome.exit_code == 1);
  CHECK(number(folder, "SELECT count(*) FROM samples WHERE job_id = 3") == 0);
  const Outcome repaired = campaign(folder, {"verify", "--repair"});
  CHECK(repaired.exit_code == 0);
  CHECK(holds(repaired.out, "tau_max is 6 again, and was 3"));
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(number(folder, "SELECT max(tau) FROM samples WHERE job_id = 3") == 6);
}

TEST_CASE("digests: an index that disagrees with its table is rebuilt") {
  const Folder folder;
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  flip_a_bit_of(folder, number(folder, "SELECT expected_cpu_seconds FROM jobs WHERE job_id = 3"));
  const Outcome verified = campaign(folder, {"verify"});
  CHECK(verified.exit_code == 1);
  CHECK(holds(verified.out, "missing from index jobs_to_claim"));
  CHECK(holds(verified.out, "verify --repair"));
  CHECK_FALSE(holds(verified.out, "backup"));
  CHECK(campaign(folder, {"verify", "--repair"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
}

TEST_CASE("digests: SQLite's statistics of table sizes are rebuilt") {
  const Folder folder;
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  edit_rows(folder, "UPDATE sqlite_stat1 SET stat = '1010' WHERE tbl = 'jobs'");
  const Outcome verified = campaign(folder, {"verify"});
  CHECK(verified.exit_code == 1);
  CHECK(holds(verified.out, "sqlite_stat1"));
  CHECK(campaign(folder, {"verify", "--repair"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}
