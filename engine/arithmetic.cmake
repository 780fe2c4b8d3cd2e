# SPDX-License-Identifier: GPL-3.0-or-later

# Results are promised bit for bit. Flags that let the compiler compute something other than what is
# written are refused here, by name; support/arithmetic.hpp refuses those that come another way.
set(flags_that_change_results
  -ffast-math -Ofast -funsafe-math-optimizations -fassociative-math -freciprocal-math
  -ffinite-math-only -fno-signed-zeros -fsingle-precision-constant -mfpmath=387 -ffp-model=fast)

# The linker's flags are examined too: gcc 12 takes -ffast-math there as "flush small numbers to
# zero".
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set(places CMAKE_CXX_FLAGS CMAKE_EXE_LINKER_FLAGS)
foreach(configuration IN LISTS build_type CMAKE_CONFIGURATION_TYPES)
  string(TOUPPER "${configuration}" configuration)
  list(APPEND places CMAKE_CXX_FLAGS_${configuration} CMAKE_EXE_LINKER_FLAGS_${configuration})
endforeach()
get_directory_property(added_options COMPILE_OPTIONS)
list(APPEND places added_options)

foreach(place IN LISTS places)
  string(REGEX REPLACE "[; ]+" ";" flags "${${place}}")
  foreach(flag IN LISTS flags_that_change_results)
    if(flag IN_LIST flags)
      set(where ${place})
      if(place STREQUAL added_options)
        set(where "add_compile_options()")
      endif()
      message(FATAL_ERROR
        "haff does not build with ${flag} (in ${where}): the compiler would be free to compute "
        "other numbers than those the program promises to repeat bit for bit.\n"
        "Take ${flag} out of ${where} (also of the environment's CXXFLAGS or LDFLAGS, where it may "
        "come from), remove the build directory and configure again.")
    endif()
  endforeach()
endforeach()
