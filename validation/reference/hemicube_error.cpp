// SPDX-License-Identifier: Apache-2.0
// Writes hemicube-error.csv and hemicube-error.svg (docs/hemicube.md): the errors of hemicube and cubic tetrahedron for
// opposed unit squares, by resolution and by distance over size.
//   hemicube-error FOLDER
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

#include "etendue/assembly/hemicube_exchange.hpp"
#include "etendue/form_factor/point_polygon.hpp"
#include "etendue/form_factor/rectangles.hpp"
#include "meshing/small_scenes.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr int kTurns = 50;

struct Curve {
  std::string panel, name, colour, dashes;
  std::vector<std::array<double, 2>> points;  ///< x, relative error
};

ElementMesh opposed(double distance) {
  return *mesh_elements(
      scene_of({quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}),
                quadrilateral({0, 0, distance}, {0, 1, distance}, {1, 1, distance}, {1, 0, distance})}));
}

double from_points(const ElementMesh& mesh, int per_side) {
  double sum = 0;
  for (const StandPoint& at : stand_points(mesh.elements[0].polygon, per_side)) {
    sum += at.share * point_to_polygon(at.point, Vec3::UnitZ(), mesh.elements[1].polygon).value;
  }
  return sum;
}

/// Root mean square over random rotations, relative to `truth`, of what pixels around the centre see.
double pixel_error(const ElementMesh& mesh, const PixelProjection& projection, double truth) {
  const ItemScene scene(mesh);
  double squares = 0;
  for (std::size_t k = 0; k < kTurns; ++k) {
    double factor = 0;
    for (const SeenShare& seen : scene.seen_from({0.5, 0.5, 0}, 0, projection, turn_of(kSeed, 0, k))) {
      if (seen.element == 1) factor = seen.factor;
    }
    squares += (factor / truth - 1) * (factor / truth - 1) / kTurns;
  }
  return std::sqrt(squares);
}

std::vector<Curve> by_resolution() {
  std::vector<Curve> curves;
  const std::array<const char*, 3> colours{"#1b6", "#26c", "#c33"};
  for (const PixelBody body : {PixelBody::hemicube, PixelBody::cubic_tetrahedron}) {
    const bool cube = body == PixelBody::hemicube;
    std::size_t colour = 0;
    for (const double d : {0.5, 2.0, 8.0}) {
      char name[48];
      std::snprintf(name, sizeof name, "%s d/s %g", cube ? "hemicube" : "tetrahedron", d);
      Curve curve{"resolution", name, colours[colour++], cube ? "" : "5 4", {}};
      const ElementMesh mesh = opposed(d);
      for (const int n : {50, 100, 200, 400, 800}) {
        curve.points.push_back({static_cast<double>(n), pixel_error(mesh, {body, n}, from_points(mesh, 1))});
      }
      curves.push_back(curve);
    }
  }
  return curves;
}

std::vector<Curve> by_distance() {
  std::vector<Curve> curves{{"distance", "centre, no pixels", "#000", "", {}},
                            {"distance", "4 x 4 points, no pixels", "#888", "", {}},
                            {"distance", "hemicube 100", "#c33", "", {}},
                            {"distance", "hemicube 800", "#26c", "", {}}};
  const PixelProjection coarse(PixelBody::hemicube, 100), fine(PixelBody::hemicube, 800);
  for (const double d : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
    const ElementMesh mesh = opposed(d);
    const double exact = parallel_rectangles(1, 1, d).value;
    curves[0].points.push_back({d, std::abs(from_points(mesh, 1) / exact - 1)});
    curves[1].points.push_back({d, std::abs(from_points(mesh, 4) / exact - 1)});
    curves[2].points.push_back({d, pixel_error(mesh, coarse, exact)});
    curves[3].points.push_back({d, pixel_error(mesh, fine, exact)});
  }
  return curves;
}

/// A panel with logarithmic axes: x from `low` to `high`, errors from 1e-5 to 1.
struct Panel {
  double left, low, high;
  const char* title;
  std::vector<double> ticks;

  static constexpr double kWidth = 330, kHeight = 300, kTop = 40, kDecades = 5;
  double x(double value) const { return left + kWidth * std::log(value / low) / std::log(high / low); }
  static double y(double error) { return kTop + kHeight * -std::log10(error) / kDecades; }

  void draw(std::ostream& out, const std::vector<Curve>& curves) const {
    out << "<rect x='" << left << "' y='" << kTop << "' width='" << kWidth << "' height='" << kHeight
        << "' fill='none' stroke='#555'/>\n<text x='" << left + kWidth / 2 << "' y='" << kTop + kHeight + 38
        << "' text-anchor='middle'>" << title << "</text>\n";
    for (int k = 0; k <= 5; ++k) {
      const double at = y(std::pow(10.0, -k));
      out << "<path d='M" << left << ' ' << at << "h" << kWidth << "' stroke='#ddd'/><text x='" << left - 6 << "' y='"
          << at + 4 << "' text-anchor='end'>1e-" << k << "</text>\n";
    }
    for (const double tick : ticks) {
      out << "<path d='M" << x(tick) << ' ' << kTop + kHeight << "v-5' stroke='#555'/><text x='" << x(tick) << "' y='"
          << kTop + kHeight + 18 << "' text-anchor='middle'>" << tick << "</text>\n";
    }
    double row = kTop + kHeight + 62;
    for (const Curve& curve : curves) {
      out << "<polyline fill='none' stroke-width='2' stroke='" << curve.colour << "' stroke-dasharray='" << curve.dashes
          << "' points='";
      for (const auto& [at, error] : curve.points) out << x(at) << ',' << y(error) << ' ';
      out << "'/>\n<path d='M" << left << ' ' << row - 4 << "h30' stroke-width='2' stroke='" << curve.colour
          << "' stroke-dasharray='" << curve.dashes << "'/><text x='" << left + 38 << "' y='" << row << "'>"
          << curve.name << "</text>\n";
      row += 17;
    }
  }
};

int write(const std::string& folder) {
  const std::vector<Curve> resolution = by_resolution(), distance = by_distance();
  std::ofstream table(folder + "/hemicube-error.csv"), picture(folder + "/hemicube-error.svg");
  table << "panel,curve,x,relative_error\n" << std::setprecision(4);
  for (const auto* curves : {&resolution, &distance}) {
    for (const Curve& curve : *curves) {
      for (const auto& [x, error] : curve.points) {
        table << curve.panel << ',' << curve.name << ',' << x << ',' << error << '\n';
      }
    }
  }
  picture << std::setprecision(5)
          << "<!-- SPDX-License-Identifier: Apache-2.0; made by validation/reference/hemicube_error.cpp -->\n"
             "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 840 510' font-family='sans-serif' font-size='12'>\n"
             "<rect width='840' height='510' fill='#fff'/>\n<text x='420' y='22' text-anchor='middle' "
             "font-size='14'>Relative error of the form factor between opposed squares of side s</text>\n";
  Panel{60, 40, 1000, "pixels along an edge (against the centre's exact factor)", {50, 100, 200, 400, 800}}.draw(
      picture, resolution);
  Panel{480, 0.2, 40, "distance / size (against the exact factor)", {0.25, 0.5, 1, 2, 4, 8, 16, 32}}.draw(picture,
                                                                                                          distance);
  picture << "</svg>\n";
  return table.flush() && picture.flush() ? 0 : 1;
}

}  // namespace
}  // namespace etendue::validation

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: hemicube-error FOLDER\n", stderr);
    return 2;
  }
  return etendue::validation::write(arguments[1]);
}
