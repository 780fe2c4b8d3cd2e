// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign submit` with scripts in the place of Slurm. Whatever is refused, cut off or lost, the
// next submit knows which shards are lent and goes on from there.
#include <doctest/doctest.h>

#include <csignal>

#include "support/divided_campaign.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

constexpr const char* small_grid = R"({
  "e": [0.8, 0.9], "n": 0.3, "N": 200, "seeds": 3, "tau_max": 20, "equilibrate": 20})";

// This sbatch numbers its calls and keeps their arguments in a file; squeue prints a file. A file
// named "refuse" says how often sbatch refuses; with a file "refuse_only", only calls that have its
// word among their arguments are refused.
constexpr const char* fake_sbatch = R"SH(#!/bin/sh
cd "$(dirname "$0")"
if [ -s refuse ] && { [ ! -e refuse_only ] || echo "$*" | grep -q -e "$(cat refuse_only)"; }; then
  sed -i 1d refuse
  echo "sbatch: error: no" >&2
  exit 1
fi
echo "$*" >> submitted
wc -l < submitted
)SH";

void fake_slurm(const Folder& folder) {
  std::filesystem::create_directory(folder / "bin");
  folder.write("bin/sbatch", fake_sbatch);
  folder.write("bin/squeue", "#!/bin/sh\ncat \"$(dirname \"$0\")/queue\"\n");
  folder.write("bin/scancel", "#!/bin/sh\necho \"$1\" >> \"$(dirname \"$0\")/cancelled\"\n");
  REQUIRE(shell(folder, "chmod +x bin/*; touch bin/queue bin/submitted").exit_code == 0);
}

// Runs the lines for PBS and HTCondor. PBS runs the script that it reads once for each number.
constexpr const char* by_other_schedulers = R"SH(
mkdir bin
cat > bin/qsub <<'END'
#!/bin/sh
cat > script
for PBS_ARRAY_INDEX in 1 2 3; do
  export PBS_ARRAY_INDEX
  (script=$PWD/script; cd / && sh "$script") || exit 1
done
END
printf '#!/bin/sh\ncat > for_condor\n' > bin/condor_submit
chmod +x bin/*
PATH=$PWD/bin:$PATH
"$campaign" split --into 3
sh -e -c "$(sed -n 's/^  PBS *//p' said)" && sh -e -c "$(sed -n 's/^  HTCondor *//p' said)"
)SH";

Outcome submit_here(const Folder& folder, const std::string& options = "") {
  return shell(folder,
               "PATH=$PWD/bin:$PATH exec \"$campaign\" submit --tasks 3 --time 1h " + options);
}

void queue(const Folder& folder, const std::string& jobs) {
  folder.write("bin/queue", jobs);
}

std::string word_of(const Folder& folder, const std::string& file) {
  return shell(folder, "cat " + file).out;
}

void run_shards(const Folder& folder, const std::string& shards) {
  REQUIRE(shell(folder, "for s in " + shards + "; do \"$campaign\" task $s || exit 1; done")
              .exit_code == 0);
}

double count_jobs(const Folder& folder, const std::string& status) {
  return number(folder, "SELECT count(*) FROM jobs WHERE status = '" + status + "'");
}

}  // namespace

TEST_CASE("submit: a running round is left alone, and one that has ended is merged") {
  const Folder folder;
  fake_slurm(folder);
  plan(folder, small_grid);
  REQUIRE(submit_here(folder).exit_code == 0);
  CHECK(tasks_job(folder, 1) == "1");

  queue(folder, "1\n1\n2\n");
  const Outcome refused = submit_here(folder);
  CHECK(refused.exit_code == 1);
  CHECK_MESSAGE(refused.err.find("round 1 is at work, as Slurm job 1") != std::string::npos,
                refused.err);
  CHECK(refused.err.find("scancel 2 1") != std::string::npos);

  // The job that merges is gone: the tasks get a new one.
  queue(folder, "1\n1\n");
  CHECK(submit_here(folder).out.find("submitted again, as job 3") != std::string::npos);
  queue(folder, "1\n3\n");
  CHECK(submit_here(folder).exit_code == 1);

  // All tasks were cancelled after one of them had ended.
  run_shards(folder, "shards/shard-001.db");
  queue(folder, "");
  const Outcome next = submit_here(folder);
  CHECK(next.exit_code == 0);
  CHECK_MESSAGE(next.out.find("shard-001: ") != std::string::npos, next.out);
  CHECK(next.out.find("Round 2: ") != std::string::npos);
  CHECK(count_jobs(folder, "done") > 0);
  CHECK_FALSE(std::filesystem::exists(folder / "shards/shard-001.db"));

  run_shards(folder, "shards/shard-*.db");
  CHECK(submit_here(folder).exit_code == 0);
  check_completed(folder, undisturbed_rows(small_grid));
}

TEST_CASE("submit: no more rounds than --rounds allows, and none after a round without progress") {
  const Folder folder;
  fake_slurm(folder);
  plan(folder, small_grid);
  REQUIRE(submit_here(folder, "--rounds 1").exit_code == 0);
  run_shards(folder, "shards/shard-001.db");
  const Outcome last = shell(folder, "PATH=$PWD/bin:$PATH sh shards/round-001.merge.sh");
  CHECK(last.exit_code == 3);
  CHECK_MESSAGE(last.out.find("Work is left after the last round") != std::string::npos, last.out);
  CHECK_MESSAGE(last.out.find("Next: campaign submit --tasks 3") != std::string::npos, last.out);

  REQUIRE(submit_here(folder).exit_code == 0);
  const Outcome nothing = shell(folder, "PATH=$PWD/bin:$PATH sh shards/round-002.merge.sh");
  CHECK(nothing.exit_code == 1);
  CHECK_MESSAGE(nothing.err.find("no task has brought anything home") != std::string::npos,
                nothing.err);
  CHECK(count_jobs(folder, "lent") == 0);
}

TEST_CASE(
    "submit: shards that sbatch refuses are taken back; an unattended round first tries again") {
  const Folder folder;
  fake_slurm(folder);
  plan(folder, small_grid);
  folder.write("bin/refuse", "once\n");
  folder.write("bin/refuse_only", "--dependency");
  const Outcome refused = submit_here(folder);
  CHECK(refused.exit_code == 1);
  CHECK_MESSAGE(refused.err.find("sbatch refused this: sbatch --parsable") != std::string::npos,
                refused.err);
  CHECK(word_of(folder, "bin/cancelled") == "1\n");
  CHECK(count_jobs(folder, "lent") == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "shards/shard-001.db"));

  REQUIRE(submit_here(folder).exit_code == 0);
  run_shards(folder, "$(ls shards/shard-*.db | head -n 1)");
  folder.write("bin/refuse", "once\ntwice\n");
  CHECK(shell(folder, "PATH=$PWD/bin:$PATH sh shards/round-001.merge.sh").exit_code == 0);
  CHECK(std::filesystem::exists(folder / "shards/round-002.json"));
}

TEST_CASE("submit: after a kill at any moment, the next submit knows which shards are lent") {
  const std::string expected = undisturbed_rows(small_grid);
  std::mt19937 random(5);
  const Folder folder;
  fake_slurm(folder);
  plan(folder, small_grid);
  int killed = 0;
  for (int round = 0; round < 30; ++round) {
    Program program(folder, {"/bin/sh", "-c",
                             "PATH=$PWD/bin:$PATH exec \"$campaign\" submit --tasks 3 --time 1h"});
    sleep_for(std::chrono::milliseconds(random() % 120));
    program.signal(SIGKILL);
    killed += program.wait().exit_code == 128 + SIGKILL ? 1 : 0;
  }
  CHECK(killed >= 10);
  const Outcome next = submit_here(folder);
  CHECK_MESSAGE(next.exit_code == 0, next.err);
  run_shards(folder, "shards/shard-*.db");
  CHECK(submit_here(folder).exit_code == 0);
  check_completed(folder, expected);
}

TEST_CASE("submit: without sbatch the lines for other schedulers are printed, and they work") {
  const Folder folder;
  plan(folder, small_grid);
  const Outcome outcome =
      shell(folder, "PATH=/nowhere \"$campaign\" submit --tasks 3 --cpus 2 --time 1h");
  CHECK(outcome.exit_code == 1);
  for (const char* word :
       {"no sbatch", "campaign split --into 3", "GNU parallel  parallel -j 3",
        "| qsub -J 1-3 -l select=1:ncpus=2", "| condor_submit", "campaign merge"})
    CHECK_MESSAGE(outcome.err.find(word) != std::string::npos, outcome.err);
  CHECK(count_jobs(folder, "lent") == 0);

  // PBS runs the script once for each number; the script comes through a pipe.
  folder.write("said", outcome.err);
  const Outcome pbs = shell(folder, by_other_schedulers);
  CHECK_MESSAGE(pbs.exit_code == 0, pbs.err);
  CHECK(campaign(folder,
                 {"merge", "shards/shard-001.db", "shards/shard-002.db", "shards/shard-003.db"})
            .exit_code == 0);
  check_completed(folder, undisturbed_rows(small_grid));
  const std::string condor = word_of(folder, "for_condor");
  for (const char* line : {"arguments = task --workers 2 $(shard)\n", "request_cpus = 2\n",
                           "queue shard matching files /"})
    CHECK_MESSAGE(condor.find(line) != std::string::npos, condor);
}
