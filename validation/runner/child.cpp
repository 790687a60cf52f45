// SPDX-License-Identifier: Apache-2.0
#include "runner/child.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace etendue::validation {

namespace {

bool write_all(int descriptor, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written <= 0 && errno != EINTR) return false;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return true;
}

std::string read_all(int descriptor, const std::function<void()>& meanwhile) {
  constexpr int kMilliseconds = 100;
  std::string text;
  char buffer[4096];
  for (;;) {
    pollfd ready{descriptor, POLLIN, 0};
    if (::poll(&ready, 1, kMilliseconds) <= 0) {
      meanwhile();
      continue;
    }
    const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

}  // namespace

Result<Child> Child::start(const std::function<std::string()>& work) {
  int ends[2];
  if (::pipe(ends) != 0) return Error{ErrorCode::input_output, "no pipe to a child process"};
  const pid_t process = ::fork();
  if (process < 0) {
    for (const int end : ends) ::close(end);
    return Error{ErrorCode::input_output, "no child process"};
  }
  if (process == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // whoever kills the parent means the whole run
    ::close(ends[0]);
    ::_exit(write_all(ends[1], work()) ? 0 : 1);
  }
  ::close(ends[1]);
  return Child(process, ends[0]);
}

Child::Ended Child::wait(const std::function<void()>& meanwhile) {
  Ended ended;
  ended.text = read_all(pipe_, meanwhile);
  ::close(pipe_);
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  ended.well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return ended;
}

void Child::stop() const {
  ::kill(process_, SIGTERM);
}

}  // namespace etendue::validation
