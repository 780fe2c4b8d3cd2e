// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/pairs.hpp"

namespace haff::analysis {
namespace {

// Cells have half the width of the reach: 125 of them hold fewer particles out of reach than 27
// cells of the full width.
constexpr double cells_in_reach = 2;

}  // namespace

Pairs::Pairs(std::span<const Vector> position, double box, int d, double reach)
    : mesh_{.box = box, .cells = 1, .d = d}, reach_(reach) {
  if (!(reach > 0 && reach <= box / 2))
    throw std::invalid_argument("pairs are told apart up to half of the box");
  const auto particles = static_cast<double>(position.size());
  // More cells than particles would gain nothing in a dilute gas.
  const int most = cells_with(1, particles, d);
  mesh_.cells = std::max(1, static_cast<int>(std::min<double>(most, box / reach * cells_in_reach)));
  const int span = static_cast<int>(std::ceil(reach / mesh_.cell_side()));
  has_cells_ = mesh_.cells > 2 * span;  // no cell is a neighbour of another in two directions

  std::vector<std::size_t> cell(position.size());
  first_.assign(mesh_.size() + 1, 0);
  for (std::size_t i = 0; i < position.size(); ++i) {
    cell[i] = mesh_.number(mesh_.cell_of(position[i]));
    ++first_[cell[i] + 1];
  }
  for (std::size_t c = 0; c < mesh_.size(); ++c) first_[c + 1] += first_[c];
  position_.resize(position.size());
  number_.resize(position.size());
  auto next = first_;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::size_t place = next[cell[i]]++;
    position_[place] = position[i];
    if (d == 2) position_[place][2] = 0;
    number_[place] = static_cast<std::uint32_t>(i);
  }

  const int depth = d == 3 ? span : 0;
  for (int i = 0; i <= span; ++i)
    for (int j = -span; j <= span; ++j)
      for (int k = -depth; k <= depth; ++k) {
        const bool comes_later = i > 0 || j > 0 || (j == 0 && k > 0);
        const auto apart = [&](int cells) {  // the smallest distance along an axis
          return std::max(0, std::abs(cells) - 1) * mesh_.cell_side();
        };
        const double gap2 = apart(i) * apart(i) + apart(j) * apart(j) + apart(k) * apart(k);
        if (comes_later && gap2 < reach * reach) offsets_.push_back({i, j, k});
      }
}

}  // namespace haff::analysis
