# SPDX-License-Identifier: GPL-3.0-or-later

# Writes the present git commit into a header, at every build, only when it has changed.
#   cmake -DSOURCE=<repository> -DVERSION=<version> -DOUTPUT=<header> -P commit.cmake
cmake_minimum_required(VERSION 3.25)

# An archive without its history has none, even when unpacked inside another repository. Root may
# build what a user has cloned.
set(commit "unknown")
if(EXISTS ${SOURCE}/.git)
  execute_process(
    COMMAND git -c safe.directory=${SOURCE} -C ${SOURCE}
            describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"#pragma once
#define HAFF_VERSION \"@VERSION@\"
#define HAFF_COMMIT \"@commit@\"
")
