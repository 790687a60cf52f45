// SPDX-License-Identifier: Apache-2.0
#include "validate_command.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <ostream>
#include <system_error>

#include "etendue/text/utf8.hpp"
#include "outputs.hpp"

namespace etendue::cli {

namespace {

int fail(std::ostream& err, const std::string& message) {
  return cli::fail(err, "validate", {ErrorCode::input_output, message});
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
  const int error = errno;
  const std::string what = quoted_path(program) + ": " + std::generic_category().message(error);
  // By design: validation holds oracles of stricter licences, and belongs to a checkout.
  const char* const advice =
      "; etendue-validate is not installed with etendue, it is built from the sources "
      "(ci/build) and run there, as build/release/bin/etendue-validate";
  return fail(err, "cannot start " + what + (error == ENOENT ? advice : ""));
}

}  // namespace etendue::cli
