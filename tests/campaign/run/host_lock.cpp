// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/host_lock.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>

#include "campaign/run/process.hpp"
#include "schema/file/network.hpp"
#include "support/temporary_folder.hpp"

using namespace haff;
using namespace haff::campaign;
using namespace std::chrono_literals;

namespace {

schema::Owner elsewhere() {
  schema::Owner owner = this_process();
  owner.host += "-other";
  return owner;
}

// The message to a second host, or nothing.
std::string refusal(const std::filesystem::path& store, const schema::Owner& me,
                    Use use = Use::write) try {
  const HostLock lock(store, use, true, me, 0ms);
  return "";
} catch (const schema::Locked& locked) {
  return locked.what();
}

}  // namespace

TEST_CASE("host_lock: a second host is refused with host, process and time") {
  const TemporaryFolder folder;
  const auto store = folder / "a store.db";
  {
    const HostLock lock(store, Use::run, true, this_process(), 0ms);
    const std::string told = refusal(store, elsewhere());
    CHECK(told.find(this_process().host) != std::string::npos);
    CHECK(told.find("process " + std::to_string(this_process().pid)) != std::string::npos);
    CHECK(told.find("since 20") != std::string::npos);
    CHECK(told.find("a store.db.host'") != std::string::npos);
  }
  CHECK(refusal(store, elsewhere()).empty());
}

TEST_CASE(
    "host_lock: commands of the same host share the store with a run, but not with each other") {
  const TemporaryFolder folder;
  const auto store = folder / "campaign.db";
  {
    const HostLock run(store, Use::run, true, this_process(), 0ms);
    CHECK(refusal(store, this_process()).empty());
    CHECK(std::filesystem::exists(folder / "campaign.db.host"));  // the run still holds it
    CHECK_FALSE(refusal(store, this_process(), Use::run).empty());
  }
  const HostLock plan(store, Use::write, true, this_process(), 0ms);
  CHECK_FALSE(refusal(store, this_process()).empty());
}

TEST_CASE(
    "host_lock: a reader is refused while another host writes, and shares with its own host") {
  const TemporaryFolder folder;
  const auto store = folder / "campaign.db";
  for (const Use use : {Use::write, Use::run}) {
    const HostLock other(store, use, true, this_process(), 0ms);
    CHECK(refusal(store, elsewhere(), Use::read).find("two hosts") != std::string::npos);
    CHECK(refusal(store, this_process(), Use::read).empty());
    CHECK(std::filesystem::exists(folder / "campaign.db.host"));
  }
}

TEST_CASE("host_lock: a writer replaces a reader, at once on the same host") {
  const TemporaryFolder folder;
  const auto store = folder / "campaign.db";
  {
    const HostLock reader(store, Use::read, true, this_process(), 0ms);
    const HostLock writer(store, Use::write, true, this_process(), 1h);
    CHECK(refusal(store, elsewhere()).find("two hosts") != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "campaign.db.host"));
  // The writer waits for a reader of another host, and then names it.
  const HostLock reader(store, Use::read, true, this_process(), 0ms);
  const auto before = std::chrono::steady_clock::now();
  const HostLock writer(store, Use::write, true, elsewhere(), 300ms);
  CHECK(std::chrono::steady_clock::now() - before >= 300ms);
  CHECK_FALSE(refusal(store, this_process()).empty());
}

TEST_CASE("host_lock: a reader of a folder that cannot be written needs no lock") {
  const HostLock reader("/proc/campaign.db", Use::read, true, this_process(), 0ms);
  CHECK_THROWS_AS(HostLock("/proc/campaign.db", Use::write, true, this_process(), 0ms),
                  schema::StoreError);
}

TEST_CASE("host_lock: a lock that a dead process of this host left does not count") {
  const TemporaryFolder folder;
  const auto store = folder / "campaign.db";
  schema::Owner dead = this_process();
  dead.started -= 1;
  std::ofstream(folder / "campaign.db.host")
      << R"({"host":")" << dead.host << R"(","boot_id":")" << dead.boot_id << R"(","pid":)"
      << dead.pid << R"(,"started":)" << dead.started << R"(,"use":"run","since":"2003"})";
  CHECK(refusal(store, this_process()).empty());
}

TEST_CASE("host_lock: a store on a local disk needs no lock") {
  const TemporaryFolder folder;
  CHECK_FALSE(schema::is_on_network(folder / "campaign.db"));
  const HostLock lock(folder / "campaign.db", Use::run);
  CHECK_FALSE(std::filesystem::exists(folder / "campaign.db.host"));
}
