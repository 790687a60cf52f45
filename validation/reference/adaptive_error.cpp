// SPDX-License-Identifier: Apache-2.0
// Makes docs/adaptive-error.csv and .svg: how many elements a floor with a shadow needs for an error, divided evenly and where
// its radiosity changes.
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <string>

#include "refinement/penumbra.hpp"

namespace etendue::validation {
namespace {

struct Curve {
  const char* name;
  const char* colour;
  std::vector<std::array<double, 2>> points;  ///< elements, root mean square error as a share of the brightest point
};

std::vector<Curve> measured() {
  std::vector<Curve> curves{{"uniform", "#c33", {}}, {"adaptive from 8 x 8 by 0 to 3 levels", "#26c", {}}};
  const Penumbra penumbra;
  const double brightest = penumbra.radiosity(0, 0.5);
  const auto add = [&](Curve& curve, const AdaptiveSolution& solution) {
    curve.points.push_back(
        {static_cast<double>(floor_elements(solution)), error_on_floor(penumbra, solution) / brightest});
  };
  for (const int cells : {8, 16, 32, 64}) add(curves[0], adapted(penumbra.scene(cells), {1e9, 0, 100'000}));
  for (const int levels : {0, 1, 2, 3}) add(curves[1], adapted(penumbra.scene(8), {0.08, levels, 100'000}));
  return curves;
}

/// Logarithmic axes: elements from 50 to 5,000, errors from 0.01 to 0.2.
int write(const std::string& folder) {
  constexpr double kLeft = 60, kTop = 40, kWidth = 480, kHeight = 300, kMost = 0.2;
  const auto x = [](double elements) { return kLeft + kWidth * std::log10(elements / 50) / 2; };
  const auto y = [](double error) { return kTop + kHeight * std::log(kMost / error) / std::log(kMost / 1e-2); };
  std::ofstream table(folder + "/adaptive-error.csv"), picture(folder + "/adaptive-error.svg");
  table << "curve,elements,relative_rms_error\n" << std::setprecision(4);
  picture << std::setprecision(5)
          << "<!-- SPDX-License-Identifier: Apache-2.0; made by validation/reference/adaptive_error.cpp -->\n"
             "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 580 440' font-family='sans-serif' font-size='12'>\n"
             "<rect width='580' height='440' fill='#fff'/>\n<text x='300' y='22' text-anchor='middle' "
             "font-size='14'>Error of a floor with a shadow, against its closed form</text>\n<rect x='"
          << kLeft << "' y='" << kTop << "' width='" << kWidth << "' height='" << kHeight
          << "' fill='none' stroke='#555'/>\n<text x='300' y='378' text-anchor='middle'>elements</text>\n";
  for (const double error : {0.01, 0.02, 0.05, 0.1, 0.2}) {
    picture << "<path d='M" << kLeft << ' ' << y(error) << "h" << kWidth << "' stroke='#ddd'/><text x='" << kLeft - 6
            << "' y='" << y(error) + 4 << "' text-anchor='end'>" << error << "</text>\n";
  }
  for (const double elements : {64, 256, 1024, 4096}) {
    picture << "<path d='M" << x(elements) << ' ' << kTop + kHeight << "v-5' stroke='#555'/><text x='" << x(elements)
            << "' y='" << kTop + kHeight + 18 << "' text-anchor='middle'>" << elements << "</text>\n";
  }
  double row = 402;
  for (const Curve& curve : measured()) {
    picture << "<polyline fill='none' stroke-width='2' stroke='" << curve.colour << "' points='";
    for (const auto& [elements, error] : curve.points) {
      table << curve.name << ',' << elements << ',' << error << '\n';
      picture << x(elements) << ',' << y(error) << ' ';
    }
    picture << "'/>\n<path d='M60 " << row - 4 << "h30' stroke-width='2' stroke='" << curve.colour
            << "'/><text x='98' y='" << row << "'>" << curve.name << "</text>\n";
    row += 17;
  }
  picture << "</svg>\n";
  return table.flush() && picture.flush() ? 0 : 1;
}

}  // namespace
}  // namespace etendue::validation

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: adaptive-error FOLDER\n", stderr);
    return 2;
  }
  return etendue::validation::write(arguments[1]);
}
