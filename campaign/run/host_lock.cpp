#include "campaign/run/host_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>

#include "campaign/base/command_text.hpp"
#include "campaign/base/signals.hpp"
#include "campaign/run/process.hpp"
#include "schema/network.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Holder {
  schema::Owner owner;
  bool is_run = false;
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
  holder.is_run = text.value("run", false);
  holder.since = text.value("since", "");
  return holder;
}

}  // namespace

HostLock::HostLock(const fs::path& store, bool is_run)
    : HostLock(store, is_run, schema::is_on_network(store), this_process(), usual_patience) {}

HostLock::HostLock(const fs::path& store, bool is_run, bool is_on_network, const schema::Owner& me,
                   std::chrono::milliseconds patience)
    : file_(fs::weakly_canonical(store).string() + ".host") {
  if (!is_on_network) return;
  constexpr std::chrono::milliseconds pause{100};
  const auto until = std::chrono::steady_clock::now() + patience;
  for (;;) {
    is_ours_ = take(me, is_run);
    if (is_ours_) return;
    const auto holder = holder_of(file_);
    if (!holder) continue;
    const Life life = holder->owner.host == me.host ? life_of(holder->owner) : Life::unknown;
    if (life == Life::alive && holder->is_run) return;  // shared with the run of this host
    if (life == Life::dead) {
      std::error_code ignored;
      fs::remove(file_, ignored);
      continue;
    }
    if (std::chrono::steady_clock::now() > until || !may_wait_for_locks())
      throw schema::Locked(fmt::format(
          "{}: is used by process {} on host {} since {}, and lies on a network file system, where "
          "two hosts must not use it at once; wait for that process, or if it is gone: rm {}",
          store.string(), holder->owner.pid, holder->owner.host, holder->since,
          shell_word(file_.string())));
    std::this_thread::sleep_for(pause);
  }
}

HostLock::~HostLock() {
  std::error_code ignored;
  if (is_ours_) fs::remove(file_, ignored);
}

// Network file systems make a file that must not exist yet at the server: one of two hosts wins.
bool HostLock::take(const schema::Owner& me, bool is_run) const {
  const std::string text =
      json{{"host", me.host}, {"boot_id", me.boot_id},
           {"pid", me.pid},   {"started", me.started},
           {"run", is_run},   {"since", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))}}
          .dump() +
      '\n';
  const int file = open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0) {
    if (errno == EEXIST) return false;
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
    throw schema::DiskError(file_.string() + ": cannot be written; make room");
  }
  return true;
}

}  // namespace haff::campaign
