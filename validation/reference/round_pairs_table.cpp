// SPDX-License-Identifier: Apache-2.0
// Makes round_pairs.csv: A_1 F_12 of the pairs of oracles/round_pairs.hpp, the mean of three measures of lines whose charts of
// directions are turned and tilted against one another, and three times what these differ by. Run by hand; no argument makes all rows
// (some two minutes of processor time), two a share of them:
//     round-pairs-table [remainder modulus] > round_pairs.csv
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "oracles/round_pairs.hpp"

int main(int count, char** arguments) {
  namespace oracle = etendue::oracle;
  constexpr double kWanted = 1e-7;          // of the exchange area
  constexpr long kMostDirections = 20'000;  // what a pair with many kinks gets
  const int remainder = count > 2 ? std::atoi(arguments[1]) : 0, modulus = count > 2 ? std::atoi(arguments[2]) : 1;
  if (remainder == 0) std::printf("family,index,exchange,uncertainty\n");
  int row = 0;
  for (int index = 0; index < oracle::kRoundPairs; ++index) {
    for (const oracle::RoundFamily family : oracle::kRoundFamilies) {
      if (row++ % modulus != remainder) continue;
      const oracle::RoundPair pair = oracle::round_pair(family, index);
      const double goal = kWanted * oracle::round_exchange(pair, 0.3, 0, 500).value;
      std::array<double, 3> found{};
      for (std::size_t k = 0; k < found.size(); ++k) {
        found[k] = oracle::round_exchange(pair, 0.3 + 1.1 * static_cast<double>(k), goal, kMostDirections).value;
      }
      // The cells' own differences are far above their errors: what counts is how far the integrations differ.
      const auto [least, largest] = std::minmax_element(found.begin(), found.end());
      std::printf("%s,%d,%.17g,%.2g\n", oracle::name(family).data(), index, (found[0] + found[1] + found[2]) / 3,
                  3 * (*largest - *least));
      std::fflush(stdout);
    }
  }
}
