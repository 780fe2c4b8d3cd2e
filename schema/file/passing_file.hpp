// SPDX-License-Identifier: GPL-3.0-or-later

// An open file of SQLite's that hands every call to the file below it. A layer between SQLite and
// the system ("VFS" in its documentation) takes passing_methods() and puts its own functions in the
// places where it has something to do.
#pragma once

#include <sqlite3.h>

namespace haff::schema {

// File: a layer's own struct, which begins with an sqlite3_file. The file below follows it in
// memory.
template <class File>
File* own(sqlite3_file* file) {
  return reinterpret_cast<File*>(file);
}

template <class File>
sqlite3_file* below(sqlite3_file* file) {
  return reinterpret_cast<sqlite3_file*>(own<File>(file) + 1);
}

// The function of the file below at this place of its table, called with the same arguments.
template <class File, auto place>
struct Passing;

template <class File, class Result, class... Arguments,
          Result (*sqlite3_io_methods::*place)(sqlite3_file*, Arguments...)>
struct Passing<File, place> {
  static Result call(sqlite3_file* file, Arguments... arguments) {
    return (below<File>(file)->pMethods->*place)(below<File>(file), arguments...);
  }
};

template <class File>
constexpr sqlite3_io_methods passing_methods() {
  using Methods = sqlite3_io_methods;
  return {
      .iVersion = 3,
      .xClose = Passing<File, &Methods::xClose>::call,
      .xRead = Passing<File, &Methods::xRead>::call,
      .xWrite = Passing<File, &Methods::xWrite>::call,
      .xTruncate = Passing<File, &Methods::xTruncate>::call,
      .xSync = Passing<File, &Methods::xSync>::call,
      .xFileSize = Passing<File, &Methods::xFileSize>::call,
      .xLock = Passing<File, &Methods::xLock>::call,
      .xUnlock = Passing<File, &Methods::xUnlock>::call,
      .xCheckReservedLock = Passing<File, &Methods::xCheckReservedLock>::call,
      .xFileControl = Passing<File, &Methods::xFileControl>::call,
      .xSectorSize = Passing<File, &Methods::xSectorSize>::call,
      .xDeviceCharacteristics = Passing<File, &Methods::xDeviceCharacteristics>::call,
      .xShmMap = Passing<File, &Methods::xShmMap>::call,
      .xShmLock = Passing<File, &Methods::xShmLock>::call,
      .xShmBarrier = Passing<File, &Methods::xShmBarrier>::call,
      .xShmUnmap = Passing<File, &Methods::xShmUnmap>::call,
      .xFetch = Passing<File, &Methods::xFetch>::call,
      .xUnfetch = Passing<File, &Methods::xUnfetch>::call,
  };
}

}  // namespace haff::schema
