// SPDX-License-Identifier: Apache-2.0
// Makes obstructed_pairs.csv: A_1 F_12 past plates for the pairs of oracles/obstructed_pairs.hpp, each integrated over the
// one polygon and over the other, in slices of different directions. Run by hand; no argument makes all rows (about an hour),
// two arguments a share of them, a third one family:
//     obstructed-pairs-table [remainder modulus [family]] > obstructed_pairs.csv
// Two integrations may agree by accident while both still err: of rows made with looser goals (1e-7 for several plates) a
// dozen were off by up to 9e-9. Those with several plates, and those that two sides of the engine contradicted, were made
// again with slices at 2.0 and 0.7 and goals of 1e-9 and 1e-11.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "oracles/obstructed_pairs.hpp"

int main(int count, char** arguments) {
  namespace oracle = etendue::oracle;
  constexpr double kWanted = 1e-10;  // of A_1 F_12, between the two integrations
  const int remainder = count > 2 ? std::atoi(arguments[1]) : 0, modulus = count > 2 ? std::atoi(arguments[2]) : 1;
  const std::string_view only = count > 3 ? arguments[3] : "";
  if (remainder == 0) std::printf("family,index,exchange,uncertainty\n");
  int row = 0;
  for (int index = 0; index < oracle::kMostPairs; ++index) {
    for (const oracle::PairFamily family : oracle::kPairFamilies) {
      if (!only.empty() && only != oracle::name(family)) continue;
      if (index >= oracle::pairs_in(family) || row++ % modulus != remainder) continue;
      const oracle::ObstructedPair pair = oracle::obstructed_pair(family, index);
      // The rules' own differences are far above their errors: what counts is how far the two integrations differ.
      double goal = pair.plates.size() == 1 ? 1e-8 : 1e-9, value = 0, difference = 0;
      for (int attempt = 0; attempt < 3; ++attempt) {
        const double there = oracle::obstructed_exchange(pair, 0.3, goal).value;
        const double back = oracle::obstructed_exchange(oracle::reversed(pair), 1.0, goal).value;
        value = 0.5 * (there + back);
        difference = std::abs(there - back);
        if (difference <= kWanted) break;
        goal *= 0.03;
      }
      std::printf("%s,%d,%.17g,%.2g\n", oracle::name(family).data(), index, value, difference);
      std::fflush(stdout);
    }
  }
}
