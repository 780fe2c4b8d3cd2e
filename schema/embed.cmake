# SPDX-License-Identifier: GPL-3.0-or-later

# Writes a C++ source that holds the text of each of FILES under its name, in order.
file(WRITE ${OUTPUT} "// Made by schema/embed.cmake.\n#include \"schema/embedded.hpp\"\n\n")
file(APPEND ${OUTPUT} "namespace haff::schema {\n\nstd::span<const Embedded> embedded() {\n")
file(APPEND ${OUTPUT} "  static constexpr Embedded files[] = {\n")
foreach(path IN LISTS FILES)
  get_filename_component(name ${path} NAME)
  file(READ ${path} text)
  file(APPEND ${OUTPUT} "{\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(APPEND ${OUTPUT} "  };\n  return files;\n}\n\n}  // namespace haff::schema\n")
