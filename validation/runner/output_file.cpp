// SPDX-License-Identifier: Apache-2.0
#include "runner/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace etendue::validation {

OutputFile::OutputFile(std::string path, std::string temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_) ::unlink(temporary_.c_str());
}

Error OutputFile::failure(const char* what) const {
  return Error{ErrorCode::input_output, path_ + ": " + what + ": " + std::strerror(errno)};
}

Result<std::unique_ptr<OutputFile>> OutputFile::open(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
    return Error{ErrorCode::input_output, path + ": cannot be written: it is a directory"};
  }
  const std::string temporary = path + ".part" + std::to_string(::getpid());
  constexpr mode_t kReadableByAll = 0644;
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll);
  if (descriptor < 0) {
    return Error{ErrorCode::input_output, path + ": cannot be written: " + std::strerror(errno)};
  }
  return std::unique_ptr<OutputFile>(new OutputFile(path, temporary, descriptor));
}

Result<Done> OutputFile::commit(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failure("cannot be written");
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure("cannot be closed");
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) return failure("cannot be renamed into place");
  committed_ = true;
  return Done{};
}

}  // namespace etendue::validation
