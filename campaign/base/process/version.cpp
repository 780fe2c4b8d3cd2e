// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/process/version.hpp"

#include <fmt/format.h>

#include "commit.hpp"  // made by commit.cmake at each build
#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

#if defined(__clang__)
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

}  // namespace

std::string code_version() {
  return fmt::format("{} ({})", HAFF_VERSION, HAFF_COMMIT);
}

std::string version_text() {
  return fmt::format("campaign {}\ncommit   {}\ncompiler {}\nSIMD     {}", HAFF_VERSION,
                     HAFF_COMMIT, compiler, engine::simd_target());
}

}  // namespace haff::campaign
