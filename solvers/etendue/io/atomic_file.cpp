// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <deque>
#include <system_error>
#include <utility>

#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

Error failure(const char* verb, const fs::path& path, const std::string& reason) {
  return {ErrorCode::input_output, std::string("cannot ") + verb + " " + quoted_path(path) + ": " + reason};
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// ".etendue-<process>-<count>.tmp": unique among the threads and processes of this machine, and short, so that a name
/// that is just short enough for the file system stays so.
fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  return path.parent_path() / (".etendue-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp");
}

/// Removes the temporary file on every way out that has not given it its final name.
class Temporary {
 public:
  Temporary() = default;
  explicit Temporary(fs::path path) : path_(std::move(path)) {}
  Temporary(const Temporary&) = delete;
  Temporary& operator=(Temporary&& other) noexcept {
    path_.swap(other.path_);
    return *this;
  }
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
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  int number() const { return number_; }
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

/// What kept a file from being made in this folder.
std::string why_not_in(const fs::path& folder, int error) {
  std::error_code ignored;  // then it is not known to be missing
  const bool missing = error == ENOENT && !folder.empty() && !fs::exists(folder, ignored);
  return missing ? "there is no folder " + quoted_path(folder) : reason(error);
}

/// A file under its hidden name, which it loses with this object unless it has got its own.
class Pending {
 public:
  explicit Pending(const fs::path& path) : path_(path) {}

  /// Makes the hidden file, empty.
  Result<Done> create() {
    if (path_.filename().empty()) return failure("write", path_, "no file name");
    std::error_code error;
    const fs::file_status status = fs::status(path_, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
      return failure("write", path_, fs::is_directory(status) ? "is a directory" : "not a regular file");
    }
    if (status.type() == fs::file_type::none) return failure("write", path_, error.message());  // its name is too long
    target_ = path_;
    if (fs::is_symlink(fs::symlink_status(path_, error))) {
      target_ = fs::weakly_canonical(path_, error);
      if (error) return failure("write", path_, error.message());
    }
    const fs::path hidden = temporary_beside(target_);
    file_ = Descriptor(::open(hidden.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file_.number() < 0) return failure("write", path_, why_not_in(target_.parent_path(), errno));
    temporary_ = Temporary(hidden);
    return Done{};
  }

  Result<Done> append(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_.number(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return failure("write", path_, reason(errno));
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return Done{};
  }

  /// All is appended: brings it onto the disk.
  Result<Done> finish() {
    // A full disk may show only here.
    if (::fsync(file_.number()) != 0 && errno != EINVAL && errno != EROFS) {
      return failure("write", path_, reason(errno));
    }
    if (!file_.close()) return failure("write", path_, reason(errno));
    return Done{};
  }

  Result<Done> take_name() {
    std::error_code error;
    fs::rename(temporary_.path(), target_, error);
    if (error) return failure("write", path_, error.message());
    temporary_.keep();
    return Done{};
  }

 private:
  fs::path path_, target_;
  Temporary temporary_;
  Descriptor file_;
};

}  // namespace

Result<Done> write_files(const std::vector<NewFile>& files) {
  std::deque<Pending> pending;
  for (const NewFile& file : files) {
    Pending& next = pending.emplace_back(file.path);
    if (auto created = next.create(); !created) return created;
    if (auto filled = next.append(file.bytes); !filled) return filled;
    if (auto finished = next.finish(); !finished) return finished;
  }
  for (Pending& file : pending) {
    if (auto named = file.take_name(); !named) return named;
  }
  return Done{};
}

Result<Done> write_file(const fs::path& path, std::string_view bytes) {
  return write_files({{path, std::string(bytes)}});
}

Result<Done> write_pieces(const fs::path& path, const std::function<Result<Done>(const Append&)>& produce) {
  Pending file(path);
  if (auto created = file.create(); !created) return created;
  const Append append = [&file](std::string_view piece) { return file.append(piece); };
  if (auto produced = produce(append); !produced) return produced;
  if (auto finished = file.finish(); !finished) return finished;
  return file.take_name();
}

Result<Done> check_writable(const std::vector<fs::path>& paths) {
  for (const fs::path& path : paths) {
    Pending probe(path);
    if (auto created = probe.create(); !created) return created;
  }
  return Done{};
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
