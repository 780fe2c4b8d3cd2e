# SPDX-License-Identifier: GPL-3.0-or-later

# The page of `campaign report` in a real browser (page.mjs).
#   cmake -DCAMPAIGN=<program> -DSOURCE=<this folder> -DWORK=<folder> -P browser.cmake
# Needs chromium and npm (.ci/packages lint installs them); where one is missing, the test is skipped,
# and ctest says so.
cmake_minimum_required(VERSION 3.25)

find_program(npm npm)
find_program(node node)
find_program(chromium NAMES chromium chromium-browser google-chrome)
foreach(program npm node chromium)
  if(NOT ${program})
    message("Skipped: ${program} is not installed; .ci/packages lint installs it")
    return()
  endif()
endforeach()

execute_process(COMMAND ${CAMPAIGN} report --store ${WORK}/nothing.db ERROR_VARIABLE answer)
if(answer MATCHES "built without")
  message("Skipped: ${answer}")
  return()
endif()

file(MAKE_DIRECTORY ${WORK})
file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/page.mjs DESTINATION ${WORK})
if(NOT EXISTS ${WORK}/node_modules OR ${WORK}/package-lock.json IS_NEWER_THAN ${WORK}/node_modules)
  execute_process(COMMAND ${npm} ci --ignore-scripts --no-audit --no-fund --prefer-offline --loglevel=error
    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "npm could not fetch playwright-core")
  endif()
endif()
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env CAMPAIGN=${CAMPAIGN} CHROMIUM=${chromium} PICTURES=${WORK}/pictures
          ${node} --test --test-concurrency=1 ${WORK}/page.mjs
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the page fails in the browser: node ends with ${failed}")
endif()
