// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "etendue/geometry/vector.hpp"
#include "etendue/io/read_errors.hpp"

namespace etendue {

/// A surface of a .vs3 file as written: its corners, and how it stands to others.
struct Vs3Surface {
  enum class Kind { surface, mask, null, obstruction };
  Kind kind = Kind::surface;
  std::size_t line = 0;
  long number = 0;
  std::vector<Vec3> corners;  ///< empty where they could not be read
  long base = 0;              ///< number of the surface it lies in; 0: none
  long combined = 0;          ///< number of the surface it is counted with; 0: none
  double emittance = 1;
  std::string name;

  std::string called() const { return "surface " + std::to_string(number) + " '" + name + "'"; }
};

struct Vs3File {
  std::string title;
  bool enclosure = false;   ///< encl=1: asks for rows that sum to one
  bool emittances = false;  ///< emit=1: asks for factors with reflection
  std::vector<Vs3Surface> surfaces;
};

/// Reads the records of View3D's input, both ways to give geometry (F 3 and F 3a). Everything wrong is added to `errors`.
[[nodiscard]] Vs3File parse_vs3(std::string_view text, ReadErrors& errors);

}  // namespace etendue
