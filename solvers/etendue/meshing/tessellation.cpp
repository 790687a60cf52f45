// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/tessellation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/meshing/ears.hpp"
#include "etendue/meshing/quadric_net.hpp"
#include "etendue/reflectance/surface_parameters.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

constexpr double kSmooth = std::numbers::pi;
constexpr double kSharp = 0;

enum class Ends { open, closed };

/// A net of (columns + 1) × (rows + 1) points, the last column or row being the first again where closed. Triangles
/// with two equal corners (at poles) are left out. Parameters are shares of the columns and rows.
Tessellation net(int columns, int rows, Ends around, Ends along, const std::function<Vec3(int, int)>& point) {
  Tessellation result{{}, kSmooth};
  Mesh& mesh = result.mesh;
  const int across = around == Ends::closed ? columns : columns + 1, down = along == Ends::closed ? rows : rows + 1;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) mesh.vertices.push_back(point(i, j));
  }
  const auto index = [&](int i, int j) {
    const std::uint32_t first = static_cast<std::uint32_t>(j % down) * static_cast<std::uint32_t>(across);
    return first + static_cast<std::uint32_t>(i % across);
  };
  const auto& v = mesh.vertices;
  const auto add = [&](const std::array<std::uint32_t, 3>& corners, const std::array<Vec2, 3>& parameters) {
    const auto [a, b, c] = corners;
    if (v[a] == v[b] || v[b] == v[c] || v[c] == v[a]) return;
    mesh.triangles.push_back(corners);
    result.parameters.push_back(parameters);
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      const auto place = [&](int column, int row, bool is_pole) {
        return Vec2((is_pole ? i + 0.5 : column) / columns, static_cast<double>(row) / rows);
      };
      const bool low = v[a] == v[b], high = v[c] == v[d];
      const Vec2 at_a = place(i, j, low), at_b = place(i + 1, j, low);
      const Vec2 at_c = place(i + 1, j + 1, high), at_d = place(i, j + 1, high);
      add({a, b, c}, {at_a, at_b, at_c});
      add({a, c, d}, {at_a, at_c, at_d});
    }
  }
  return result;
}

/// Points that are one point become one vertex: a pole.
Mesh with_one_vertex_for(Mesh mesh, const Vec3& pole) {
  const auto first = std::find(mesh.vertices.begin(), mesh.vertices.end(), pole);
  const auto kept = static_cast<std::uint32_t>(first - mesh.vertices.begin());
  for (auto& triangle : mesh.triangles) {
    for (auto& corner : triangle) {
      if (mesh.vertices[corner] == pole) corner = kept;
    }
  }
  return mesh;
}

struct Circle {
  Vec3 x, y;
  int count;
  Vec3 at(int i) const {
    const double turn = 2 * std::numbers::pi * i / count;
    return std::cos(turn) * x + std::sin(turn) * y;
  }
};

Circle around(const Vec3& axis, int count) {
  const TangentFrame frame = tangent_frame(axis.normalized());
  return {frame.u, frame.v, count};
}

struct Tessellator {
  const TessellationOptions& options;
  Tessellation result{{}, kSmooth};
  std::string refused = {};

  int half() const { return std::max(2, options.facets / 2); }

  /// Parameters of the corners of all triangles, from where they are.
  void place_corners(const std::function<PatternPlace(std::size_t, const Vec3&)>& place) {
    result.parameters.assign(result.mesh.triangles.size(), {});
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const PatternPoint at = place(t, result.mesh.vertices[result.mesh.triangles[t][k]]).at;
        result.parameters[t][k] = {at.u, at.v};
      }
    }
  }

  void operator()(const Sphere& sphere) {
    const int rows = half();
    const Circle circle = around(Vec3::UnitZ(), options.facets);
    const Vec3 up = sphere.radius * Vec3::UnitZ();
    result = net(options.facets, rows, Ends::closed, Ends::open, [&](int i, int j) -> Vec3 {
      if (j == 0) return sphere.centre - up;
      if (j == rows) return sphere.centre + up;
      const double rise = std::numbers::pi * j / rows;
      return sphere.centre + std::sin(rise) * sphere.radius * circle.at(i) - std::cos(rise) * up;
    });
    result.mesh =
        with_one_vertex_for(with_one_vertex_for(std::move(result.mesh), sphere.centre - up), sphere.centre + up);
  }

  /// As many along the side as make the facets about square. The apex of a cone stays several vertices: its
  /// sides have no common normal there.
  void side(const Vec3& base, const Vec3& top, double base_radius, double top_radius) {
    const Vec3 axis = top - base;
    const Circle circle = around(axis, options.facets);
    const double width = 2 * std::numbers::pi * std::max(base_radius, top_radius) / options.facets;
    const int rows = static_cast<int>(std::clamp(std::round(axis.norm() / width), 1.0, 1.0 * options.facets));
    result = net(options.facets, rows, Ends::closed, Ends::open, [&](int i, int j) -> Vec3 {
      const double t = static_cast<double>(j) / rows;
      return base + t * axis + (base_radius + t * (top_radius - base_radius)) * circle.at(i);
    });
  }
  void operator()(const Cylinder& c) { side(c.base, c.top, c.radius, c.radius); }
  void operator()(const Cone& c) { side(c.base, c.top, c.base_radius, c.top_radius); }

  void operator()(const Torus& torus) {
    const Vec3 axis = torus.axis.normalized();
    const Circle circle = around(axis, options.facets);
    const int tube = std::max(kFewestFacets, half());
    result = net(options.facets, tube, Ends::closed, Ends::closed, [&](int i, int j) -> Vec3 {
      const double turn = 2 * std::numbers::pi * j / tube;
      return torus.centre + (torus.ring + torus.tube * std::cos(turn)) * circle.at(i) +
             torus.tube * std::sin(turn) * axis;
    });
  }

  void operator()(const Disc& disc) {
    const Circle circle = around(disc.normal, options.facets);
    result = net(options.facets, 1, Ends::closed, Ends::open,
                 [&](int i, int j) -> Vec3 { return disc.centre + (j == 1 ? 0 : disc.radius) * circle.at(i); });
    place_corners([&](std::size_t, const Vec3& corner) { return parameters_on(disc, corner); });
  }

  void operator()(const Box& box) {
    result.crease_angle = kSharp;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
      result.mesh.vertices.emplace_back(box.centre + box.axes * sign.cwiseProduct(box.half_edges));
    }
    result.mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                             {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    if (box.axes.determinant() < 0) {
      for (auto& triangle : result.mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    constexpr std::array<Eigen::Index, 3> kAcross{2, 1, 0};  // of each four triangles above
    place_corners([&](std::size_t t, const Vec3& corner) { return parameters_on(box, kAcross[t / 4], corner); });
  }

  void operator()(const Triangle& triangle) {
    result.crease_angle = kSharp;
    result.mesh = {{triangle.a, triangle.b, triangle.c}, {{0, 1, 2}}};
    result.parameters = {{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}};
  }

  void operator()(const Polygon& polygon) { flat(polygon, {}); }
  void operator()(const PolygonWithHoles& polygon) { flat(polygon.outline(), polygon.holes()); }

  void flat(const Polygon& polygon, const std::vector<std::vector<Vec3>>& holes) {
    result.crease_angle = kSharp;
    const TangentFrame frame = tangent_frame(polygon.normal());
    std::vector<Vec2> points;
    const auto chain = [&](const std::vector<Vec3>& corners) {
      std::vector<std::uint32_t> indices(corners.size());
      std::iota(indices.begin(), indices.end(), static_cast<std::uint32_t>(points.size()));
      for (const Vec3& corner : corners) {
        points.emplace_back(corner.dot(frame.u), corner.dot(frame.v));
        result.mesh.vertices.push_back(corner);
      }
      return indices;
    };
    const auto outline = chain(polygon.vertices());
    std::vector<std::vector<std::uint32_t>> cut;
    for (const auto& hole : holes) cut.push_back(chain(hole));
    result.mesh.triangles = ears(points, outline, std::move(cut));
    place_corners([&](std::size_t, const Vec3& corner) { return parameters_on(polygon, corner); });
  }

  void operator()(const Mesh& mesh) {
    result = {mesh, options.crease_angle};
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto& at = mesh.texture;
      result.parameters.push_back(at.empty() ? std::array<Vec2, 3>{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}
                                             : std::array<Vec2, 3>{at[a], at[b], at[c]});
    }
  }

  void operator()(const BezierSurface& surface) {
    const int n = half();
    result = net(n, n, Ends::open, Ends::open, [&](int i, int j) -> Vec3 {
      return at(surface, static_cast<double>(i) / n, static_cast<double>(j) / n).point;
    });
  }

  void operator()(const Plane&) { refused = "is an infinite plane"; }

  void operator()(const Quadric& quadric) {
    constexpr int kMostCells = 64;  // along an edge of the box: their number is the third power
    result.mesh = quadric_net(quadric, std::min(half(), kMostCells));
    place_corners([&](std::size_t, const Vec3& corner) { return parameters_on(quadric.box, 2, corner); });
  }
};

}  // namespace

Tessellation plane_before(const Plane& plane, const Vec3& eye) {
  constexpr double kReach = 0x1p20;
  Tessellation result{{}, kSharp};
  const double height = plane.normal.dot(eye - plane.point);
  if (height == 0) return result;
  const TangentFrame frame = tangent_frame(plane.normal);
  const Vec3 foot = eye - height * plane.normal;
  const double reach = kReach * std::abs(height);
  for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    result.mesh.vertices.emplace_back(foot + reach * (u * frame.u + v * frame.v));
  result.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const auto& triangle : result.mesh.triangles) {
    auto& parameters = result.parameters.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = result.mesh.vertices[triangle[k]] - plane.point;
      parameters[k] = {x.dot(frame.u), x.dot(frame.v)};
    }
  }
  return result;
}

Result<Tessellation> tessellated(const Object& object, const TessellationOptions& options) {
  require(options.facets >= kFewestFacets && options.facets <= kMostFacets, "tessellated: a number of facets in range");
  Tessellator tessellator{options};
  std::visit(tessellator, object.shape);
  if (!tessellator.refused.empty()) {
    return Error{ErrorCode::invalid_input, (object.place.empty() ? "" : object.place + ": ") + "object '" +
                                               printable(object.name) + "' " + tessellator.refused +
                                               ", which has no triangles to be drawn with: use --method raytrace"};
  }
  return std::move(tessellator.result);
}

}  // namespace etendue
