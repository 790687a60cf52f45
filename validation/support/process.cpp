// SPDX-License-Identifier: Apache-2.0
#include "support/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <thread>

#include "support/temporary_folder.hpp"

extern char** environ;

namespace etendue::validation {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (auto& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

std::vector<std::string> environment(const ProcessOptions& options) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    bool replaced = false;
    for (const auto& [name, value] : options.environment) replaced = replaced || text.rfind(name + "=", 0) == 0;
    if (!replaced) all.push_back(text);
  }
  for (const auto& [name, value] : options.environment) all.push_back(name + "=" + value);
  return all;
}

/// A terminal that shows what a program writes to it.
class Terminal {
 public:
  Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)) {
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) throw std::runtime_error("no terminal");
    char name[64];
    if (::ptsname_r(master_, name, sizeof name) != 0) throw std::runtime_error("no terminal");
    slave_ = ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);  // held, or it would close before the program opens its own
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    ::close(slave_);
    ::close(master_);
  }

  int slave() const { return slave_; }

  /// Everything written to it so far.
  const std::string& text() {
    char piece[4096];
    for (ssize_t got = 0; (got = ::read(master_, piece, sizeof piece)) > 0;) {
      text_.append(piece, static_cast<std::size_t>(got));
    }
    return text_;
  }

 private:
  int master_ = -1, slave_ = -1;
  std::string text_;
};

/// Has it had its time, said too much, or is it no longer wanted? Notes which.
bool to_be_killed(const ProcessOptions& options, Clock::time_point begin, Ended& ended) {
  std::error_code missing;
  ended.too_long = seconds_since(begin) > options.longest;
  ended.too_much = options.most > 0 && std::filesystem::file_size(options.out, missing) > options.most && !missing;
  return ended.too_long || ended.too_much || (options.stop && *options.stop);
}

/// Waits for the end; interrupts and kills when it is time.
int wait_for(pid_t process, Clock::time_point begin, const ProcessOptions& options, Terminal* terminal, Ended& ended) {
  int status = 0;
  int interrupts = (options.interrupt_after > 0 || terminal ? 1 : 0) + (options.interrupt_again > 0 ? 1 : 0);
  double again_at = 0;
  bool killed = false;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    const bool now = again_at > 0 ? seconds_since(begin) >= again_at
                     : terminal   ? terminal->text().find(options.interrupt_at) != std::string::npos
                                  : seconds_since(begin) >= options.interrupt_after;
    if (interrupts > 0 && now) {
      ::kill(process, SIGINT);
      --interrupts;
      again_at = seconds_since(begin) + options.interrupt_again;
    }
    if (!killed && to_be_killed(options, begin, ended)) {
      ::kill(options.with_children ? -process : process, SIGKILL);
      killed = true;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  if (options.with_children) ::kill(-process, SIGKILL);  // what it left running
  return status;
}

}  // namespace

Ended run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  const ProcessOptions& options) {
  const TemporaryFolder folder;
  const auto out = options.out.empty() ? folder.path() / "out" : options.out;
  const auto err = folder.path() / "err";
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  ProcessOptions named = options;
  named.out = out;
  if (!options.interrupt_at.empty()) named.environment.emplace_back("TERM", "xterm");  // or no progress would be shown
  std::vector<std::string> variables = environment(named);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!options.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());
  if (!options.in.empty()) posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, options.in.c_str(), O_RDONLY, 0);
  int ends[2] = {-1, -1};
  if (options.closed_pipe) {
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    ::close(ends[0]);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  }
  std::unique_ptr<Terminal> terminal;
  if (options.interrupt_at.empty()) {
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  } else {
    terminal = std::make_unique<Terminal>();
    posix_spawn_file_actions_adddup2(&actions, terminal->slave(), STDERR_FILENO);
  }

  // A background job ignores interrupts, this program a closed pipe and a limit on files, and so would its children:
  // these start as from a terminal.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t heeded;
  sigemptyset(&heeded);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) sigaddset(&heeded, signal);
  posix_spawnattr_setsigdefault(&attributes, &heeded);
  posix_spawnattr_setflags(
      &attributes, static_cast<short>(POSIX_SPAWN_SETSIGDEF | (options.with_children ? POSIX_SPAWN_SETPGROUP : 0)));

  const auto begin = Clock::now();
  pid_t process = 0;
  const int failure = posix_spawnp(&process, program.c_str(), &actions, &attributes, pointers(words).data(),
                                   pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (ends[1] >= 0) ::close(ends[1]);
  if (failure != 0) throw std::runtime_error("cannot start " + program.string());

  Ended ended;
  const int status = wait_for(process, begin, named, terminal.get(), ended);
  ended.seconds = seconds_since(begin);
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
  if (options.out.empty() && !options.closed_pipe) ended.out = read_text(out);
  ended.err = terminal ? terminal->text() : read_text(err);
  return ended;
}

Ended run_etendue(const std::vector<std::string>& arguments, const ProcessOptions& options) {
  return run_process(etendue_program(), arguments, options);
}

const std::filesystem::path& etendue_program() {
  static const std::filesystem::path path = [] {
    const char* other = std::getenv("ETENDUE_PROGRAM");  // ci/mutate names a changed one
    return other == nullptr ? ETENDUE_PROGRAM : other;
  }();
  return path;
}

const std::filesystem::path& source_root() {
  static const std::filesystem::path path = ETENDUE_SOURCE_ROOT;
  return path;
}

}  // namespace etendue::validation
