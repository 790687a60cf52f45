// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "etendue/core/contract.hpp"

namespace etendue {

/// Why something could not be done. The values are the exit codes of the programs.
enum class ErrorCode {
  check_failed = 1,
  usage = 2,
  invalid_input = 3,
  not_converged = 4,
  input_output = 5,
  stopped = 6,
};

/// The message names the datum, its value, the rule it breaks, and the place.
struct Error {
  ErrorCode code;
  std::string message;
};

/// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    require(ok(), "Result: value() of a failure");
    return std::get<0>(state_);
  }
  T&& value() && {
    require(ok(), "Result: value() of a failure");
    return std::get<0>(std::move(state_));
  }
  const T& operator*() const& { return value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const {
    require(!ok(), "Result: error() of a success");
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// The value of an operation that only succeeds or fails.
struct Done {};

}  // namespace etendue
