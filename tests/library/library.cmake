# SPDX-License-Identifier: GPL-3.0-or-later

# The engine in another project, in a path with blanks, where no library but Highway can be found.
#   cmake -DWAY=find_package|add_subdirectory|FetchContent -DSOURCE=<repository> -DINSTALLED=<prefix>
#         -DWORK=<folder> -DGENERATOR=<generator> -DCXX=<compiler> -P library.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  message("${output}")
endfunction()

file(REMOVE_RECURSE ${WORK})
file(COPY ${SOURCE}/CMakeLists.txt ${SOURCE}/engine DESTINATION "${WORK}/haff source")
file(COPY ${SOURCE}/examples/library DESTINATION "${WORK}/haff source/examples")
file(COPY ${SOURCE}/tests/library DESTINATION "${WORK}/haff source/tests")

set(options -DCMAKE_BUILD_TYPE=None)
foreach(package doctest GSL Eigen3 PkgConfig SQLiteCpp nlohmann_json valijson CLI11 spdlog fmt)
  list(APPEND options -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
set(project examples/library)
if(WAY STREQUAL find_package)
  list(APPEND options -DCMAKE_PREFIX_PATH=${INSTALLED} -DCMAKE_REQUIRE_FIND_PACKAGE_haff=ON)
elseif(WAY STREQUAL FetchContent)
  list(APPEND options -DCMAKE_DISABLE_FIND_PACKAGE_haff=ON)
else()
  set(project tests/library)
endif()
# The test is whether the engine is found, builds and runs: one SIMD target without optimization suffices.
run(${CMAKE_COMMAND} -S "${WORK}/haff source/${project}" -B "${WORK}/its build" -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=-O0 -DHWY_COMPILE_ONLY_STATIC" ${options})
if(WAY STREQUAL FetchContent AND GENERATOR MATCHES Ninja)
  # FetchContent calls add_subdirectory(), whose test builds and runs everything. Here the project is only
  # configured, and the example compiled, so that its headers must be found.
  run(${CMAKE_COMMAND} --build "${WORK}/its build" --target CMakeFiles/cooling.dir/cooling.cpp.o)
else()
  run(${CMAKE_COMMAND} --build "${WORK}/its build")
  run("${WORK}/its build/cooling")
endif()
