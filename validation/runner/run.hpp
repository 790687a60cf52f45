// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace etendue::validation {

/// The whole program: command line in, tests run, reports written; returns the exit code. The register comes as two
/// JSON texts so that a self-test can bring its own.
int run_validation(int argc, char** argv, std::string_view claims_json, std::string_view errata_json);

}  // namespace etendue::validation
