# SPDX-License-Identifier: GPL-3.0-or-later

# The page's parts become part of the program: its own files (web/), and two libraries from npm, of
# the versions and with the checksums of web/package-lock.json: uPlot, which draws curves, and sql.js,
# which is SQLite for the browser. They are fetched when CMake configures. Where that fails the build
# goes on, and `campaign report` says what is missing.
#
# Sets report_assets, the source that holds them all.

set(web ${CMAKE_CURRENT_LIST_DIR}/web)
set(fetched ${CMAKE_CURRENT_BINARY_DIR}/report)
set(packages ${fetched}/node_modules)
set(again "then configure and build again: cmake --preset release && cmake --build --preset release")
set(why_no_assets "")

file(SHA256 ${web}/package-lock.json wanted)
set(have "")
if(EXISTS ${fetched}/fetched)
  file(READ ${fetched}/fetched have)
endif()
if(NOT have STREQUAL wanted)
  find_program(HAFF_NPM npm DOC "npm, which fetches the libraries of the page of campaign report")
  if(NOT HAFF_NPM)
    set(why_no_assets "npm is not installed; install it (Debian: apt-get install npm), ${again}")
  else()
    file(MAKE_DIRECTORY ${fetched})
    configure_file(${web}/package.json ${fetched}/package.json COPYONLY)
    configure_file(${web}/package-lock.json ${fetched}/package-lock.json COPYONLY)
    execute_process(
      COMMAND ${HAFF_NPM} ci --omit=dev --ignore-scripts --no-audit --no-fund --prefer-offline
              --fetch-retries=1 --fetch-retry-mintimeout=1000 --loglevel=error
      WORKING_DIRECTORY ${fetched} RESULT_VARIABLE failed ERROR_VARIABLE error OUTPUT_QUIET)
    if(failed)
      string(REGEX REPLACE "[^A-Za-z0-9 .,:/@_-]+" " " error "${error}")
      string(SUBSTRING "${error}" 0 160 error)
      set(why_no_assets "npm could not fetch them (${error}); connect to the network, ${again}")
    else()
      file(WRITE ${fetched}/fetched ${wanted})
    endif()
  endif()
endif()
if(why_no_assets)
  message(STATUS "campaign report will have no page: ${why_no_assets}")
endif()

set(report_assets ${fetched}/assets.cpp)
set(files)
if(NOT why_no_assets)
  file(GLOB files CONFIGURE_DEPENDS ${web}/*.html ${web}/*.css ${web}/*.js)
  list(APPEND files
    ${packages}/uplot/dist/uPlot.iife.min.js ${packages}/uplot/dist/uPlot.min.css
    ${packages}/sql.js/dist/sql-wasm-browser.js ${packages}/sql.js/dist/sql-wasm-browser.wasm)
  configure_file(${packages}/uplot/LICENSE ${fetched}/uPlot.LICENSE COPYONLY)
  configure_file(${packages}/sql.js/LICENSE ${fetched}/sql.js.LICENSE COPYONLY)
  list(APPEND files ${fetched}/uPlot.LICENSE ${fetched}/sql.js.LICENSE)
endif()

# The assembler takes each file as it is: a megabyte as an array of numbers would cost the compiler
# many seconds.
set(include "")
set(declare "")
set(entries "")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME)
  string(MAKE_C_IDENTIFIER "haff_asset_${name}" symbol)
  string(APPEND include
    "asm(R\"(.pushsection .rodata\n.globl ${symbol}, ${symbol}_end\n"
    "${symbol}: .incbin \"${file}\"\n${symbol}_end: .byte 0\n.popsection)\");\n")
  string(APPEND declare "extern \"C\" const char ${symbol}[], ${symbol}_end[];\n")
  string(APPEND entries "      part(\"${name}\", ${symbol}, ${symbol}_end),\n")
endforeach()
file(CONFIGURE OUTPUT ${report_assets} @ONLY CONTENT [=[
// Made by campaign/report/assets.cmake.
#include "campaign/report/assets.hpp"

#include <vector>

@include@@declare@
namespace haff::campaign {
namespace {

[[maybe_unused]] Asset part(std::string_view name, const char* begin, const char* end) {
  return {name, {begin, static_cast<std::size_t>(end - begin)}};
}

}  // namespace

std::span<const Asset> assets() {
  static const std::vector<Asset> parts{
@entries@  };
  return parts;
}

std::string_view why_no_assets() {
  return R"why(@why_no_assets@)why";
}

}  // namespace haff::campaign
]=])
set_source_files_properties(${report_assets} PROPERTIES OBJECT_DEPENDS "${files}")
