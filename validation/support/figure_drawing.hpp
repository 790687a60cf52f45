// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue::validation {

inline std::string figure_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value == 0 ? 0 : value);
  return text;
}

/// Pictures are drawn in x to the right and z upwards.
class FigureDrawing {
 public:
  FigureDrawing(double width, double height, double scale) : scale_(scale), height_(height) {
    svg_ = "<!-- SPDX-License-Identifier: Apache-2.0 -->\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
           figure_number(width * scale) + "\" height=\"" + figure_number(height * scale) +
           "\" font-family=\"sans-serif\" font-size=\"15\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  }
  void line(const std::vector<Vec3>& points, const std::string& look) {
    svg_ += "<polyline fill=\"none\" " + look + " points=\"";
    for (const Vec3& p : points)
      svg_ += figure_number(p.x() * scale_) + "," + figure_number((height_ - p.z()) * scale_) + " ";
    svg_ += "\"/>\n";
  }
  void arrow(const Vec3& from, const Vec3& to, const std::string& look) {
    const Vec3 back = 0.12 * (from - to).normalized(), side(-0.4 * back.z(), 0, 0.4 * back.x());
    line({from, to, to + back + side, to, to + back - side}, look);
  }
  void text(const Vec3& at, const std::string& words) {
    svg_ += "<text x=\"" + figure_number(at.x() * scale_) + "\" y=\"" + figure_number((height_ - at.z()) * scale_) +
            "\">" + words + "</text>\n";
  }
  std::string done() const { return svg_ + "</svg>\n"; }

 private:
  double scale_, height_;
  std::string svg_;
};

inline const std::string kBlack = "stroke=\"black\" stroke-width=\"2\"", kRed = "stroke=\"#c22\" stroke-width=\"1.2\"",
                         kGrey = "stroke=\"#888\" stroke-width=\"1.2\"",
                         kDotted = "stroke=\"#c80\" stroke-width=\"1.2\" stroke-dasharray=\"4 3\"";

}  // namespace etendue::validation
