// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace mms {

namespace {

namespace fs = std::filesystem;

Error failed(const std::string& path, int cause) {
  return {path, std::string("cannot be written: ") + std::strerror(cause),
          "check who may write to its folder, and that the disk is not full"};
}

/// Writes all of `text` and waits until it is on the disk.
bool write_all(int file, std::string_view text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return fsync(file) == 0;
}

}  // namespace

std::optional<Error> check_replaceable(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return Error{path, "the output is a folder", "name a file in it"};
  const std::string folder = fs::path(path).parent_path().string();
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    return Error{path, "no folder `" + folder + "`", "make it first"};
  if (fs::exists(path, ignored) && ::access(path.c_str(), W_OK) != 0)
    return Error{path, "the output cannot be written", "check its permissions"};
  // What replaces a file is made beside it.
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    return Error{path, "the output cannot be written", "check the permissions of its folder"};
  return std::nullopt;
}

std::optional<Error> replace_file(const std::string& path, std::string_view text) {
  std::error_code code;
  const fs::path target = fs::weakly_canonical(path, code);
  if (code) return failed(path, code.value());
  struct stat old {};
  const bool exists = ::stat(target.c_str(), &old) == 0;
  if (exists && ::access(target.c_str(), W_OK) != 0) return failed(path, errno);
  std::string name = target.string() + ".XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) return failed(path, errno);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const bool written =
      write_all(file, text) && ::fchmod(file, exists ? old.st_mode & 07777 : 0666 & ~mask) == 0;
  int cause = written ? 0 : errno;
  if (::close(file) != 0 && cause == 0) cause = errno;
  if (cause == 0 && ::rename(name.c_str(), target.c_str()) != 0) cause = errno;
  if (cause == 0) return std::nullopt;
  ::unlink(name.c_str());
  return failed(path, cause);
}

}  // namespace mms
