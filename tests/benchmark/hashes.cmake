# SPDX-License-Identifier: GPL-3.0-or-later

# Checks that the benchmark runs, and that the SIMD and the scalar search give the same trajectory.
#   cmake -DBENCHMARK=<engine_benchmark> -P hashes.cmake
cmake_minimum_required(VERSION 3.25)

foreach(scene "--N;500;--n;0.4;--e;1" "--N;4000;--n;0.9;--e;0.5" "--N;20000;--n;0.05;--e;0.8")
  foreach(search "" "--scalar")
    execute_process(COMMAND ${BENCHMARK} ${scene} --warmup 10 --tau 10 --json ${search}
      OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    string(JSON hash${search} GET "${output}" state_hash)
  endforeach()
  if(NOT hash STREQUAL "${hash--scalar}")
    message(SEND_ERROR "${scene}: SIMD ${hash}, scalar ${hash--scalar}")
  endif()
endforeach()
