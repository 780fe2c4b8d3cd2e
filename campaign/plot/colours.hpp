// SPDX-License-Identifier: GPL-3.0-or-later

// Colours of curves.
#pragma once

#include <cstddef>
#include <string>

namespace haff::campaign {

// Colours that stay apart for the colour-blind and in grey: M. Okabe and K. Ito (2008) for up to
// six curves, shades for more.
std::string colour(std::size_t place, std::size_t of);

// An even walk through viridis, from dark to light, for curves that have an order.
std::string shade(std::size_t place, std::size_t of);

}  // namespace haff::campaign
