// SPDX-License-Identifier: GPL-3.0-or-later

// A question about a store that a plot answers: this against that, with a curve for each gas.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "campaign/accuracy/quantity.hpp"
#include "campaign/curves/vocabulary.hpp"

namespace haff::campaign {

struct Question {
  // What is drawn: a column of samples, an SQL expression in them, or a profile; at one tau or over
  // a window also as one number of each run, "pressure@20", "a2@5:15"; or a quantity of accuracy/
  // quantity.hpp, "tau_c", "gamma_ratio@20".
  std::string y;
  // Against what: tau, time or an expression in columns; the variable of the profile; a parameter
  // or an expression in parameters. Empty: tau, or the profile's variable.
  std::string against = {};
  std::vector<std::string> by = {};  // parameters that colours and legend go by; empty: what varies
  std::string where = {};            // a condition in SQL; empty: all finished runs
  bool log_x = false, log_y = false;
  bool theory = false;
  std::size_t theory_up_to = 1000;  // gases; of more, theory would only be in the way
  // Subtract, seed by seed, the gas whose parameter has this value instead: {"e", "0.9"}; with
  // {"roughness", "none"} the gas without this effect.
  std::optional<std::pair<std::string, std::string>> difference = {};
};

// A question that makes no sense in any store, or that uses a name which this store does not know.
// The message lists the known ones.
struct QuestionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The store has no finished run with what is asked for.
struct NothingToDraw : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What a question means.
struct Topic {
  enum class Kind {
    series,    // an expression in samples against another
    profile,   // a curve in itself
    mean,      // a mean over samples of each run, against parameters
    quantity,  // a quantity of each run, against parameters
  };
  Kind kind = Kind::series;
  std::string y;  // without what stands behind @
  std::string x;
  std::string where;
  std::optional<std::pair<double, double>> window = {};  // of tau, of a mean
  Quantity quantity = {};
};

// Throws QuestionError.
Topic topic_of(const Question& question, const Vocabulary& words);

}  // namespace haff::campaign
