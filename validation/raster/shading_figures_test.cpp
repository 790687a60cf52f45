// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "etendue/geometry/vertex_normals.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/raster/gouraud.hpp"
#include "etendue/view/shaded_view.hpp"
#include "support/evidence.hpp"
#include "support/figure_drawing.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

// Figures 17 and 18, drawn from what the library computes, and the picture of a crease.
namespace etendue::validation {
namespace {

Vec3 across(const Vec3& from, const Vec3& to) {
  const Vec3 way = (to - from).normalized();
  return {-way.z(), 0, way.x()};
}

// CLAIM      Figure 17: the normal at a vertex is the average of those of the polygons there; at a crease there are two, each of its own side.
// ORACLE     closed form: the sum of the two unit normals of a profile, made a unit vector.
// TOLERANCE  16 roundings of unit vectors and their sum, whose length is above 1; the drawing is the one that is shipped.
TEST(Figures, DrawVertexNormals) {
  proves({"IU.3.2a", "IU.3.2.1a"}, Oracle::closed_form, "averages over two polygons of a profile");
  const std::vector<Vec3> profile{{0.6, 0, 0.6}, {1.8, 0, 1.7}, {3.4, 0, 2.2}, {5.0, 0, 1.9},
                                  {6.1, 0, 1.0}, {7.1, 0, 2.5}, {8.5, 0, 3.0}};
  constexpr std::size_t kCrease = 4;
  Mesh mesh;
  for (const Vec3& p : profile) mesh.vertices.insert(mesh.vertices.end(), {p, Vec3(p + Vec3::UnitY())});
  for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  const auto normals = corner_normals(mesh, NormalWeight::angle, std::numbers::pi / 3);
  FigureDrawing drawing(9.2, 4.4, 90);
  drawing.line(profile, kBlack);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec3 own = across(profile[i], profile[i + 1]), middle = 0.5 * (profile[i] + profile[i + 1]);
    drawing.arrow(middle, middle + 0.7 * own, kGrey);
    for (const std::size_t end : {i, i + 1}) {
      Vec3 right = own;
      if (end != kCrease && end > 0 && end + 1 < profile.size()) {
        right = (across(profile[end - 1], profile[end]) + across(profile[end], profile[end + 1])).normalized();
      }
      const Vec3& shown = normals[2 * i][end == i ? 0 : 1];
      EXPECT_TRUE(within((shown - right).norm(), 16 * 0x1p-53)) << i << ' ' << end;
      if ((end == i && end > 0) || end == kCrease) drawing.arrow(profile[end], profile[end] + shown, kRed);
    }
  }
  drawing.text({0.1, 0, 4.1}, "grey: normals of the polygons; red: their average at each vertex");
  drawing.text({5.0, 0, 0.6}, "a crease has two");
  const std::string svg = drawing.done();
  EXPECT_TRUE(holds(read_text(source_root() / "docs/figure-17.svg") == svg)) << svg;
}

/// "fill:#rrggbb" of a grey.
std::string grey(double value) {
  char text[48];
  const int level = static_cast<int>(std::lround(255 * value));
  std::snprintf(text, sizeof text, "style=\"fill:#%02x%02x%02x\"", level, level, level);
  return text;
}

// CLAIM      Figure 18: I_Q between A and B, I_R between C and B, I_P between Q and R: those of the rasteriser's pixels, directly and by additions.
// ORACLE     closed form: the text's three lines, with u = AQ/AB, w = CR/CB, v = QP/QR as lengths.
// TOLERANCE  stepping_error() of the largest intensity, and 16 roundings of the formulas; the drawing is the one that is shipped.
TEST(Figures, DrawInterpolatedIntensities) {
  proves({"IU.3.2b", "IU.3.2c"}, Oracle::closed_form, "the text's formulas along the scan line of the figure");
  constexpr int kColumns = 18, kRows = 11, kRow = 6;
  const Vec2 a(1.5, 10.25), b(8, 0.75), c(17.25, 8.5);
  constexpr double i_a = 0.9, i_b = 0.3, i_c = 0.65;
  const auto vertex = [](const Vec2& at, double value) {
    return GouraudVertex{at, 1, Eigen::Array3d::Constant(value)};
  };
  DepthRaster direct(kColumns, kRows, Eigen::Array3d::Constant(-1));
  DepthRaster added(kColumns, kRows, Eigen::Array3d::Constant(-1), Stepping::incremental);
  for (DepthRaster* raster : {&direct, &added}) raster->draw({vertex(a, i_a), vertex(b, i_b), vertex(c, i_c)});

  FigureDrawing drawing(kColumns, kRows + 1, 40);
  const auto place = [](const Vec2& at) { return Vec3(at.x(), 0, kRows - at.y()); };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double value = direct.picture().at(column, row)[0];
      if (value < 0) continue;
      const Vec2 corner(column, row);
      drawing.line({place(corner), place(corner + Vec2(1, 0)), place(corner + Vec2(1, 1)), place(corner + Vec2(0, 1))},
                   grey(value));
    }
  }
  const double y = kRow + 0.5, u = (a.y() - y) / (a.y() - b.y()), w = (c.y() - y) / (c.y() - b.y());
  const Vec2 q = a + u * (b - a), r = c + w * (b - c);
  const double i_q = u * i_b + (1 - u) * i_a, i_r = w * i_b + (1 - w) * i_c;
  int pixels = 0;
  for (int column = 0; column < kColumns; ++column) {
    const double shown = direct.picture().at(column, kRow)[0];
    EXPECT_TRUE(holds((shown >= 0) == (column + 0.5 >= q.x() && column + 0.5 < r.x()))) << column;
    if (shown < 0) continue;
    const double v = (column + 0.5 - q.x()) / (r.x() - q.x()), i_p = v * i_r + (1 - v) * i_q;
    EXPECT_TRUE(near(shown, i_p, stepping_error(kColumns) + 16 * 0x1p-53));
    EXPECT_TRUE(near(added.picture().at(column, kRow)[0], i_p, stepping_error(kColumns) + 16 * 0x1p-53));
    ++pixels;
  }
  EXPECT_GE(pixels, 9);
  drawing.line({place(a), place(b), place(c), place(a)}, kBlack);
  drawing.line({place({0.2, y}), place({kColumns - 0.2, y})}, kDotted);
  drawing.line({place(q), place(r)}, kRed);
  drawing.text(place({0.9, 10.1}), "A");
  drawing.text(place({7.6, 0.5}), "B");
  drawing.text(place({17.4, 8.4}), "C");
  drawing.text(place(q + Vec2(-0.5, -0.15)), "Q");
  drawing.text(place(r + Vec2(0.15, -0.15)), "R");
  drawing.line({place({9.38, y}), place({9.5, y - 0.12}), place({9.62, y}), place({9.5, y + 0.12}), place({9.38, y})},
               kRed);
  drawing.text(place({9.4, y - 0.25}), "P");
  drawing.text({0.2, 0, kRows + 0.5}, "the scan line meets AB in Q and CB in R; P, a pixel's centre, lies between");
  const std::string svg = drawing.done();
  EXPECT_TRUE(holds(read_text(source_root() / "docs/figure-18.svg") == svg)) << svg;
}

/// Of the picture of scenes/facets/crease.json, along row 80: the largest change from a pixel to the next between the vault's edges.
double jump_at_ridge(double crease_degrees) {
  const auto file = read_scene(source_root() / "scenes/facets/crease.json");
  EXPECT_TRUE(file.ok());
  ShadingOptions options;
  options.shading = Shading::gouraud;
  options.samples = 1;
  options.net.crease_angle = crease_degrees * std::numbers::pi / 180;
  const Image image = view_shaded(file->scene, options).value().image;
  constexpr int kRow = 80;
  const auto inside = [&](int column) {
    return (image.at(column, kRow) != file->scene.background).all() &&
           (image.at(column + 1, kRow) != file->scene.background).all();
  };
  double most = 0;
  for (int column = 0; column + 1 < image.columns; ++column) {
    if (inside(column)) most = std::max(most, std::abs(image.at(column + 1, kRow)[0] - image.at(column, kRow)[0]));
  }
  return most;
}

// CLAIM      IU.3.2.1a: with two normals at the vertices of its ridge the vault has a visible edge, without them none, though its arcs are smooth
//            in both; the jump is that of Lambert's law between the two sides' normals.
// ORACLE     closed form: k_d I_p times the difference of N·L for the normals of the two plates at the ridge, which a crease gives its vertices: the
//            chords' normals, 56.25° above the horizontal, on either side.
// TOLERANCE  the two centres lie a pixel apart, at most 1/6 of a plate's width here; from the ridge to a plate's other side, where the normal
//            leans 3.75° more, the intensity changes by k_d I_p 2 sin(3.75°/2) at most: 1/6 of that on either side, if it were all on one: 0.0074 · 2.
TEST(Figures, ShowCreasesByTwoNormals) {
  proves({"IU.3.2.1a"}, Oracle::closed_form, "Lambert's law on both sides of a ridge");
  const Vec3 light = Vec3(1, -0.6, 0.8).normalized();
  // The ridge's own normal on a side is the average over its plates there: one.
  const double angle = 56.25 * std::numbers::pi / 180;
  const Vec3 right(std::cos(angle), 0, std::sin(angle)), left(-std::cos(angle), 0, std::sin(angle));
  const double jump = 0.75 * 0.9 * (std::max(0.0, right.dot(light)) - std::max(0.0, left.dot(light)));
  EXPECT_TRUE(near(jump_at_ridge(60), jump, 0.015));
  EXPECT_TRUE(holds(jump_at_ridge(180) < 0.1 * jump));
}

}  // namespace
}  // namespace etendue::validation
