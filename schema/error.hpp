// SPDX-License-Identifier: GPL-3.0-or-later

// What can go wrong with a store. Each message names the file and what is wrong, and says what a
// person can do about it. Only the program knows which of its commands would help, so that an error
// carries the kind of its remedy.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace haff::schema {

enum class Remedy {
  none,          // or the message says it
  name_a_store,  // another file was meant
  plan,          // there is no store yet: make it
  check,         // find out what is damaged
  repair,        // rows are not as they were written: put them right
  upgrade,       // bring the store forward to this program's version
  back_up        // use a copy instead
};

// The store cannot be used as it was asked for.
struct StoreError : std::runtime_error {
  explicit StoreError(const std::string& message, Remedy helps = Remedy::none,
                      std::filesystem::path name = {})
      : std::runtime_error(message), remedy(helps), store(std::move(name)) {}

  Remedy remedy;
  std::filesystem::path store;  // as the user named it; empty where the remedy needs none
};

// What the user named is not there, or is not a store: the user's input, not the store, is wrong.
struct NameError : StoreError {
  using StoreError::StoreError;
};

// The system would not let the store be read or written just now: another process holds a lock, no
// memory or file descriptor is left, the disk answers with an error. This says nothing about what
// is stored, and is never a reason to throw any of it away.
struct Unavailable : StoreError {
  using StoreError::StoreError;
};

// Another process kept the store locked for longer than this one may wait.
struct Locked : Unavailable {
  using Unavailable::Unavailable;
};

// The disk is full or does not write. The transaction was rolled back: the store holds what it
// held before.
struct DiskError : Unavailable {
  using Unavailable::Unavailable;
};

// The job that this writer worked on belongs to another writer now, or to none. Nothing was
// written: the writer is to stop working on it.
struct LeaseLost : StoreError {
  using StoreError::StoreError;
};

// What is stored contradicts itself: SQLite finds its pages in disorder, a checkpoint's bytes do
// not add up to its checksum, or a sample came out different when it was computed a second time.
struct Damage : StoreError {
  using StoreError::StoreError;
};

// SQLite finds the pages of the file itself in disorder. No state and no job is to blame, and to
// compute one again mends nothing.
struct DamagedFile : Damage {
  using Damage::Damage;
};

// SQL that does not parse, that asks for what is not there, or that would write.
struct QueryError : StoreError {
  using StoreError::StoreError;
};

}  // namespace haff::schema
