// SPDX-License-Identifier: GPL-3.0-or-later

// The arithmetic on which the promise of equal bits rests: IEEE 754 doubles, each operation rounded
// to a double at once, in the order in which it is written. engine/arithmetic.cmake refuses flags
// that break this before anything is compiled; this file refuses them wherever they come from.
#pragma once

#include <cfloat>
#include <limits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "haff does not build with -ffast-math or a part of it: its results would no longer repeat."
#endif

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53,
              "haff needs IEEE 754 doubles");
static_assert(FLT_EVAL_METHOD == 0,
              "haff needs doubles that are rounded after every operation: the processor's x87 unit "
              "(-mfpmath=387, 32-bit x86) keeps more digits");
