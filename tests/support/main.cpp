// SPDX-License-Identifier: GPL-3.0-or-later

// Compiled once, for all test programs: it is the larger part of doctest.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
