// SPDX-License-Identifier: Apache-2.0
#include "etendue/text/number_text.hpp"

#include <charconv>
#include <cstdio>

namespace etendue {

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string rounded(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string counted_errors(std::size_t count) {
  return counted(count, "error");
}

}  // namespace etendue
