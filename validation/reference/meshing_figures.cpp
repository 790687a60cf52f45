// SPDX-License-Identifier: Apache-2.0
// Makes docs/meshing/vertices.svg, leak.svg and substructuring.svg (figures 58, 59 and 60 of the text): the program's own vertex
// radiosities on small meshes, and a patch under a lamp.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <string>

#include "etendue/view/vertex_radiosity.hpp"
#include "refinement/penumbra.hpp"

namespace etendue::validation {
namespace {

/// A drawing whose y runs upwards within a panel; lengths in pixels.
class Sheet {
 public:
  Sheet(const std::string& path, int width, int height, const std::string& title) : file_(path) {
    file_ << std::setprecision(5)
          << "<!-- SPDX-License-Identifier: Apache-2.0; made by validation/reference/meshing_figures.cpp -->\n"
             "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 "
          << width << ' ' << height << "' font-family='sans-serif' font-size='13'>\n<rect width='" << width
          << "' height='" << height << "' fill='#fff'/>\n";
    text(width / 2.0, 20, title, "middle", 15);
  }
  void text(double x, double y, const std::string& words, const char* anchor = "middle", int size = 13,
            const char* colour = "#000") {
    file_ << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "' font-size='" << size << "' fill='"
          << colour << "'>" << words << "</text>\n";
  }
  void line(double x0, double y0, double x1, double y1, const char* colour = "#333", double width = 1) {
    file_ << "<path d='M" << x0 << ' ' << y0 << 'L' << x1 << ' ' << y1 << "' stroke='" << colour << "' stroke-width='"
          << width << "'/>\n";
  }
  void dot(double x, double y, const char* colour = "#c33") {
    file_ << "<circle cx='" << x << "' cy='" << y << "' r='3' fill='" << colour << "'/>\n";
  }
  void polygon(const std::vector<std::array<double, 2>>& points, const std::string& fill, const char* stroke) {
    file_ << "<polygon points='";
    for (const auto& [x, y] : points) file_ << x << ',' << y << ' ';
    file_ << "' fill='" << fill << "' stroke='" << stroke << "' stroke-width='0.6' stroke-linejoin='round'/>\n";
  }
  bool done() {
    file_ << "</svg>\n";
    return static_cast<bool>(file_.flush());
  }

 private:
  std::ofstream file_;
};

std::string number(double value, int digits = 2) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits + 1, value);
  return text;
}

/// Where the plane z = 0 lies on a sheet.
struct Panel {
  double left, bottom, scale;
  double x(double at) const { return left + scale * at; }
  double y(double at) const { return bottom - scale * at; }
};

ElementMesh mesh_of(const std::vector<Shape>& shapes, const std::vector<std::array<int, 2>>& cells) {
  Scene scene = scene_of(shapes);
  for (std::size_t k = 0; k < cells.size(); ++k) scene.objects[k].subdivision = {{cells[k][0], cells[k][1]}, {1, 1}};
  return *mesh_elements(scene);
}

/// Elements, what each has, and what their vertices get.
void draw_values(Sheet& sheet, const Panel& at, const ElementMesh& mesh, const std::vector<double>& values,
                 bool with_vertices = true) {
  std::vector<Rgb> radiosity;
  for (const double value : values) radiosity.push_back(Rgb::Constant(value));
  const VertexRadiosities shown = vertex_radiosities(mesh, radiosity);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    std::vector<std::array<double, 2>> outline;
    for (const Vec3& v : mesh.elements[k].polygon.vertices()) outline.push_back({at.x(v.x()), at.y(v.y())});
    sheet.polygon(outline, "#f4f4f4", "#333");
  }
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const Polygon& polygon = mesh.elements[k].polygon;
    sheet.text(at.x(polygon.centroid().x()), at.y(polygon.centroid().y()) + 6, number(values[k]), "middle", 17);
    for (std::size_t c = 0; with_vertices && c < polygon.vertices().size(); ++c) {
      const Vec3& v = polygon.vertices()[c];
      sheet.dot(at.x(v.x()), at.y(v.y()));
      sheet.text(at.x(v.x()) + 6, at.y(v.y()) - 6, number(shown.corners[k][c](0)), "start", 13, "#c33");
    }
  }
}

Polygon block(double x0, double x1, double y0, double y1) {
  return quadrilateral({x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0});
}

bool write_vertices(const std::string& folder) {
  Sheet sheet(folder + "/vertices.svg", 760, 370, "Radiosities of elements (black) carried to their vertices (red)");
  const Panel grid{60, 300, 100};
  draw_values(sheet, grid, mesh_of({block(0, 2, 0, 2)}, {{{2, 2}}}), {8, 9, 10, 17});
  const auto name = [&](double x, double y, const char* letter) {
    sheet.text(grid.x(x) - 6, grid.y(y) + 16, letter, "end", 14, "#26c");
  };
  name(0, 0, "a");
  name(1, 0, "b");
  name(1, 1, "e");
  sheet.line(grid.x(1), grid.y(0), grid.x(1), grid.y(1), "#26c", 2);
  sheet.dot(grid.x(1), grid.y(0.5), "#26c");
  sheet.text(grid.x(1) + 6, grid.y(0.5) + 5, "X", "start", 14, "#26c");
  sheet.text(160, 340, "(a) inside: e = mean of 8, 9, 10, 17");
  sheet.text(160, 358, "edge: b = 8 + 9 − e; corner: a = 2 · 8 − e");
  draw_values(sheet, {310, 250, 80}, mesh_of({block(0, 3, 0, 1)}, {{{3, 1}}}), {4, 6, 14});
  draw_values(sheet, {600, 250, 60}, mesh_of({block(0, 1, 0, 1), block(1, 2, 0, 1), block(0, 1, 1, 2)}, {}),
              {6, 10, 9});
  sheet.text(510, 300, "(b) no vertex inside: the mean of the elements around the vertex,");
  sheet.text(510, 318, "carried on by the slope over those beside it;");
  sheet.text(510, 336, "across a row there is none");
  return sheet.done();
}

/// The nine elements and the foot of the surface that hides the light, in the numbers of scenes/leak.
bool write_leak(const std::string& folder) {
  Sheet sheet(folder + "/leak.svg", 880, 350, "Nine elements, and a surface whose foot their mesh does not follow");
  const ElementMesh mesh = mesh_of({block(0, 3, 0, 3)}, {{{3, 3}}});
  const std::vector<double> lit{0, 0, 0, 0, 0, 1, 0, 1, 1};
  const auto foot = [&](const Panel& at) { sheet.line(at.x(3), at.y(0.7), at.x(0.4), at.y(3), "#26c", 4); };
  const Panel numbers{30, 270, 70};
  draw_values(sheet, numbers, mesh, lit, false);
  foot(numbers);
  for (const double shift : {0.0, 0.3, 0.6}) {
    const double x = numbers.x(3.25), y = numbers.y(3.1 - shift);
    sheet.line(x, y, x - 22, y + 16, "#e90", 2);
    sheet.polygon({{x - 26, y + 19}, {x - 16, y + 18}, {x - 21, y + 10}}, "#e90", "#e90");
  }
  sheet.text(135, 305, "1: receives light, 0: does not;");
  sheet.text(135, 323, "light comes from the right, above");
  const Panel shown{330, 270, 70};
  draw_values(sheet, shown, mesh, lit);
  foot(shown);
  sheet.text(435, 305, "shown: the middle element rises from 0");
  sheet.text(435, 323, "to 3/4, although most of it is dark");
  Scene scene = scene_of({block(0, 3, 0, 3), quadrilateral({3, 0.7, 0}, {0.4, 3, 0}, {0.4, 3, 1}, {3, 0.7, 1})});
  scene.objects[0].subdivision = {{3, 3}, {1, 1}};
  scene.align_mesh = true;
  const Panel cut{640, 270, 70};
  const ElementMesh pieces = *mesh_elements(scene);
  for (const Element& element : pieces.elements) {
    if (element.face != 0) continue;
    const Vec3& c = element.polygon.centroid();
    const bool bright = (c.x() - 3) * 2.3 + (c.y() - 0.7) * 2.6 > 0;
    std::vector<std::array<double, 2>> outline;
    for (const Vec3& v : element.polygon.vertices()) outline.push_back({cut.x(v.x()), cut.y(v.y())});
    sheet.polygon(outline, bright ? "#fff" : "#777", "#333");
    sheet.text(cut.x(c.x()), cut.y(c.y()) + 5, bright ? "1" : "0", "middle", 15);
  }
  foot(cut);
  sheet.text(745, 305, "cut along the foot: all that is dark");
  sheet.text(745, 323, "is 0, all that is lit is 1");
  return sheet.done();
}

/// Heights over the unit square, drawn from the front.
struct Relief {
  double left, bottom, most;
  std::array<double, 2> at(double x, double y, double value) const {
    return {left + 120 * x + 70 * y, bottom - 55 * y - 130 * value / most};
  }
  void cell(Sheet& sheet, const std::array<std::array<double, 3>, 4>& corners) const {
    std::vector<std::array<double, 2>> outline;
    double mean = 0;
    for (const auto& [x, y, value] : corners) {
      outline.push_back(at(x, y, value));
      mean += value / 4;
    }
    const std::string grey = std::to_string(static_cast<int>(70 + 180 * std::min(mean / most, 1.0)));
    sheet.polygon(outline, "rgb(" + grey + "," + grey + "," + grey + ")", "#555");
  }
};

bool write_substructuring(const std::string& folder) {
  Penumbra lamp;  // its plate moved aside: nothing hides the lamp
  lamp.lamp_height = 0.5;
  lamp.lamp = {0.55, 0.85, 0.5, 0.8};
  lamp.plate = {5, 5.1, 5, 5.1};
  Sheet sheet(folder + "/substructuring.svg", 760, 300, "Radiosity over a patch under a lamp");
  double most = 0;
  for (int k = 0; k < 400; ++k) most = std::max(most, lamp.radiosity(0.05 * (k % 20), 0.05 * (k / 20)));
  const auto frame = [&](const Relief& relief, const std::string& words, const std::string& more) {
    sheet.polygon({relief.at(0, 0, 0), relief.at(1, 0, 0), relief.at(1, 1, 0), relief.at(0, 1, 0)}, "none", "#26c");
    sheet.text(relief.left + 95, 276, words);
    sheet.text(relief.left + 95, 294, more);
  };
  const Relief real{40, 250, most};
  for (int row = 19; row >= 0; --row) {
    for (int column = 0; column < 20; ++column) {
      const auto at = [&](int a, int b) {
        const double x = a / 20.0, y = b / 20.0;
        return std::array{x, y, lamp.radiosity(x, y)};
      };
      real.cell(sheet, {at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)});
    }
  }
  frame(real, "(a) as it is", "closed form");
  double left = 290;
  for (const int cells : {1, 4}) {
    const Scene scene = lamp.scene(cells);
    auto begun = before_adapting(scene, model_of(scene), Beginning::as_divided);
    const AdaptiveSolution solution =
        adapt_by_shooting(scene, *begun, exactly(), {1e9, 0, 100'000}, {1e-6, 100'000, ShotRule::unshot}).value();
    const auto values = radiosities(scene, solution.model, emissions_of(scene, solution.model), solution.state);
    const VertexRadiosities shown = vertex_radiosities(solution.model.elements, values);
    const Relief relief{left, 250, most};
    for (int k = cells * cells - 1; k >= 0; --k) {  // the farther rows first
      std::array<std::array<double, 3>, 4> corners;
      const auto element = static_cast<std::size_t>(k);
      for (std::size_t c = 0; c < 4; ++c) {
        const Vec3& v = solution.model.elements.elements[element].polygon.vertices()[c];
        corners[c] = {v.x(), v.y(), shown.corners[element][c](0)};
      }
      relief.cell(sheet, corners);
    }
    const std::string error = number(100 * error_on_floor(lamp, solution) / most, 1);
    frame(relief, cells == 1 ? "(b) one patch, one value" : "(c) 16 elements of the patch",
          "rms error " + error + " % of the brightest");
    left += 250;
  }
  return sheet.done();
}

}  // namespace
}  // namespace etendue::validation

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: meshing-figures FOLDER\n", stderr);
    return 2;
  }
  const std::string folder = arguments[1];
  using namespace etendue::validation;
  return write_vertices(folder) && write_leak(folder) && write_substructuring(folder) ? 0 : 1;
}
