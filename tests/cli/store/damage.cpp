// SPDX-License-Identifier: GPL-3.0-or-later

// Checkpoints that are damaged are reported and never used.
#include <doctest/doctest.h>

#include <string>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

constexpr const char* short_grid =
    R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": [1, 2], "tau_max": 30})";
constexpr const char* long_grid =
    R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": [1, 2], "tau_max": 60})";

void plan(const Folder& folder, const char* grid) {
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

void run(const Folder& folder, const char* grid) {
  plan(folder, grid);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
}

// The job of this kind with seed 1.
std::string job(const char* kind) {
  return std::string("(SELECT job_id FROM jobs WHERE seed = 1 AND kind = '") + kind + "')";
}

const std::string cut_short = "UPDATE checkpoint_chunks SET bytes = substr(bytes, 1, 1000)";

// A damaged checkpoint is found; the job fails rather than use it; retry and run repair it.
void check(const std::string& damage) {
  const Folder folder;
  run(folder, short_grid);
  const std::string before = rows(folder);
  edit_rows(folder, damage);

  const Outcome verified = campaign(folder, {"verify"});
  CHECK(verified.exit_code == 1);
  CHECK(verified.out.find("damaged") != std::string::npos);
  CHECK(verified.out.find("seed 1") != std::string::npos);
  CHECK(verified.out.find("seed 2") == std::string::npos);

  plan(folder, long_grid);
  const Outcome outcome = campaign(folder, {"run"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("damaged and was not used") != std::string::npos);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'failed'") == 1);

  CHECK(campaign(folder, {"retry"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  const Folder undamaged;
  run(undamaged, long_grid);
  CHECK(rows(folder) == rows(undamaged));
}

}  // namespace

TEST_CASE("damage: a checkpoint cut short is not used") {
  check(cut_short + " WHERE job_id = " + job("cooling"));
}

TEST_CASE("damage: a checkpoint with a changed byte is not used") {
  check(
      "UPDATE checkpoint_chunks SET bytes = CAST(substr(bytes, 1, 5000) || x'ff' || "
      "substr(bytes, 5002) AS BLOB) WHERE job_id = " +
      job("cooling"));
}

TEST_CASE("damage: a checkpoint that is missing a chunk is not used") {
  check("DELETE FROM checkpoint_chunks WHERE job_id = " + job("cooling"));
}

TEST_CASE("damage: cooling does not start from a damaged equilibration") {
  const Folder folder;
  run(folder, R"({"e": 0.9, "n": 0.4, "N": 500, "seeds": [1, 2], "tau_max": 30})");
  edit_rows(folder, cut_short + " WHERE job_id = " + job("equilibration"));
  plan(folder, short_grid);
  const Outcome outcome = campaign(folder, {"run"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("(equilibration n=0.4 N=500 seed 1) is damaged and was not used") !=
        std::string::npos);
  CHECK(campaign(folder, {"retry"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

TEST_CASE("damage: no command blames a job or the command line for a damaged file") {
  const Folder folder;
  run(folder, short_grid);
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 500, "seeds": [1, 2], "tau_max": 30})");
  const auto page =
      static_cast<int>(number(folder, "SELECT rootpage FROM sqlite_schema WHERE name = 'samples'"));
  shell(folder,
        "head -c 4096 /dev/zero | tr '\\0' U | dd of=campaign.db bs=4096 conv=notrunc seek=" +
            std::to_string(page - 1));
  for (const char* command : {"run", "retry", "figures", "verify"}) {
    CAPTURE(std::string(command));
    const Outcome outcome = campaign(folder, {command});
    CHECK(outcome.exit_code == 1);
    CHECK((outcome.out + outcome.err).find("campaign.db: is damaged (") != std::string::npos);
    CHECK((outcome.out + outcome.err).find("campaign retry") == std::string::npos);
  }
  CHECK(campaign(folder, {"query", "SELECT count(*) FROM samples"}).exit_code == 1);
  CHECK(campaign(folder, {"query", "SELECT count(*) FRM samples"}).exit_code == 2);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'failed'") == 0);
}

TEST_CASE("damage: verify names a sample that is missing") {
  const Folder folder;
  run(folder, short_grid);
  edit_rows(folder, "DELETE FROM samples WHERE tau = 7 AND job_id = " + job("cooling"));
  const Outcome outcome = campaign(folder, {"verify"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("tau = 7 is missing") != std::string::npos);
}

TEST_CASE("damage: verify names an energy that is not that of the checkpoint") {
  const Folder folder;
  run(folder, short_grid);
  edit_unnoticed(folder,
                 "UPDATE samples SET temperature = temperature * 1.000001 WHERE tau = 30 "
                 "AND job_id = " +
                     job("cooling"));
  const Outcome outcome = campaign(folder, {"verify"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("the sample at tau = 30") != std::string::npos);
}

TEST_CASE("damage: verify names a damaged page") {
  const Folder folder;
  run(folder, short_grid);
  const Outcome outcome =
      shell(folder,
            "dd if=/dev/urandom of=campaign.db bs=4096 seek=4 count=3 conv=notrunc status=none; "
            "\"$campaign\" verify");
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("campaign.db") != std::string::npos);
}
