// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "form_factor/shapes.hpp"
#include "oracles/obstructed_pairs.hpp"

namespace etendue::validation {

/// A row of reference/obstructed_pairs.csv.
struct TableRow {
  oracle::PairFamily family;
  int index;
  double exchange;  ///< A_1 F_12
  double uncertainty;
};

inline std::vector<TableRow> table_rows() {
  std::ifstream file(ETENDUE_REFERENCE "/obstructed_pairs.csv");
  std::string line;
  std::getline(file, line);
  std::vector<TableRow> result;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    std::string family;
    TableRow row{};
    fields >> family >> row.index >> row.exchange >> row.uncertainty;
    for (const oracle::PairFamily f : oracle::kPairFamilies) {
      if (oracle::name(f) == family) row.family = f;
    }
    if (fields) result.push_back(row);
  }
  return result;
}

/// In a frame that rounds.
inline Polygon turned(const oracle::Corners& corners) {
  std::vector<Vec3> vertices;
  for (const oracle::Point& p : corners) vertices.push_back(tilted(Vec3(p[0], p[1], p[2])));
  return polygon(std::move(vertices));
}

}  // namespace etendue::validation
