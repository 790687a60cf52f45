// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/optics/colour.hpp"

namespace etendue {

/// x̄, ȳ, z̄ of the CIE 1931 standard observer at the table's wavelengths.
extern const double kObserverTable[kTableLength][3];

}  // namespace etendue
