// SPDX-License-Identifier: Apache-2.0
#include "validate_command.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <system_error>

#include "etendue/core/result.hpp"

namespace etendue::cli {

namespace {

int fail(std::ostream& err, const std::string& message) {
  err << "etendue validate: " << message << "\n";
  return static_cast<int>(ErrorCode::input_output);
}

}  // namespace

int validate(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  std::error_code unreadable;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  if (unreadable) return fail(err, "cannot tell where this program lies: /proc/self/exe: " + unreadable.message());
  const std::string program = (self.parent_path() / "etendue-validate").string();

  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  out.flush();  // what we have written so far must not come after, or twice
  err.flush();
  ::execv(program.c_str(), argv.data());
  return fail(err, program + ": " + std::strerror(errno) + "; it is built with -DETENDUE_BUILD_VALIDATION=ON");
}

}  // namespace etendue::cli
