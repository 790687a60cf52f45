// SPDX-License-Identifier: Apache-2.0
#include "etendue/gather/radiosity_field.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// Of the quadratic: u, v, u², uv, v². Of the linear function the first two.
constexpr std::size_t kQuadratic = 5, kLinear = 2;

/// A pivot below this share of its diagonal: the neighbours' centroids lie on a line, or on one conic, but for rounding.
constexpr double kLeastPivot = 0x1p-30;

using Row = std::array<double, kQuadratic>;

/// Normal equations of `terms` unknowns, factored as L D Lᵀ.
struct Normal {
  std::size_t terms;
  std::array<Row, kQuadratic> matrix{};

  void add(const Row& row, double weight) {
    for (std::size_t i = 0; i < terms; ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += weight * row[i] * row[j];
    }
  }

  [[nodiscard]] bool factor() {
    for (std::size_t k = 0; k < terms; ++k) {
      const double diagonal = matrix[k][k];
      for (std::size_t m = 0; m < k; ++m) matrix[k][k] -= matrix[k][m] * matrix[k][m] * matrix[m][m];
      if (!(matrix[k][k] > kLeastPivot * diagonal)) return false;
      for (std::size_t i = k + 1; i < terms; ++i) {
        for (std::size_t m = 0; m < k; ++m) matrix[i][k] -= matrix[i][m] * matrix[k][m] * matrix[m][m];
        matrix[i][k] /= matrix[k][k];
      }
    }
    return true;
  }

  Row solved(Row rhs) const {
    for (std::size_t i = 0; i < terms; ++i) {
      for (std::size_t m = 0; m < i; ++m) rhs[i] -= matrix[i][m] * rhs[m];
    }
    for (std::size_t i = terms; i-- > 0;) {
      rhs[i] /= matrix[i][i];
      for (std::size_t m = i + 1; m < terms; ++m) rhs[i] -= matrix[m][i] * rhs[m];
    }
    return rhs;
  }
};

/// Elements of the same face that share a corner, in ascending order, for each element.
std::vector<std::vector<std::size_t>> neighbours(const ElementMesh& mesh, std::span<const std::size_t> left_out) {
  std::vector<char> out(mesh.elements.size(), 0);
  for (const std::size_t k : left_out) out[k] = 1;
  std::map<std::tuple<std::size_t, double, double, double>, std::vector<std::size_t>> around;
  const auto corner = [](const Element& e, const Vec3& v) {
    return std::tuple(e.face, v.x() + 0, v.y() + 0, v.z() + 0);
  };
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    if (out[k] != 0) continue;
    for (const Vec3& v : mesh.elements[k].polygon.vertices()) around[corner(mesh.elements[k], v)].push_back(k);
  }
  std::vector<std::vector<std::size_t>> found(mesh.elements.size());
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    if (out[k] != 0) continue;
    for (const Vec3& v : mesh.elements[k].polygon.vertices()) {
      for (const std::size_t other : around[corner(mesh.elements[k], v)]) {
        if (other != k) found[k].push_back(other);
      }
    }
    std::sort(found[k].begin(), found[k].end());
    found[k].erase(std::unique(found[k].begin(), found[k].end()), found[k].end());
  }
  return found;
}

/// Does the way from a to b pass the segment, all in one plane? What ends on it does not.
bool passes(const Vec3& a, const Vec3& b, const Segment& segment, const Vec3& normal) {
  const auto side = [&](const Vec3& p, const Vec3& q, const Vec3& r) { return normal.dot((q - p).cross(r - p)); };
  return side(segment.from, segment.to, a) * side(segment.from, segment.to, b) < 0 &&
         side(a, b, segment.from) * side(a, b, segment.to) <= 0;
}

/// Fits the neighbours `ring` of one element.
class Fit {
 public:
  Fit(const ElementMesh& mesh, std::size_t element, const std::vector<std::size_t>& ring) : ring_(ring) {
    const Polygon& own = mesh.elements[element].polygon;
    x_ = (own.vertices()[1] - own.vertices()[0]).normalized();
    y_ = own.normal().cross(x_);
    double reach = 0;
    for (const std::size_t k : ring) {
      reach = std::max(reach, (mesh.elements[k].polygon.centroid() - own.centroid()).norm());
    }
    scale_ = reach;
    for (const std::size_t k : ring) {
      const Vec3 d = (mesh.elements[k].polygon.centroid() - own.centroid()) / reach;
      const double u = d.dot(x_), v = d.dot(y_);
      rows_.push_back({u, v, u * u, u * v, v * v});
      weights_.push_back(1 / (d.squaredNorm() * d.squaredNorm()));
    }
  }

  /// How much each neighbour's difference counts in the slope; nothing where they do not determine it.
  [[nodiscard]] std::optional<std::vector<Vec3>> shares(std::size_t terms) const {
    if (ring_.size() < terms) return std::nullopt;
    Normal normal{terms};
    for (std::size_t r = 0; r < rows_.size(); ++r) normal.add(rows_[r], weights_[r]);
    if (!normal.factor()) return std::nullopt;
    std::vector<Vec3> result;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Row rhs = rows_[r];
      for (double& value : rhs) value *= weights_[r];
      const Row solved = normal.solved(rhs);
      result.push_back((solved[0] * x_ + solved[1] * y_) / scale_);
    }
    return result;
  }

 private:
  const std::vector<std::size_t>& ring_;
  Vec3 x_, y_;
  double scale_;
  std::vector<Row> rows_;
  std::vector<double> weights_;
};

}  // namespace

Rgb RadiosityField::at(std::size_t element, const Vec3& from_centroid) const {
  Rgb result = value[element];
  for (int c = 0; c < 3; ++c) result(c) += slope[element][static_cast<std::size_t>(c)].dot(from_centroid);
  return result.max(0.0);
}

Rgb RadiosityField::bound_at(std::size_t element, const Vec3& from_centroid) const {
  const double distance = from_centroid.norm();
  // A dot product and a sum; and where the slope was summed up, of no more than a hundred neighbours' differences.
  constexpr double kRoundings = 8 * kUnitRoundoff, kSlopeRoundings = 64 * kUnitRoundoff;
  const double spread_there = spread[element] * distance;
  return bound * (1 + spread_there) + (kRoundings + kSlopeRoundings * spread_there) * largest;
}

RadiosityField constant_field(std::span<const Rgb> radiosity, const Rgb& bound) {
  RadiosityField field;
  field.value.assign(radiosity.begin(), radiosity.end());
  field.slope.assign(radiosity.size(), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  field.spread.assign(radiosity.size(), 0);
  field.bound = bound;
  for (const Rgb& one : radiosity) field.largest = field.largest.max(one);
  return field;
}

RadiosityField linear_field(const ElementMesh& mesh, std::span<const Rgb> radiosity,
                            std::span<const std::size_t> left_out, const Rgb& bound) {
  require(radiosity.size() == mesh.elements.size(), "linear_field: one radiosity an element");
  RadiosityField field = constant_field(radiosity, bound);
  const std::vector<std::vector<std::size_t>> next = neighbours(mesh, left_out);
  std::vector<std::vector<Segment>> contacts(mesh.faces.size());
  for (const Contact& contact : mesh.contacts) contacts[contact.face].push_back(contact.segment);
  for (std::size_t k = 0; k < radiosity.size(); ++k) {
    std::vector<std::size_t> ring = next[k];
    for (const std::size_t n : next[k]) ring.insert(ring.end(), next[n].begin(), next[n].end());
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    std::erase(ring, k);
    const Element& own = mesh.elements[k];
    std::erase_if(ring, [&](std::size_t other) {
      return std::any_of(contacts[own.face].begin(), contacts[own.face].end(), [&](const Segment& segment) {
        return passes(own.polygon.centroid(), mesh.elements[other].polygon.centroid(), segment, own.polygon.normal());
      });
    });
    if (ring.empty()) continue;
    const Fit fit(mesh, k, ring);
    auto shares = fit.shares(kQuadratic);
    if (!shares) shares = fit.shares(kLinear);
    if (!shares) continue;
    for (std::size_t r = 0; r < ring.size(); ++r) {
      const Rgb difference = radiosity[ring[r]] - radiosity[k];
      for (std::size_t c = 0; c < 3; ++c) field.slope[k][c] += difference(static_cast<Eigen::Index>(c)) * (*shares)[r];
      field.spread[k] += 2 * (*shares)[r].norm();
    }
  }
  return field;
}

}  // namespace etendue
