// SPDX-License-Identifier: GPL-3.0-or-later

#include "crash/power_loss.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <optional>

namespace haff::tests {
namespace {

constexpr std::size_t sector = 512, page = 4096;

// The fate of one piece of a write.
enum class Piece { lost, arrives, zero, junk };

struct FileOnDisk {
  std::string synced;
  std::vector<const Operation*> pending;
  bool is_named = true;  // whether the folder has an entry for the file
};

double chance(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

template <class Choose>
void apply(std::string& bytes, const Operation& operation, std::size_t piece, Choose choose,
           std::mt19937_64& random) {
  const auto offset = static_cast<std::size_t>(operation.header.offset);
  if (operation.header.event == Event::truncate) {
    if (choose() == Piece::arrives) bytes.resize(offset, '\0');
    return;
  }
  const std::size_t end = offset + operation.data.size();
  for (std::size_t begin = offset; begin < end;) {
    const std::size_t next = std::min((begin / piece + 1) * piece, end);
    const Piece what = choose();
    if (what != Piece::lost && bytes.size() < next) bytes.resize(next, '\0');
    for (std::size_t i = begin; i < next; ++i) {
      if (what == Piece::arrives) bytes[i] = operation.data[i - offset];
      if (what == Piece::junk) bytes[i] = static_cast<char>(random());
    }
    begin = next;
  }
}

void apply_whole(std::string& bytes, const Operation& operation, std::mt19937_64& random) {
  apply(
      bytes, operation, operation.data.size() + 1, [] { return Piece::arrives; }, random);
}

std::string after_power_loss(const FileOnDisk& file, TracedFile which, Fate fate,
                             std::mt19937_64& random) {
  std::string bytes = file.synced;
  const double part = std::array{0.1, 0.5, 0.9, 0.98}[random() % 4];
  const auto all = [&](std::size_t piece, auto choose) {
    for (const Operation* operation : file.pending) apply(bytes, *operation, piece, choose, random);
  };
  const auto sometimes = [&](Piece otherwise) {
    return
        [&random, part, otherwise] { return chance(random) < part ? Piece::arrives : otherwise; };
  };
  const auto always = [] { return Piece::arrives; };
  switch (fate) {
    case Fate::none:
      break;
    case Fate::all:
      all(page, always);
      break;
    case Fate::prefix: {
      const std::size_t whole = random() % (file.pending.size() + 1);
      for (std::size_t k = 0; k < whole; ++k) apply_whole(bytes, *file.pending[k], random);
      if (whole < file.pending.size())
        apply(bytes, *file.pending[whole], sector, sometimes(Piece::lost), random);
      break;
    }
    case Fate::some_pages:
      all(page, sometimes(Piece::lost));
      break;
    case Fate::some_sectors:
      all(sector, sometimes(Piece::lost));
      break;
    case Fate::zeros:
      all(page, sometimes(Piece::zero));
      break;
    case Fate::junk:
      all(sector, sometimes(Piece::junk));
      break;
    case Fate::store_first:
    case Fate::log_first:
      if ((which == TracedFile::store) == (fate == Fate::store_first))
        all(page, always);
      else
        all(sector, sometimes(Piece::lost));
      break;
  }
  return bytes;
}

const char* suffix(TracedFile file) {
  return file == TracedFile::log ? "-wal" : file == TracedFile::journal ? "-journal" : "";
}

}  // namespace

std::vector<Operation> read_trace(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<Operation> operations;
  Operation next;
  while (stream.read(reinterpret_cast<char*>(&next.header), sizeof next.header)) {
    next.data.resize(next.header.size);
    stream.read(next.data.data(), static_cast<std::streamsize>(next.data.size()));
    operations.push_back(next);
  }
  return operations;
}

void make_image(const std::vector<Operation>& operations, std::size_t count, Fate fate,
                std::mt19937_64& random, const std::filesystem::path& folder,
                const std::string& name) {
  std::map<TracedFile, FileOnDisk> files;
  std::map<TracedFile, FileOnDisk> deleted;  // whose folder may still have an entry for them
  const auto folder_is_synced = [&] {
    deleted.clear();
    for (auto& [which, file] : files) file.is_named = true;
  };
  for (std::size_t k = 0; k < count; ++k) {
    const Operation& operation = operations[k];
    const TracedFile which = operation.header.file;
    switch (operation.header.event) {
      case Event::make:
        files[which] = {.synced = "", .pending = {}, .is_named = false};
        break;
      case Event::remove:
      case Event::remove_and_sync:
        if (files[which].is_named) deleted[which] = files[which];
        files.erase(which);
        if (operation.header.event == Event::remove_and_sync) folder_is_synced();
        break;
      case Event::sync: {
        FileOnDisk& file = files[which];
        for (const Operation* each : file.pending) apply_whole(file.synced, *each, random);
        file.pending.clear();
        // SQLite syncs the folder with the first sync of a journal or log, which it has just made.
        if (which == TracedFile::journal || which == TracedFile::log) folder_is_synced();
        file.is_named = true;
        break;
      }
      case Event::write:
      case Event::truncate:
        files[which].pending.push_back(&operation);
        break;
    }
  }
  for (const auto& [which, file] : deleted)
    if (!files.contains(which) && chance(random) < 0.5) files[which] = file;
  for (const auto& [which, file] : files) {
    if (!file.is_named && chance(random) < 0.4) continue;
    std::ofstream(folder / (name + suffix(which)), std::ios::binary)
        << after_power_loss(file, which, fate, random);
  }
}

}  // namespace haff::tests
