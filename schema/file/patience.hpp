// SPDX-License-Identifier: GPL-3.0-or-later

// How long a connection waits for others, and how it ends when it is asked to.
#pragma once

#include <sqlite3.h>

#include <chrono>

namespace haff::schema {

// How long a writer waits for others before it gives up. A commit of a large checkpoint to a slow
// disk takes seconds; several workers may queue.
inline constexpr std::chrono::milliseconds busy_timeout{120'000};

// Installs SQLite's busy and progress handlers. A lock is waited for as long as busy_timeout and,
// if it is given, as `may_wait` allows, which is asked some times a second. Two seconds after
// `may_wait` first said no, a statement that still runs is ended as well.
void be_patient(sqlite3* handle, bool (*may_wait)() = nullptr);

}  // namespace haff::schema
