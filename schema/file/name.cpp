// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/name.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "schema/error.hpp"
#include "schema/file/file_system.hpp"
#include "schema/file/words.hpp"

namespace haff::schema {

namespace {

// SQLite refuses paths of 512 bytes, of which "-journal" needs eight.
constexpr std::size_t longest_path = 503;

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  if (S_ISSOCK(mode)) return "a socket";
  return "no file";
}

[[noreturn]] void refuse(const std::filesystem::path& name, const std::string& why) {
  throw NameError(name.string() + ": " + why, Remedy::name_a_store);
}

[[noreturn]] void unreachable(const std::filesystem::path& name, int error) {
  const std::string reason = std::generic_category().message(error);
  if (error == EACCES)
    throw StoreError(name.string() + ": may not be reached (" + reason +
                     "); check the permissions of the folders on its path");
  refuse(name, "cannot be a store (" + reason + ")");
}

}  // namespace

std::filesystem::path resolved(const std::filesystem::path& name) {
  if (name.empty()) throw NameError("the name of the store is empty", Remedy::name_a_store);
  struct stat info {};
  if (stat(name.c_str(), &info) == 0) {
    if (!S_ISREG(info.st_mode)) refuse(name, std::string("is ") + kind_of(info.st_mode));
  } else if (errno != ENOENT) {
    unreachable(name, errno);
  } else if (!name.has_filename()) {
    refuse(name, "names a folder");
  } else if (lstat(name.c_str(), &info) == 0 && S_ISLNK(info.st_mode)) {  // else just made
    refuse(name, "is a link to a file that is not there");
  }
  std::error_code error;
  const auto absolute = std::filesystem::absolute(name);
  const auto folder = std::filesystem::canonical(absolute.parent_path(), error);
  if (error)
    throw NameError(name.string() + ": its folder, " + absolute.parent_path().string() +
                    ", is not there; make it first");
  auto file = std::filesystem::canonical(absolute, error);  // the last name may be a link as well
  if (error) file = folder / absolute.filename();
  if (file.string().size() > longest_path)
    refuse(name, "has too long a path: SQLite allows " + std::to_string(longest_path) + " bytes");
  return file;
}

void must_exist(const std::filesystem::path& name, const std::filesystem::path& file) {
  if (!identity_of(file))
    throw NameError(name.string() + ": there is no such store", Remedy::plan, name);
}

void must_have_one_name(const std::filesystem::path& name, const std::filesystem::path& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) == 0 && info.st_nlink > 1)
    throw StoreError(
        name.string() + ": has " + std::to_string(info.st_nlink) +
            " names (hard links), and each would get a log of its own; write to a copy "
            "that has one",
        Remedy::back_up, name);
}

void make(const std::filesystem::path& name, const std::filesystem::path& file) {
  constexpr mode_t all_may_read_and_write = 0666;  // less what the umask forbids
  const int made =
      ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, all_may_read_and_write);
  if (made >= 0) {
    close(made);
    return;
  }
  if (errno == EEXIST) return;
  const std::string reason = std::generic_category().message(errno);
  if (errno == EACCES || errno == EPERM || errno == EROFS)
    throw StoreError(name.string() + ": cannot be made (" + reason + ")" + in_the_way(file));
  throw DiskError(name.string() + ": cannot be made (" + reason + ")");
}

std::optional<FileIdentity> identity_of(const std::filesystem::path& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) != 0) return std::nullopt;
  return FileIdentity{.device = info.st_dev, .inode = info.st_ino};
}

std::filesystem::path beside(const std::filesystem::path& file, const char* suffix) {
  return file.string() + suffix;
}

bool may_write(const std::filesystem::path& file) {
  return access(file.c_str(), W_OK) == 0 && access(file.parent_path().c_str(), W_OK) == 0;
}

}  // namespace haff::schema
