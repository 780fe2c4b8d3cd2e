# Which room may use which: campaign uses all, the others none but themselves.
#   cmake -DSOURCE=<repository> -P tests/rooms.cmake
cmake_minimum_required(VERSION 3.25)

set(rooms engine analysis schema campaign)
foreach(room engine analysis schema)
  file(GLOB files ${SOURCE}/${room}/*.cpp ${SOURCE}/${room}/*.hpp)
  foreach(file IN LISTS files)
    foreach(other IN LISTS rooms)
      file(STRINGS ${file} includes REGEX "#include \"${other}/")
      if(includes AND NOT other STREQUAL room)
        message(SEND_ERROR "${file}: ${room} knows nothing of ${other}, but says ${includes}")
      endif()
    endforeach()
  endforeach()
endforeach()
