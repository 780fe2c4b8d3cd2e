// SPDX-License-Identifier: GPL-3.0-or-later

// Colours and symbols of the gases of a picture.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaign/curves/gas_curves.hpp"
#include "campaign/curves/question.hpp"
#include "campaign/plot/plot.hpp"

namespace haff::campaign {

// A legend of more gases than this becomes a scale of tones, or stands beside the axes.
inline constexpr std::size_t most_in_legend = 10;

// Curves of equal values of what was asked for share a colour, and differ in their symbols.
class Styles {
 public:
  Styles(const Question& question, const std::vector<GasCurve>& curves,
         const std::vector<std::string>& names, const std::string& variable);

  const std::optional<ToneScale>& scale() const { return scale_; }
  // The parameter that a scale of tones shows; empty without one.
  std::string tone() const { return scale_ ? primary_ : std::string(); }

  // Gives the curve of this gas its colour and its symbol.
  void apply(const GasCurve& gas, Curve& curve);

 private:
  std::vector<std::string> by_;
  std::string primary_;
  std::optional<ToneScale> scale_;
  std::vector<std::string> groups_;
  std::map<std::string, std::size_t> seen_;
};

}  // namespace haff::campaign
