// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace etendue {

namespace {

namespace fs = std::filesystem;

Error failure(const char* verb, const fs::path& path, const std::string& reason) {
  return {ErrorCode::input_output, std::string("cannot ") + verb + " '" + path.string() + "': " + reason};
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// ".name.tmp-<process>-<count>.ext": unique among the threads and processes of this machine.
fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  std::string name = "." + path.stem().string() + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
  return path.parent_path() / (name + path.extension().string());
}

/// Removes the temporary file on every way out that has not given it its final name.
class Temporary {
 public:
  explicit Temporary(fs::path path) : path_(std::move(path)) {}
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    std::error_code ignored;  // nothing better can be done on the way out
    if (!path_.empty()) fs::remove(path_, ignored);
  }
  const fs::path& path() const { return path_; }
  void keep() { path_.clear(); }

 private:
  fs::path path_;
};

/// Closes on every way out; close() tells whether the last bytes got through.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  int number() const { return number_; }
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

Result<Done> write_bytes(const fs::path& temporary, const fs::path& path, std::string_view bytes) {
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.number() < 0) return failure("write", path, reason(errno));
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failure("write", path, reason(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  // A full disk may show only here.
  if (::fsync(file.number()) != 0 && errno != EINVAL && errno != EROFS) return failure("write", path, reason(errno));
  if (!file.close()) return failure("write", path, reason(errno));
  return Done{};
}

}  // namespace

Result<Done> write_atomically(const fs::path& path, const std::function<Result<Done>(const fs::path&)>& write) {
  if (path.filename().empty()) return failure("write", path, "no file name");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return failure("write", path, fs::is_directory(status) ? "is a directory" : "not a regular file");
  }
  // The link stays a link: what it points to is replaced.
  const fs::path target = fs::is_symlink(fs::symlink_status(path, error)) ? fs::weakly_canonical(path, error) : path;
  if (error && fs::is_symlink(path)) return failure("write", path, error.message());
  Temporary temporary(temporary_beside(target));
  if (auto written = write(temporary.path()); !written) return written.error();
  fs::rename(temporary.path(), target, error);
  if (error) return failure("write", path, error.message());
  temporary.keep();
  return Done{};
}

Result<Done> write_file(const fs::path& path, std::string_view bytes) {
  return write_atomically(path, [&](const fs::path& temporary) { return write_bytes(temporary, path, bytes); });
}

Result<std::string> read_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return failure("read", path, error ? error.message() : reason(ENOENT));
  if (fs::is_directory(status)) return failure("read", path, "is a directory");
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) return failure("read", path, reason(errno));
  std::string bytes;
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  for (;;) {
    const std::size_t size = bytes.size();
    if (size > kLargestFile) return failure("read", path, "larger than 1 GiB");
    bytes.resize(size + kBlock);
    const ssize_t got = ::read(file.number(), bytes.data() + size, kBlock);
    bytes.resize(size + static_cast<std::size_t>(got > 0 ? got : 0));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return failure("read", path, reason(errno));
    if (got == 0) return bytes;
  }
}

}  // namespace etendue
