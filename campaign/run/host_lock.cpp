// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/host_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>

#include "campaign/base/output/output.hpp"
#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/run/process.hpp"
#include "schema/file/network.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* name(Use use) {
  return use == Use::read ? "read" : use == Use::write ? "write" : "run";
}

struct Holder {
  schema::Owner owner;
  Use use = Use::write;
  std::string since;  // UTC
};

// Nothing if there is no such file. A file that cannot be read, since it is being written, is held
// by a process that is not known.
std::optional<Holder> holder_of(const fs::path& path) {
  std::ifstream file(path);
  if (!file) return std::nullopt;
  const json text = json::parse(file, nullptr, false);
  Holder holder;
  if (!text.is_object()) return holder;
  holder.owner = {.host = text.value("host", ""),
                  .boot_id = text.value("boot_id", ""),
                  .pid = text.value("pid", std::int64_t{0}),
                  .started = text.value("started", std::int64_t{0})};
  for (const Use use : {Use::read, Use::run})
    if (text.value("use", "") == name(use)) holder.use = use;
  holder.since = text.value("since", "");
  return holder;
}

// What a command does when it finds the lock of a living process of its own host.
enum class Manners { share, take_over, wait };

Manners manners(Use mine, Use theirs) {
  if (mine == Use::read) return Manners::share;
  if (theirs == Use::read) return Manners::take_over;  // or it would end before our use does
  return mine == Use::write && theirs == Use::run ? Manners::share : Manners::wait;
}

}  // namespace

HostLock::HostLock(const fs::path& store, Use use, std::chrono::milliseconds patience)
    : HostLock(store, use, schema::is_on_network(store), this_process(), patience) {}

HostLock::HostLock(const fs::path& store, Use use, bool is_on_network, const schema::Owner& me,
                   std::chrono::milliseconds patience)
    : file_(fs::weakly_canonical(store).string() + ".host"), use_(use), me_(me) {
  if (!is_on_network) return;
  constexpr std::chrono::milliseconds pause{100};
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const Taken taken = take();
    is_ours_ = taken == Taken::yes;
    if (taken != Taken::no) return;
    const auto holder = holder_of(file_);
    if (!holder) continue;  // it has just ended
    const bool is_here = holder->owner.host == me.host;
    const Life life = is_here ? life_of(holder->owner) : Life::unknown;
    const auto how = life == Life::alive ? manners(use, holder->use) : Manners::wait;
    if (how == Manners::share) return;
    const auto waited = std::chrono::steady_clock::now() - start;
    const bool is_old_reader =
        holder->use == Use::read && waited > std::min(patience, usual_patience);
    if (life == Life::dead || how == Manners::take_over || is_old_reader) {
      std::error_code ignored;
      fs::remove(file_, ignored);
      continue;
    }
    if (waited > patience || !may_wait_for_locks())
      throw schema::Locked(fmt::format(
          "{}: is used by process {} on host {} since {}, and lies on a network file system, where "
          "{} must not use it at once; wait for that process, or if it is gone: rm {}",
          store.string(), holder->owner.pid, holder->owner.host, holder->since,
          is_here ? "two such commands" : "two hosts", shell_word(file_.string())));
    std::this_thread::sleep_for(pause);
  }
}

HostLock::~HostLock() {
  if (!is_ours_) return;
  const auto holder = holder_of(file_);
  if (holder && holder->owner == me_) {
    std::error_code ignored;
    fs::remove(file_, ignored);
  } else if (use_ == Use::read && holder && holder->owner.host != me_.host) {
    complain(
        "campaign: host {} has begun to use the store while it was read here; if what was "
        "read is not in order, give the same command again\n",
        holder->owner.host);
  }
}

// Network file systems make a file that must not exist yet at the server: one of two hosts wins.
HostLock::Taken HostLock::take() const {
  const std::string text =
      json{
          {"host", me_.host},  {"boot_id", me_.boot_id},
          {"pid", me_.pid},    {"started", me_.started},
          {"use", name(use_)}, {"since", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))}}
          .dump() +
      '\n';
  const int file = open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0) {
    if (errno == EEXIST) return Taken::no;
    if (use_ == Use::read) return Taken::impossible;
    throw schema::StoreError(
        fmt::format("{}: cannot be made ({}); check that its folder may be "
                    "written",
                    file_.string(), std::generic_category().message(errno)));
  }
  const bool written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(file);
  if (!written) {
    std::error_code ignored;
    fs::remove(file_, ignored);
    if (use_ == Use::read) return Taken::impossible;
    throw schema::DiskError(file_.string() + ": cannot be written; make room");
  }
  return Taken::yes;
}

}  // namespace haff::campaign
