// What can go wrong with a store. Each message names the file, what is wrong and what to do next.
#pragma once

#include <stdexcept>

namespace haff::schema {

// The store cannot be used as it was asked for.
struct StoreError : std::runtime_error {
  using std::runtime_error::runtime_error;
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

// The job this writer worked on belongs to another writer now, or to none. Nothing was written:
// stop working on it.
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

// SQL that does not parse, asks for what is not there, or would write.
struct QueryError : StoreError {
  using StoreError::StoreError;
};

}  // namespace haff::schema
