// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Thrown when a caller breaks a documented precondition. Bad data from outside is a Result, never this.
struct ContractViolation : std::logic_error {
  using std::logic_error::logic_error;
};

/// Refuses to go on unless `condition` holds; active in every build type.
/// `rule` reads "function: the rule", as in "refract: direction is a unit vector".
inline void require(bool condition, const char* rule) {
  if (!condition) throw ContractViolation(rule);
}

}  // namespace etendue
