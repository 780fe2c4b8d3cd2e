// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/checkpoint.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

static_assert(std::endian::native == std::endian::little,
              "checkpoints are little-endian: swap bytes here for this machine");

constexpr std::string_view magic = "HAFFGAS\n";
// Version 1 had no invariants but momentum_removed, and no memory; version 2 had only d = 3;
// version 3 did not name its physics_version, which was the first.
constexpr std::uint32_t version = 4;
constexpr std::string_view physics = "physics_version";

// What laws of restitution remember is stored under these names, followed by their own.
constexpr std::string_view memory_prefix = "memory.";

// The fields of a state by name, except its memory. The structured binding counts them: with a
// field that is in State and not here, this does not compile.
template <class State, class Visit>
void for_each_field(State& state, Visit&& visit) {
  auto& [d, box, id, position, velocity, exponent, collisions, time, tally, invariants, memory] =
      state;
  auto& [dissipated, virial] = tally;
  auto& [closest2, past_events, watchdog_trips, energy_mismatch, momentum_removed] = invariants;
  visit("d", d);
  visit("box", box);
  visit("id", id);
  visit("position", position);
  visit("velocity", velocity);
  visit("exponent", exponent);
  visit("collisions", collisions);
  visit("time", time);
  visit("dissipated", dissipated);
  visit("virial", virial);
  visit("momentum_removed", momentum_removed);
  visit("closest2", closest2);
  visit("past_events", past_events);
  visit("watchdog_trips", watchdog_trips);
  visit("energy_mismatch", energy_mismatch);
}

// The version that brought this field.
std::uint32_t since(std::string_view name) {
  if (name == "d") return 3;
  const bool is_invariant = name == "closest2" || name == "past_events" ||
                            name == "watchdog_trips" || name == "energy_mismatch";
  return is_invariant ? 2 : 1;
}

}  // namespace

// Any change of one 8-byte word changes the result, whatever follows (each step is invertible);
// any other change does with probability 1 - 2^-64.
std::uint64_t checkpoint_checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = bytes.size();
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t size = std::min(bytes.size(), sizeof word);
    std::memcpy(&word, bytes.data(), size);
    sum = (sum ^ word) * 0x9e3779b97f4a7c15;
    sum ^= sum >> 32;
    bytes = bytes.subspan(size);
  }
  return sum;
}

namespace {

template <class T>
std::span<T> elements(T& value) {
  return {&value, 1};
}
template <class T>
std::span<T> elements(std::vector<T>& values) {
  return values;
}
template <class T>
std::span<const T> elements(const std::vector<T>& values) {
  return values;
}

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    append(std::as_bytes(std::span(&value, 1)));
  }
  void put(std::string_view text) { append(std::as_bytes(std::span(text))); }

  template <class Field>
  void put_field(std::string_view name, const Field& field) {
    const auto values = elements(field);
    put(static_cast<std::uint8_t>(name.size()));
    put(name);
    put(static_cast<std::uint8_t>(sizeof values[0]));
    put(static_cast<std::uint64_t>(values.size()));
    append(std::as_bytes(values));
  }

  std::vector<std::byte> bytes;

 private:
  void append(std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::span<const std::byte> take(std::uint64_t size) {
    if (size > rest_.size()) throw DamagedCheckpoint("checkpoint is cut short");
    const auto taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view get_text(std::size_t size) {
    return {reinterpret_cast<const char*>(take(size).data()), size};
  }
  std::size_t left() const { return rest_.size(); }
  bool at_end() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
};

struct Stored {
  std::string_view name;
  std::size_t element_size = 0;
  std::uint64_t count = 0;
  std::span<const std::byte> bytes;
};

// A state has some fifteen fields, and an effect adds one or two. A file with many more is not
// ours, and each field would be looked for among all of them.
constexpr std::uint32_t most_fields = 64;

std::vector<Stored> read_table(Reader& reader, std::uint32_t fields) {
  if (fields > most_fields)
    throw DamagedCheckpoint(
        fmt::format("checkpoint has {} fields, at most {} expected", fields, most_fields));
  std::vector<Stored> table;
  for (std::uint32_t k = 0; k < fields; ++k) {
    Stored field;
    field.name = reader.get_text(reader.get<std::uint8_t>());
    field.element_size = reader.get<std::uint8_t>();
    field.count = reader.get<std::uint64_t>();
    if (field.element_size == 0 || field.count > reader.left() / field.element_size)
      throw DamagedCheckpoint("checkpoint is cut short");  // before the product overflows
    field.bytes = reader.take(field.count * field.element_size);
    table.push_back(field);
  }
  return table;
}

template <class T>
void resize(std::vector<T>& values, std::uint64_t count) {
  values.resize(count);
}
template <class T>
void resize(T&, std::uint64_t) {}

template <class Field>
void restore(const std::vector<Stored>& table, std::string_view name, Field& field) {
  for (const Stored& stored : table) {
    if (stored.name != name) continue;
    const auto wrong = [&] {
      return DamagedCheckpoint(fmt::format("checkpoint field '{}' has the wrong size", name));
    };
    if (stored.element_size != sizeof elements(field)[0]) throw wrong();
    resize(field, stored.count);
    const auto target = std::as_writable_bytes(elements(field));
    if (stored.bytes.size() != target.size()) throw wrong();
    if (!target.empty()) std::memcpy(target.data(), stored.bytes.data(), target.size());
    return;
  }
  throw DamagedCheckpoint(fmt::format("checkpoint has no field '{}'", name));
}

}  // namespace

std::vector<std::byte> encode(const engine::State& state) {
  Writer writer;
  std::uint32_t fields = 0;
  std::size_t size = 256;  // names and scalars
  const auto count = [&](std::string_view, const auto& field) {
    ++fields;
    size += elements(field).size_bytes();
  };
  for_each_field(state, count);
  for (const auto& [name, values] : state.memory) count(name, values);
  count(physics, engine::physics_version);
  writer.bytes.reserve(size);
  writer.put(magic);
  writer.put(version);
  writer.put(fields);
  for_each_field(state,
                 [&](std::string_view name, const auto& field) { writer.put_field(name, field); });
  for (const auto& [name, values] : state.memory)
    writer.put_field(std::string(memory_prefix) + name, values);
  writer.put_field(physics, engine::physics_version);
  writer.put(checkpoint_checksum(writer.bytes));
  return std::move(writer.bytes);
}

namespace {

struct Contents {
  std::uint32_t version = 0;
  std::vector<Stored> table;
};

Contents contents_of(std::span<const std::byte> bytes) {
  constexpr std::size_t sum_size = sizeof(std::uint64_t);
  if (bytes.size() < magic.size() + sum_size) throw DamagedCheckpoint("checkpoint is cut short");
  const auto content = bytes.first(bytes.size() - sum_size);
  Reader sum(bytes.last(sum_size));
  Reader reader(content);
  if (reader.get_text(magic.size()) != magic)
    throw DamagedCheckpoint("checkpoint does not begin as one");
  if (sum.get<std::uint64_t>() != checkpoint_checksum(content))
    throw DamagedCheckpoint("checkpoint fails its checksum");
  const auto found = reader.get<std::uint32_t>();
  if (found > version)
    throw NewerCheckpoint(fmt::format(
        "checkpoint is of format {}, this program knows those up to {}", found, version));
  if (found < 1) throw DamagedCheckpoint("checkpoint is of format 0, which never was");
  auto table = read_table(reader, reader.get<std::uint32_t>());
  if (!reader.at_end()) throw DamagedCheckpoint("checkpoint is longer than its fields");
  return {found, std::move(table)};
}

}  // namespace

int physics_version_of(std::span<const std::byte> bytes) {
  const auto [found, table] = contents_of(bytes);
  int computed_with = 1;
  if (found >= 4) restore(table, physics, computed_with);
  return computed_with;
}

engine::State decode(std::span<const std::byte> bytes) {
  const auto contents = contents_of(bytes);
  const std::uint32_t found = contents.version;
  const std::vector<Stored>& table = contents.table;

  engine::State state;
  for_each_field(state, [&](std::string_view name, auto& field) {
    if (found >= since(name)) restore(table, name, field);
  });
  for (const Stored& stored : table)
    if (stored.name.starts_with(memory_prefix))
      restore(table, stored.name,
              state.memory[std::string(stored.name.substr(memory_prefix.size()))]);
  return state;
}

}  // namespace haff::campaign
