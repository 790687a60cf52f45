// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

#include "etendue/core/result.hpp"

namespace etendue::validation {

/// A copy of this process, forked where threads have not begun, that computes a text for it.
class Child {
 public:
  /// The copy runs `work`, hands over what it returns, and ends; nothing after start() runs in it.
  [[nodiscard]] static Result<Child> start(const std::function<std::string()>& work);

  struct Ended {
    bool well = false;  ///< it handed over all its text
    int signal = 0;     ///< that ended it; 0: none
    std::string text;
  };
  /// Waits for the end, and calls `meanwhile` several times a second. Once for each child.
  Ended wait(const std::function<void()>& meanwhile = [] {});

  void stop() const;  ///< asks it to stop, as Ctrl-C does

 private:
  Child(pid_t process, int pipe) : process_(process), pipe_(pipe) {}
  pid_t process_;
  int pipe_;
};

}  // namespace etendue::validation
