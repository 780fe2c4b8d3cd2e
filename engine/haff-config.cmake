# SPDX-License-Identifier: GPL-3.0-or-later

# find_package(haff) in another project: the library haff::engine.
include(CMakeFindDependencyMacro)
find_dependency(hwy)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/haff-targets.cmake)
