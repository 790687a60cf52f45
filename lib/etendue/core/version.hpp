// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace etendue {

/// Semantic version of the library, as "major.minor.patch".
const char* version();

}  // namespace etendue
