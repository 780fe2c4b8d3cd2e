// SPDX-License-Identifier: GPL-3.0-or-later

// Hostile and damaged stores, read by the program's own reader: with libFuzzer (clang++), or with
// another compiler from the named files, which are the kept corpus or an input that ended the
// program.
//
//   fuzz_store -max_total_time=3600 corpus    with libFuzzer; its own options: -help=1
//   fuzz_store FILE...
//
// Any store is either read or refused with one of the errors of schema/error.hpp or of the
// checkpoint. Anything else (a crash, a sanitizer's finding, another exception) ends the program.
#include "schema/store/store.hpp"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "campaign/state/checkpoint.hpp"
#include "campaign/state/restore.hpp"
#include "fuzz/edits.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace haff;
using namespace haff::schema;

template <class Read>
void attempt(Read&& read) try {
  read();
} catch (const StoreError&) {
} catch (const campaign::DamagedCheckpoint&) {
} catch (const campaign::NewerCheckpoint&) {
}

void read_all(Query query) {
  while (query.next()) {
  }
}

void read_job(const Reader& store, std::int64_t job_id, Store& home) {
  attempt([&] { store.digests(job_id); });
  attempt([&] { store.samples(job_id); });
  attempt([&] { store.last_sample(job_id, 3); });
  attempt([&] { store.results(job_id); });
  attempt([&] { store.invariants(job_id); });
  attempt([&] { store.profiles(job_id, "rho"); });
  attempt([&] {
    for (const FieldName& field : store.fields(job_id)) store.field(job_id, field.name, field.tau);
  });
  attempt([&] { campaign::stored_state(store, job_id, store.job(job_id).job); });
  // Reads the store as a shard that is merged.
  attempt([&] { home.take_over(store, job_id); });
}

void read(const std::filesystem::path& file) {
  const Reader store(file);
  attempt([&] { store.summary(); });
  attempt([&] { store.jobs(); });
  attempt([&] { store.running(); });
  attempt([&] { store.checkpoints(); });
  attempt([&] { store.targets(); });
  attempt([&] { store.shards(); });
  attempt([&] { store.campaign_id(); });
  attempt([&] { store.shard_name(); });
  attempt([&] { store.wrong_tables(); });
  attempt([&] { store.least_seconds_to(5); });
  attempt([&] { store.must_match_digests({Part::samples, Part::profiles, Part::results}); });
  for (const char* view : {"mean_series", "mean_profiles", "mean_tau_c", "mean_temperatures",
                           "target_outcomes", "job_effects", "mixed_physics"})
    attempt([&] { read_all(store.query(std::string("SELECT * FROM ") + view)); });
  attempt([&] {
    Store home = Store::in_memory();
    for (const std::int64_t job_id : store.job_ids()) read_job(store, job_id, home);
  });
}

void write(const std::filesystem::path& file) {
  Store store = Store::open(file);
  attempt([&] { store.retry_failed(); });
  const Owner owner{.host = "here", .boot_id = "now", .pid = 2, .started = 2};
  attempt([&] {
    if (const auto claim = store.claim(owner, "fuzz"))
      store.commit(claim->lease, {.samples = {{.tau = 5, .time = 1, .temperature = 0.5}}});
  });
  attempt([&] {
    for (const std::int64_t job_id : store.job_ids()) attempt([&] { store.turn_bit_back(job_id); });
  });
}

// The folder is in the place for temporary files, which is fastest in memory.
struct Stage {
  TemporaryFolder folder;
  std::string sound = haff::tests::sound_store(folder.path());
  std::filesystem::path file = folder / "edited.db";
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const Stage stage;
  haff::tests::write_edited(stage.sound, {bytes, size}, stage.file);
  attempt([&] { read(stage.file); });
  attempt([&] { write(stage.file); });
  return 0;
}

#ifndef HAFF_LIBFUZZER
int main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    std::ifstream file(argv[k], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    std::fprintf(stderr, "%s\n", argv[k]);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  return 0;
}
#endif
