// SPDX-License-Identifier: GPL-3.0-or-later

// A full disk: the error is clear, the store is sound, and the same command goes on when there is
// room again.
#include <doctest/doctest.h>

#include <string>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// Six checkpoints of 210 kB each: more than the room given below.
constexpr const char* grid = R"({"e": [0.8, 0.9], "n": 0.4, "N": 4000, "seeds": 2, "tau_max": 30})";

std::string undisturbed_rows() {
  const Folder folder;
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  return rows(folder);
}

}  // namespace

TEST_CASE("full disk: a full file system ends a run with an error and a sound store") {
  const Folder folder;
  folder.write("grid.json", grid);
  // In a namespace of its own as its own root: needs no rights where the kernel allows it.
  if (shell(folder, "unshare --user --map-root-user --mount true").exit_code != 0) {
    MESSAGE("SKIPPED: this machine does not let a user mount a tmpfs");
    return;
  }
  folder.write("in_tmpfs.sh", R"(
    set -e
    mkdir small
    mount -t tmpfs -o size=700k tmpfs small || exit 99
    "$campaign" plan grid.json --store small/campaign.db > /dev/null
    set +e
    "$campaign" run --store small/campaign.db > /dev/null 2> run.err
    echo "run $?"
    "$campaign" verify --store small/campaign.db
    echo "verify $?"
    mount -o remount,size=64m small
    "$campaign" run --store small/campaign.db > /dev/null
    echo "run $?"
    cp small/campaign.db .
  )");
  const Outcome outcome = shell(folder, "unshare --user --map-root-user --mount sh in_tmpfs.sh");
  if (outcome.exit_code == 99) {
    MESSAGE("SKIPPED: this machine does not let a user mount a tmpfs");
    return;
  }
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  const Outcome errors = shell(folder, "cat run.err");
  CAPTURE(errors.out);
  CHECK(errors.out.find("disk is full") != std::string::npos);
  CHECK(outcome.out.find("run 1\n") == 0);
  CHECK(outcome.out.find("verify 0\nrun 0\n") != std::string::npos);
  CHECK(rows(folder) == undisturbed_rows());
}

TEST_CASE("full disk: a limit on the size of files ends a run with an error and a sound store") {
  const Folder folder;
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  // The limit is in blocks of 512 bytes.
  const Outcome limited = shell(folder, "ulimit -f 1000; \"$campaign\" run");
  CHECK(limited.exit_code == 1);
  CHECK(limited.err.find("disk is full") != std::string::npos);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(rows(folder) == undisturbed_rows());
}
