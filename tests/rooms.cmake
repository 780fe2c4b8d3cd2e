# SPDX-License-Identifier: GPL-3.0-or-later

# Checks which folder uses which. The rooms engine, analysis and schema know only themselves; campaign
# uses all of them. The folders of campaign and schema form graphs without a circle, drawn in their
# README.md.
#   cmake -DSOURCE=<repository> -P tests/rooms.cmake
cmake_minimum_required(VERSION 3.25)

# The folders of campaign/ and of schema/, and the folders that each may include besides itself. This
# holds along chains: what a folder may include, its users may include, too. Subfolders count as part of
# their folder.
set(campaign_base)
set(campaign_state base)
set(campaign_job state)
set(campaign_run job)
set(campaign_planning job)
set(campaign_results state)
set(campaign_plot base)
set(campaign_accuracy planning results plot)
set(campaign_curves accuracy)
set(campaign_paper results plot)
set(campaign_figures curves paper)
set(campaign_cluster run planning)
set(campaign_report curves cluster)
set(campaign_commands run figures cluster report)
set(campaign_folders base state job run planning results plot accuracy curves paper figures cluster
  report commands)

set(schema_file)
set(schema_rows)
set(schema_grid)
set(schema_digests rows)
set(schema_sql rows)
set(schema_database file sql digests)
set(schema_store database grid)
set(schema_folders file rows grid sql digests database store)

# The includes "<prefix>NAME/..." of a file, as a list of NAME.
function(included_folders file prefix result)
  file(STRINGS ${file} includes REGEX "^#include \"${prefix}[a-z_]+/")
  list(TRANSFORM includes REPLACE "^#include \"${prefix}([a-z_]+)/.*" "\\1")
  set(${result} ${includes} PARENT_SCOPE)
endfunction()

set(rooms engine analysis schema campaign)
foreach(room engine analysis schema)
  file(GLOB_RECURSE files ${SOURCE}/${room}/*.?pp)
  foreach(file IN LISTS files)
    included_folders(${file} "" used)
    foreach(other IN LISTS used)
      if(other IN_LIST rooms AND NOT other STREQUAL room)
        message(SEND_ERROR "${file}: ${room} knows nothing of ${other}, but includes it")
      endif()
    endforeach()
  endforeach()
endforeach()

foreach(room campaign schema)
  foreach(folder IN LISTS ${room}_folders)
    set(allowed ${folder})
    foreach(step IN LISTS ${room}_folders)  # at most as many steps as there are folders
      foreach(known IN LISTS allowed)
        list(APPEND allowed ${${room}_${known}})
      endforeach()
      list(REMOVE_DUPLICATES allowed)
    endforeach()
    file(GLOB_RECURSE files ${SOURCE}/${room}/${folder}/*.?pp)
    if(NOT files)
      message(SEND_ERROR "${room}/${folder} has no files: take it out of tests/rooms.cmake")
    endif()
    foreach(file IN LISTS files)
      included_folders(${file} "${room}/" used)
      foreach(other IN LISTS used)
        if(NOT other IN_LIST allowed)
          message(SEND_ERROR "${file}: ${room}/${folder} may not use ${room}/${other}")
        endif()
      endforeach()
    endforeach()
  endforeach()

  file(GLOB existing LIST_DIRECTORIES true RELATIVE ${SOURCE}/${room} ${SOURCE}/${room}/*)
  foreach(name IN LISTS existing)
    if(IS_DIRECTORY ${SOURCE}/${room}/${name} AND NOT name IN_LIST ${room}_folders
        AND NOT name STREQUAL "decisions")
      list(APPEND strays ${room}/${name})
    endif()
  endforeach()
endforeach()
file(GLOB unsorted RELATIVE ${SOURCE} ${SOURCE}/campaign/*.?pp ${SOURCE}/schema/*.cpp)
list(APPEND strays ${unsorted})
if(strays)
  message(SEND_ERROR "In none of the folders that tests/rooms.cmake knows: ${strays}")
endif()
