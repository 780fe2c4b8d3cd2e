#include "campaign/run/host_lock.hpp"

#include <doctest/doctest.h>

#include <fstream>

#include "campaign/run/process.hpp"
#include "schema/network.hpp"
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

// What a second host hears, or nothing.
std::string refusal(const std::filesystem::path& store, const schema::Owner& me) try {
  const HostLock lock(store, false, true, me, 0ms);
  return "";
} catch (const schema::Locked& locked) {
  return locked.what();
}

}  // namespace

TEST_CASE("host_lock: a second host is refused, and told host, process and time") {
  const TemporaryFolder folder;
  const auto store = folder / "a store.db";
  {
    const HostLock lock(store, true, true, this_process(), 0ms);
    const std::string told = refusal(store, elsewhere());
    CHECK(told.find(this_process().host) != std::string::npos);
    CHECK(told.find("process " + std::to_string(this_process().pid)) != std::string::npos);
    CHECK(told.find("since 20") != std::string::npos);
    CHECK(told.find("a store.db.host'") != std::string::npos);
  }
  CHECK(refusal(store, elsewhere()).empty());
}

TEST_CASE("host_lock: commands of the same host share the store with a run, not with each other") {
  const TemporaryFolder folder;
  const auto store = folder / "campaign.db";
  {
    const HostLock run(store, true, true, this_process(), 0ms);
    CHECK(refusal(store, this_process()).empty());
    CHECK(std::filesystem::exists(folder / "campaign.db.host"));  // still that of the run
  }
  const HostLock plan(store, false, true, this_process(), 0ms);
  CHECK_FALSE(refusal(store, this_process()).empty());
}

TEST_CASE("host_lock: one that a dead process of this host left is no lock") {
  const TemporaryFolder folder;
  const auto store = folder / "campaign.db";
  schema::Owner dead = this_process();
  dead.started -= 1;
  std::ofstream(folder / "campaign.db.host")
      << R"({"host":")" << dead.host << R"(","boot_id":")" << dead.boot_id << R"(","pid":)"
      << dead.pid << R"(,"started":)" << dead.started << R"(,"run":true,"since":"2003"})";
  CHECK(refusal(store, this_process()).empty());
}

TEST_CASE("host_lock: a store on a local disk needs none") {
  const TemporaryFolder folder;
  CHECK_FALSE(schema::is_on_network(folder / "campaign.db"));
  const HostLock lock(folder / "campaign.db", true);
  CHECK_FALSE(std::filesystem::exists(folder / "campaign.db.host"));
}
