// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/words.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <string>

#include "support/temporary_folder.hpp"

using namespace haff;

namespace {

// A process that holds a lock on a file until it is killed.
class Holder {
 public:
  Holder(const std::filesystem::path& file, short kind) {
    std::array<int, 2> ready{};
    REQUIRE(pipe(ready.data()) == 0);
    id_ = fork();
    if (id_ == 0) {
      const int descriptor = open(file.c_str(), O_RDWR);
      struct flock lock {};
      lock.l_type = kind;
      lock.l_start = 100;
      lock.l_len = 1;
      const char done = fcntl(descriptor, F_SETLK, &lock) == 0 ? '1' : '0';
      if (write(ready[1], &done, 1) == 1) pause();
      _exit(0);
    }
    char done = '0';
    REQUIRE(read(ready[0], &done, 1) == 1);
    REQUIRE(done == '1');
    close(ready[0]);
    close(ready[1]);
  }
  ~Holder() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  std::string id() const { return std::to_string(id_); }

 private:
  pid_t id_ = 0;
};

}  // namespace

TEST_CASE("words: a busy store names the process that writes, or else those that read") {
  const haff::TemporaryFolder folder;
  const auto store = folder.path() / "c.db";
  std::ofstream(store) << std::string(200, ' ');
  CHECK(schema::lock_holders(store).empty());
  const std::string name = " (schema_tests)";
  {
    const Holder reader(store, F_RDLCK);
    CHECK(schema::lock_holders(store) == "process " + reader.id() + name);
  }
  std::ofstream(store.string() + "-shm") << std::string(200, ' ');
  const Holder reader(store, F_RDLCK), writer(store.string() + "-shm", F_WRLCK);
  CHECK(schema::lock_holders(store) == "process " + writer.id() + name);
}
