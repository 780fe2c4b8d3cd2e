// SPDX-License-Identifier: GPL-3.0-or-later

// The name of a store is the path of a file, also where SQLite would take it for something else.
#include "schema/file/name.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

// In a folder of its own, where names are tried as a user types them.
class Here {
 public:
  Here() { std::filesystem::current_path(folder_.path()); }
  ~Here() { std::filesystem::current_path(before_); }
  Here(const Here&) = delete;
  Here& operator=(const Here&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  std::size_t files() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder_.path()))
      ++count;
    return count;
  }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
  TemporaryFolder folder_;
};

std::string refusal_of(const std::filesystem::path& name) {
  CHECK_THROWS_AS(Store::open(name), NameError);
  CHECK_THROWS_AS(Reader{name}, NameError);
  return refusal([&] { Store::create(name); });
}

}  // namespace

TEST_CASE("names with a special meaning in SQLite are paths of files") {
  const Here here;
  for (const char* name : {"file:c.db", "file:c.db?mode=memory",
                           ":memory:", "file::memory:", "a#b?c%20.db", "c d.db"}) {
    CAPTURE(std::string(name));
    Store::create(name).add(plan({cooling()}));
    CHECK(std::filesystem::is_regular_file(here / name));
    CHECK(Reader(name).jobs().size() == 2);
    CHECK(Store::open(name).jobs().size() == 2);
  }
  CHECK(here.files() == 6);
}

TEST_CASE("two slashes at the beginning are one") {
  const Here here;
  const std::string name = "/" + (here / "c.db").string();
  Store::create(name).add(plan({cooling()}));
  CHECK(Reader(name).jobs().size() == 2);
  CHECK(std::filesystem::exists(here / "c.db"));
}

TEST_CASE("a path that cannot be a store is refused by name, and nothing is left behind") {
  const Here here;
  std::filesystem::create_directory("folder");
  REQUIRE(mkfifo("pipe", 0600) == 0);
  std::filesystem::create_symlink("nowhere", "link");
  CHECK(refusal_of("") == "the name of the store is empty");
  CHECK(refusal_of("c/") == "c/: names a folder");
  CHECK(refusal_of("folder") == "folder: is a folder");
  CHECK(refusal_of("folder/") == "folder/: is a folder");
  CHECK(refusal_of("pipe") == "pipe: is a pipe");
  CHECK(refusal_of("/dev/null") == "/dev/null: is a device");
  CHECK(refusal_of("link") == "link: is a link to a file that is not there");
  CHECK(refusal_of("no/c.db").find("its folder") != std::string::npos);
  CHECK(refusal_of(std::string(200, 'x') + std::string(200, 'y')).find("File name too long") !=
        std::string::npos);
  CHECK(here.files() == 3);
}
