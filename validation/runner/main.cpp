// SPDX-License-Identifier: Apache-2.0
#include "runner/register.hpp"
#include "runner/run.hpp"

int main(int argc, char** argv) {
  using namespace etendue::validation;
  return run_validation(argc, argv, embedded_claims(), embedded_errata());
}
