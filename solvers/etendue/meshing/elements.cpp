// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/elements.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "etendue/meshing/contacts.hpp"
#include "etendue/meshing/division.hpp"
#include "etendue/meshing/grading.hpp"
#include "etendue/meshing/surface_checks.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

using Quadrilateral = std::array<Vec3, 4>;

// Collects the elements of one object; `error` is set by the first thing that cannot be done.
struct Builder {
  const Object& object;
  std::size_t index;
  ElementMesh& mesh;
  CurvedObjects curved_objects;
  std::optional<Error> error;

  void refuse(const std::string& what) {
    if (error) return;
    const std::string place = object.place.empty() ? "" : object.place + ": ";
    error = Error{ErrorCode::invalid_input, place + "object '" + printable(object.name) + "' " + what};
  }

  std::optional<Polygon> polygon(std::vector<Vec3> vertices) {
    auto made = Polygon::make(std::move(vertices));
    if (made) return std::move(made).value();
    refuse("cannot be divided: " + made.error().message);
    return std::nullopt;
  }

  void undivided(const Polygon& face) {
    mesh.faces.push_back({face, index, object.material});
    mesh.elements.push_back({face, mesh.faces.size() - 1, mesh.patches++, 0});
  }

  void divided(const Polygon& face, const Subdivision& division) {
    const auto& v = face.vertices();
    const Quadrilateral corners{v[0], v[1], v[2], v[3]};
    const auto [columns, rows] = division.elements;
    const auto [patch_columns, patch_rows] = division.patches;
    const auto at = [&](int a, int b) { return corner(corners, division, a, b); };
    std::size_t place = 0;
    for (int b = 0; b < rows; ++b) {
      for (int a = 0; a < columns; ++a) {
        const auto cell = polygon({at(a, b), at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)});
        if (!cell) return;
        const int patch = (b * patch_rows / rows) * patch_columns + a * patch_columns / columns;
        mesh.elements.push_back({*cell, mesh.faces.size(), mesh.patches + static_cast<std::size_t>(patch), place++});
      }
    }
    mesh.faces.push_back({face, index, object.material});
    mesh.patches += static_cast<std::size_t>(patch_columns) * static_cast<std::size_t>(patch_rows);
  }

  /// n² triangles; those of neighbours with the same n share their corners to the last bit.
  void triangles(const Vec3& a, const Vec3& b, const Vec3& c, int n) {
    const auto at = [&](int i, int j) -> Vec3 {
      const double x = i, y = j;
      return ((n - x - y) * a + x * b + y * c) / n;
    };
    const auto add = [&](const Vec3& x, const Vec3& y, const Vec3& z) {
      if (const auto made = polygon({x, y, z})) mesh.elements.push_back({*made, mesh.faces.size(), mesh.patches});
    };
    for (int j = 0; j < n && !error; ++j) {
      for (int i = 0; i < n - j; ++i) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j < n - 1) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }

  /// A face that is no quadrilateral, by size: one patch.
  void divided_into_triangles(const Polygon& face, int n) {
    const auto& v = face.vertices();
    if (v.size() == 3) {
      triangles(v[0], v[1], v[2], n);
    } else {
      for (std::size_t k = 0; k < v.size(); ++k) triangles(face.centroid(), v[k], v[(k + 1) % v.size()], n);
    }
    mesh.faces.push_back({face, index, object.material});
    ++mesh.patches;
  }

  /// Convex parts, as faces of their own.
  void concave(const Polygon& whole) {
    constexpr std::size_t kMostCorners = 1000;  // they are cut off one by one, in time like n³ at worst
    constexpr double kRounding = 1e-9;          // of the areas' sum: what is lost is more than digits
    const std::string corners = std::to_string(whole.vertices().size());
    const Subdivision& counts = object.subdivision;
    const bool counted = counts.elements[0] * counts.elements[1] * counts.patches[0] * counts.patches[1] != 1;
    if (counted && !(counts.element_size > 0))
      return refuse(
          "is concave: only quadrilaterals have rows and columns of elements and patches; give an "
          "\"element_size\" alone, or divide it into convex polygons");
    if (whole.vertices().size() > kMostCorners)
      return refuse("is concave and has " + corners + " corners, expected at most " + std::to_string(kMostCorners) +
                    ": divide it into convex polygons");
    const std::vector<Polygon> parts = convex_parts(whole);
    double area = 0;
    for (const Polygon& part : parts) area += part.area();
    if (!(std::abs(area - whole.area()) <= kRounding * whole.area()))
      return refuse("is concave and cannot be cut into triangles: divide it into convex polygons");
    for (const Polygon& part : parts) {
      if (!error) face(part);
    }
  }

  void face(const Polygon& polygon) {
    if (!is_convex(polygon)) return concave(polygon);
    const bool by_size = object.subdivision.element_size > 0;
    const Subdivision division = division_of(object.subdivision, polygon);
    const auto [columns, rows] = division.elements;
    const auto [patch_columns, patch_rows] = division.patches;
    const bool too_many = std::max(columns, rows) > kMostElementsAlong ||
                          count_of(division, polygon.vertices().size()) > static_cast<double>(kMostElements);
    if (by_size && too_many) {
      return refuse("would have more than " + std::to_string(kMostElements) + " elements on a face, or " +
                    std::to_string(kMostElementsAlong) + " along an edge: element_size " +
                    rounded(object.subdivision.element_size, 6) + " is too small");
    }
    const bool whole = columns == 1 && rows == 1;
    const bool one_patch = patch_columns == 1 && patch_rows == 1;
    if (polygon.vertices().size() != 4 && !(one_patch && by_size) && !whole) {
      return refuse("has " + std::to_string(polygon.vertices().size()) +
                    " corners: only quadrilaterals have rows and columns of elements and patches; give an "
                    "\"element_size\" alone, or four corners");
    }
    if (columns < 1 || rows < 1 || patch_columns < 1 || patch_rows < 1 || columns % patch_columns != 0 ||
        rows % patch_rows != 0) {
      return refuse("has " + std::to_string(columns) + " × " + std::to_string(rows) + " elements in " +
                    std::to_string(patch_columns) + " × " + std::to_string(patch_rows) +
                    " patches: patches must divide the elements");
    }
    if (whole) return undivided(polygon);
    if (polygon.vertices().size() == 4) return divided(polygon, division);
    divided_into_triangles(polygon, columns);
  }

  // A corner of the grid: the same expression for all cells that meet there, so that they share it to the last bit.
  static Vec3 corner(const Quadrilateral& v, const Subdivision& division, int a, int b) {
    const double s = division_line(a, division.elements[0], division.grading);
    const double t = division_line(b, division.elements[1], division.grading);
    return (1 - t) * ((1 - s) * v[0] + s * v[1]) + t * ((1 - s) * v[3] + s * v[2]);
  }

  void operator()(const Polygon& shape) { face(shape); }

  void operator()(const Triangle& shape) {
    if (const auto made = polygon({shape.a, shape.b, shape.c})) face(*made);
  }

  void operator()(const Mesh& shape) {
    for (std::size_t k = 0; k < shape.triangles.size() && !error; ++k) (*this)(shape.triangle(k));
  }

  void operator()(const Box& shape) {
    for (int axis = 0; axis < 3 && !error; ++axis) {
      for (const int side : {-1, 1}) {
        // u × v = side · axis: the corners run counter-clockwise as seen from outside.
        const int first = (axis + (side > 0 ? 1 : 2)) % 3;
        const int second = (axis + (side > 0 ? 2 : 1)) % 3;
        const Vec3 middle = shape.centre + side * shape.half_edges(axis) * shape.axes.col(axis);
        const Vec3 u = shape.half_edges(first) * shape.axes.col(first);
        const Vec3 v = shape.half_edges(second) * shape.axes.col(second);
        if (const auto made = polygon({middle - u - v, middle + u - v, middle + u + v, middle - u + v})) face(*made);
      }
    }
  }

  void curved(const char* kind) {
    if (curved_objects == CurvedObjects::left_out) return;
    refuse(std::string("is a ") + kind +
           ": radiosity elements are flat; approximate it by a mesh, or leave it to etendue render");
  }
  void operator()(const Sphere&) { curved("sphere"); }
  void operator()(const Cylinder&) { curved("cylinder"); }
  void operator()(const Disc&) { curved("disc"); }
  void only_traced(const char* kind) {
    refuse(std::string("is ") + kind +
           ": neither radiosity nor form factors know such surfaces; approximate it by a mesh, or leave it to etendue "
           "render");
  }
  void operator()(const Cone&) { only_traced("a cone"); }
  void operator()(const Torus&) { only_traced("a torus"); }
  void operator()(const Quadric&) { only_traced("a quadric"); }
  void operator()(const BezierSurface&) { only_traced("a bezier surface"); }
  void operator()(const PolygonWithHoles&) {
    refuse("has holes: neither radiosity nor form factors know such polygons; divide it into convex ones");
  }
  void operator()(const Plane&) { refuse("is an infinite plane: radiosity elements are bounded; use a polygon"); }
};

// One line each and their number, as the scene reader has it.
std::string listed(const std::vector<std::string>& errors) {
  std::string text;
  for (const std::string& error : errors) text += error + "\n";
  return text + counted_errors(errors.size());
}

}  // namespace

double diagonal(const ElementMesh& mesh) {
  require(!mesh.faces.empty(), "diagonal: there is a face");
  Vec3 low = mesh.faces.front().polygon.vertices().front(), high = low;
  for (const Face& face : mesh.faces) {
    for (const Vec3& vertex : face.polygon.vertices()) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
  }
  return (high - low).norm();
}

bool is_convex(const Polygon& polygon) {
  const auto& v = polygon.vertices();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3 before = (v[(i + 1) % v.size()] - v[i]).normalized();
    const Vec3 after = (v[(i + 2) % v.size()] - v[(i + 1) % v.size()]).normalized();
    if (before.cross(after).dot(polygon.normal()) < -kStraightTurn) return false;
  }
  return true;  // a simple polygon that never turns right is convex
}

Result<ElementMesh> mesh_elements(const Scene& scene, CurvedObjects curved) {
  ElementMesh mesh;
  std::vector<std::string> errors;
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    Builder builder{scene.objects[k], k, mesh, curved, std::nullopt};
    std::visit([&builder](const auto& shape) { builder(shape); }, scene.objects[k].shape);
    if (builder.error) errors.push_back(builder.error->message);
  }
  if (!errors.empty()) return Error{ErrorCode::invalid_input, listed(errors)};
  if (mesh.elements.empty() && curved == CurvedObjects::refused)
    return Error{ErrorCode::invalid_input, "the scene has no surface"};
  return scene.align_mesh ? cut_at_contacts(mesh) : mesh;
}

}  // namespace etendue
