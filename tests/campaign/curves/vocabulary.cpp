// SPDX-License-Identifier: GPL-3.0-or-later

// The words of a question, and the SQL made from them.
#include "campaign/curves/vocabulary.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/synthetic_store.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

bool has(const std::vector<std::string>& words, const char* word) {
  return std::ranges::find(words, word) != words.end();
}

const Vocabulary some_words{.columns = {"temperature"},
                            .profiles = {},
                            .parameters = {"d", "e", "n", "N", "roughness.beta"}};

}  // namespace

TEST_CASE("vocabulary: N is the number of particles, which SQLite would take for the density") {
  CHECK(translated("N = 8000 AND n = 0.4", some_words) == "particles = 8000 AND n = 0.4");
  CHECK(translated("roughness.beta > 0", some_words) == "\"roughness.beta\" > 0");
  CHECK(translated("'N' = effects", some_words) == "'N' = effects");
  CHECK(translated("jobs.e = 1", some_words) == "jobs.e = 1");  // no effect is called jobs
}

TEST_CASE("vocabulary: an average over an interval belongs to its middle") {
  CHECK(is_of_interval("gamma_ratio"));
  CHECK(is_of_interval("pressure / n"));
  CHECK_FALSE(is_of_interval("temperature"));
  CHECK(at_middles("2*tau + time") == "2*middle_tau + middle_time");
}

TEST_CASE("vocabulary: a store's columns, profiles and parameters") {
  auto store = schema::Store::in_memory();
  add_finished_with_profiles(store, 0.8, 0.4, 1000, 1, 10, 10, {10});
  add_finished(store,
               {.e = 0.9,
                .n = 0.4,
                .particles = 1000,
                .effects = R"({"roughness":{"beta":0.5,"q":0.4}})",
                .observables = {"laguerre", "temperature"}},
               1, 10);
  const Vocabulary words = vocabulary_of(store);
  for (const char* column : {"time", "temperature", "a6", "energy", "Z"})
    CHECK(has(words.columns, column));
  CHECK(words.profiles == std::vector<std::string>{"G_parallel", "G_perpendicular", "S", "rho"});
  CHECK(has(words.parameters, "roughness.beta"));
  CHECK(has(words.parameters, "roughness.q"));
}
