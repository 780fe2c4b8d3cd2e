// SPDX-License-Identifier: GPL-3.0-or-later

// A wanted accuracy in place of a number of seeds.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// A run takes some 5 ms.
std::string grid(const std::string& target) {
  return R"({"e": 0.9, "n": 0.4, "N": 200, "seeds": 5, "tau_max": 10, "target": {)" + target + "}}";
}

// The standard error of the means over a window, from the samples themselves.
constexpr const char* standard_error = R"(
  WITH v AS (SELECT avg(a2) AS x FROM samples JOIN jobs USING (job_id)
             WHERE kind = 'cooling' AND samples.tau BETWEEN 5 AND 10 GROUP BY job_id)
  SELECT sqrt((avg(x * x) - avg(x) * avg(x)) / (count(*) - 1)) FROM v)";

constexpr const char* realizations = "SELECT count(*) FROM jobs WHERE kind = 'cooling'";

Outcome run(const Folder& folder, const std::string& target,
            std::vector<std::string> words = {"run", "--workers", "2"}) {
  folder.write("grid.json", grid(target));
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  return campaign(folder, std::move(words));
}

}  // namespace

TEST_CASE("targets: run adds seeds until the standard error is reached, and says so") {
  const Folder folder;
  const Outcome outcome = run(folder, R"("a2": {"tau": [5, 10], "se": 0.006})");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("met") != std::string::npos);
  CHECK(number(folder, standard_error) <= 0.006);
  CHECK(number(folder, realizations) > 5);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status <> 'done'") == 0);
  // Once the target is met, nothing is left to do.
  const double before = number(folder, realizations);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(number(folder, realizations) == before);
}

TEST_CASE("targets: the added runs are the same as those of more seeds in the grid") {
  const Folder folder;
  run(folder, R"("a2": {"tau": [5, 10], "se": 0.006})");
  const Folder other;
  other.write("grid.json", R"({"e": 0.9, "n": 0.4, "N": 200, "tau_max": 10, "seeds": )" +
                               std::to_string(static_cast<int>(number(folder, realizations))) +
                               "}");
  campaign(other, {"plan", "grid.json"});
  campaign(other, {"run", "--workers", "1"});
  const char* last = R"(
    SELECT a2 FROM samples JOIN jobs USING (job_id)
    WHERE kind = 'cooling' AND samples.tau = 10 ORDER BY seed DESC LIMIT 1)";
  CHECK(number(folder, last) == number(other, last));
}

TEST_CASE("targets: a run whose budget is spent ends with 3, and the next run goes on") {
  const Folder folder;
  const std::string target = R"("a2": {"tau": [5, 10], "se": 1e-4})";
  const Outcome outcome = run(folder, target, {"run", "--workers", "2", "--budget", "0.5s"});
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.out.find("--budget allows 0.50 s") != std::string::npos);
  const bool says_so = outcome.out.find("not met yet") != std::string::npos ||
                       outcome.out.find("waits for runs") != std::string::npos;
  CHECK(says_so);
  CHECK(number(folder, "SELECT sum(cpu_seconds) FROM jobs") < 1.5);
  const double before = number(folder, realizations);
  CHECK(campaign(folder, {"run", "--budget", "0.5s"}).exit_code == 3);
  CHECK(number(folder, realizations) > before);
}

TEST_CASE("targets: plan and status predict the remaining work from the pilot runs") {
  const Folder folder;
  folder.write("grid.json", grid(R"("a2": {"tau": [5, 10], "se": 1e-4})"));
  CHECK(campaign(folder, {"plan", "grid.json"}).out.find("A target's pilot runs") !=
        std::string::npos);
  campaign(folder, {"run", "--budget", "0.1s"});
  CHECK(campaign(folder, {"plan", "grid.json"}).out.find("targets will take some") !=
        std::string::npos);
  const auto status = nlohmann::json::parse(campaign(folder, {"status", "--json"}).out);
  REQUIRE(status["targets"].size() == 1);
  const auto& target = status["targets"][0];
  CHECK(target["realizations_expected"].get<int>() > 1000);
  CHECK(target["cpu_seconds_unplanned"].get<double>() > 0);
  CHECK(status["remaining_cpu_seconds"].get<double>() >=
        target["cpu_seconds_unplanned"].get<double>());
}

TEST_CASE("targets: the prediction from the pilot runs is kept beside the outcome") {
  const Folder folder;
  const Outcome outcome = run(folder, R"("a2": {"tau": [5, 10], "se": 0.006})");
  CHECK(outcome.out.find("were expected after the pilot runs") != std::string::npos);
  CHECK(number(folder, "SELECT count(*) FROM target_outcomes") == 1);
  CHECK(number(folder, "SELECT predicted_realizations FROM target_outcomes") > 5);
  CHECK(number(folder, "SELECT predicted_cpu_seconds FROM target_outcomes") > 0);
  CHECK(number(folder, "SELECT realizations FROM target_outcomes") == number(folder, realizations));
  CHECK(number(folder, "SELECT cpu_seconds FROM target_outcomes") ==
        doctest::Approx(number(folder, "SELECT sum(cpu_seconds) FROM jobs")));
  const double predicted = number(folder, "SELECT predicted_realizations FROM target_outcomes");
  const auto status = nlohmann::json::parse(campaign(folder, {"status", "--json"}).out);
  CHECK(status["targets"][0]["predicted"]["realizations"] == predicted);
}

TEST_CASE("targets: plan --dry-run says that pilot runs come first") {
  const Folder folder;
  folder.write("grid.json", grid(R"("a2": {"tau": [5, 10], "se": 1e-3})"));
  const Outcome outcome = campaign(folder, {"plan", "grid.json", "--dry-run"});
  CHECK(outcome.out.find("a2, tau 5 to 10") != std::string::npos);
  CHECK(outcome.out.find("pilot runs, the 5 seeds of the grid, come first") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.store()));
  // The same for a target that the store does not have yet.
  folder.write("other.json", R"({"e": 0.8, "n": 0.4, "N": 200, "seeds": 5, "tau_max": 10})");
  campaign(folder, {"plan", "other.json"});
  const Outcome later = campaign(folder, {"plan", "grid.json", "--dry-run"});
  CHECK(later.out.find("come first") != std::string::npos);
  CHECK(number(folder, realizations) == 5);
}

TEST_CASE("targets: the remaining work includes pending jobs and jobs that are not planned yet") {
  const Folder folder;
  folder.write("grid.json", grid(R"("a2": {"tau": [5, 10], "se": 1e-4})"));
  const auto target = [&] {
    return nlohmann::json::parse(campaign(folder, {"status", "--json"}).out)["targets"][0];
  };
  campaign(folder, {"plan", "grid.json"});
  CHECK(target()["cpu_seconds_to_come"].get<double>() ==
        doctest::Approx(number(folder, "SELECT sum(expected_cpu_seconds) FROM jobs")));
  CHECK(campaign(folder, {"plan", "grid.json"}).out.find("> 0.0") != std::string::npos);
  campaign(folder, {"run", "--budget", "0.1s"});
  const auto later = target();
  CHECK(later["cpu_seconds_to_come"].get<double>() >= later["cpu_seconds_unplanned"].get<double>());
  CHECK(later["cpu_seconds_unplanned"].get<double>() > 0);
}

TEST_CASE("targets: for a target that more runs cannot reach, the message says why") {
  const Folder folder;
  const Outcome outcome = run(folder, R"("tau_c": {"se": 1})");
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("cannot be met: 5 of 5 runs have no tau_c: plan a larger tau_max") !=
        std::string::npos);
  CHECK(number(folder, realizations) == 5);
}

TEST_CASE("targets: a budget must be a duration") {
  const Folder folder;
  const Outcome outcome = campaign(folder, {"run", "--budget", "much"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("'much' is no duration") != std::string::npos);
}
