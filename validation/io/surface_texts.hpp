// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace etendue::validation {

/// Corners of the box 2 × 1 × 1, and its six walls as seen from inside: floor, ceiling, x low, x high, y low, y high.
inline constexpr double kBoxCorners[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0},
                                             {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}};
inline constexpr int kBoxWalls[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 3, 7, 4},
                                        {2, 1, 5, 6}, {1, 0, 4, 5}, {3, 2, 6, 7}};

inline std::string digits(double value) {
  return std::to_string(static_cast<int>(value));
}

inline std::string corner_text(int corner) {
  return digits(kBoxCorners[corner][0]) + " " + digits(kBoxCorners[corner][1]) + " " + digits(kBoxCorners[corner][2]);
}

inline std::vector<std::array<int, 3>> box_triangles() {
  std::vector<std::array<int, 3>> triangles;
  for (const auto& w : kBoxWalls) {
    triangles.push_back({w[0], w[1], w[2]});
    triangles.push_back({w[0], w[2], w[3]});
  }
  return triangles;
}

inline std::string ascii_stl() {
  std::string text = "solid box\n";
  for (const auto& t : box_triangles()) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : t) text += "vertex " + corner_text(corner) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

inline std::string binary_stl() {
  std::string bytes(80, ' ');
  const auto word = [&](std::uint32_t value) {
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>((value >> (8 * k)) & 0xFF);
  };
  word(12);
  for (const auto& t : box_triangles()) {
    for (int k = 0; k < 3; ++k) word(0);
    for (const int corner : t) {
      for (const double c : kBoxCorners[corner]) word(std::bit_cast<std::uint32_t>(static_cast<float>(c)));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

/// The box in every format but ours: file name and text.
inline std::vector<std::pair<std::string, std::string>> room_texts() {
  std::string vs3 = "T box\nC eps=1e-5\nF 3\n", obj = "# box\no box\n";
  for (int k = 0; k < 8; ++k) {
    vs3 += "V " + std::to_string(k + 1) + " " + corner_text(k) + "\n";
    obj += "v " + corner_text(k) + "\n";
  }
  for (int w = 0; w < 6; ++w) {
    std::string corners;
    for (const int corner : kBoxWalls[w]) corners += " " + std::to_string(corner + 1);
    vs3 += "S " + std::to_string(w + 1) + corners + " 0 0 0.9 wall-" + std::to_string(w) + "\n";
    obj += "f" + corners + "\n";
  }
  // Origin, azimuth, tilt as View3D's manual explains them: a wall's lower left corner as seen from its front; azimuth 0
  // faces north, +y; tilt 0 faces upward, 180 downward.
  const std::string blast =
      "F 3a\n"
      "S 1 R 0 0 0.9 floor\n 0 0 0 180 0 2 1\n"
      "S 2 R 0 0 0.9 ceiling\n 2 0 1 0 180 2 1\n"
      "S 3 r 0 0 0.9 x-low\n 0 0 0 90 90\n 1 1\n"
      "S 4 R 0 0 0.9 x-high\n 2 1 0 270 90 1 1\n"
      "S 5 Q 0 0 0.9 y-low\n 2 0 0 0 90\n 0 0 2 0 2 1 0 1\n"
      "S 6 R 0 0 0.9 y-high\n 0 1 0 180 90 2 1\n";
  return {{"box.vs3", vs3},
          {"blast.vs3", blast},
          {"box.obj", obj},
          {"ascii.stl", ascii_stl()},
          {"binary.stl", binary_stl()}};
}

}  // namespace etendue::validation
