// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/bezier.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/near_line.hpp"

namespace etendue {

namespace {

/// Control points across and along the ray: x and y vanish where it hits, z is the way along it [all lengths]. In
/// DoubleDouble: near a silhouette the surface stays within ε of the ray over a way of √ε.
using Net = std::array<std::array<DoubleDouble3, 4>, 4>;
using RoundedNet = std::array<std::array<Vec3, 4>, 4>;

/// Of the net's size: what shearing and some hundred halvings round, NOTES.md §11.
constexpr double kNetError = 0x1p-93;
/// A piece this small, as a share of the surface, is a hit where it is not simple; four times larger ones are, every
/// time so many pieces have been looked at: the work is bounded, and the hit's error says what it cost.
constexpr double kSmallestPiece = 0x1p-40;
constexpr int kPatience = 4096;
/// Deviation of the derivatives from the middle one below which Newton's iteration has one limit at most.
constexpr double kSimple = 0.5;
constexpr int kNewtonSteps = 24;
/// Roundings of a point: 16 terms in the scene's coordinates, as many in those of the net; NOTES.md §11.
constexpr double kPointRounding = 64;

struct Piece {
  Net net;
  double u, v;            ///< its corner
  double u_size, v_size;  ///< its extent in the surface's parameters
};

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}
std::array<double, 4> bernstein_slope(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
}

BezierPoint at_net(const RoundedNet& net, double u, double v) {
  const auto bu = bernstein(u), bv = bernstein(v), du = bernstein_slope(u), dv = bernstein_slope(v);
  BezierPoint result{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < 4; ++i) {
    Vec3 row = Vec3::Zero(), slope = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j) {
      row += bv[j] * net[i][j];
      slope += dv[j] * net[i][j];
    }
    result.point += bu[i] * row;
    result.along_u += du[i] * row;
    result.along_v += bu[i] * slope;
  }
  return result;
}

DoubleDouble3 half_of(const DoubleDouble3& a, const DoubleDouble3& b) {
  const auto half = [](const DoubleDouble& x, const DoubleDouble& y) {
    const DoubleDouble sum = x + y;
    return DoubleDouble(0.5 * sum.high, 0.5 * sum.low);
  };
  return {half(a.x, b.x), half(a.y, b.y), half(a.z, b.z)};
}

using Cubic = std::array<DoubleDouble3, 4>;

/// The four points of the first and of the second half of a cubic.
void halve(const Cubic& p, Cubic& first, Cubic& second) {
  const auto a = half_of(p[0], p[1]), b = half_of(p[1], p[2]), c = half_of(p[2], p[3]);
  const auto d = half_of(a, b), e = half_of(b, c), f = half_of(d, e);
  first = {p[0], a, d, f};
  second = {f, e, c, p[3]};
}

Cubic column(const Net& net, std::size_t j) {
  return {net[0][j], net[1][j], net[2][j], net[3][j]};
}

/// a + t (b − a), in DoubleDouble: Casteljau's step.
DoubleDouble3 between(const DoubleDouble3& a, const DoubleDouble3& b, double t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t};
}
DoubleDouble3 on_cubic(const Cubic& p, double t) {
  const auto a = between(p[0], p[1], t), b = between(p[1], p[2], t), c = between(p[2], p[3], t);
  return between(between(a, b, t), between(b, c, t), t);
}

/// The surface's point relative to the ray, rounded at the end: its digits do not end with the net's size.
Vec3 place_at(const Net& net, double u, double v) {
  const DoubleDouble3 p =
      on_cubic({on_cubic(net[0], v), on_cubic(net[1], v), on_cubic(net[2], v), on_cubic(net[3], v)}, u);
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

RoundedNet rounded_net(const Net& net) {
  RoundedNet result;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const DoubleDouble3& p = net[i][j];
      result[i][j] = {rounded(p.x), rounded(p.y), rounded(p.z)};
    }
  }
  return result;
}

std::array<Piece, 2> halved(const Piece& piece, bool along_u) {
  std::array<Piece, 2> halves{piece, piece};
  for (std::size_t k = 0; k < 4; ++k) {
    if (!along_u) {
      halve(piece.net[k], halves[0].net[k], halves[1].net[k]);
      continue;
    }
    Cubic first, second;
    halve(column(piece.net, k), first, second);
    for (std::size_t i = 0; i < 4; ++i) {
      halves[0].net[i][k] = first[i];
      halves[1].net[i][k] = second[i];
    }
  }
  (along_u ? halves[0].u_size : halves[0].v_size) /= 2;
  (along_u ? halves[1].u_size : halves[1].v_size) /= 2;
  (along_u ? halves[1].u : halves[1].v) += along_u ? halves[0].u_size : halves[0].v_size;
  return halves;
}

struct Span {
  Vec3 low, high;
};

Span span_of(const RoundedNet& net) {
  Span span{net[0][0], net[0][0]};
  for (const auto& row : net) {
    for (const Vec3& p : row) {
      span.low = span.low.cwiseMin(p);
      span.high = span.high.cwiseMax(p);
    }
  }
  return span;
}

/// How a net lies to the line through the ray along its own longest side or diagonal, as seen along the ray.
enum class Lie {
  across,   ///< on both sides, or nearer than can be told
  aside,    ///< on one side: a thin, slanting net whose box is hit is so left out
  edge_on,  ///< on the line: the ray lies in a flat piece
};

Lie lie_of(const RoundedNet& net, double error) {
  Vec2 along = Vec2::Zero();
  for (const auto& [from, to] : std::array<std::pair<Vec3, Vec3>, 4>{
           {{net[0][0], net[3][3]}, {net[3][0], net[0][3]}, {net[0][0], net[0][3]}, {net[0][0], net[3][0]}}}) {
    const Vec2 side = (to - from).head<2>();
    if (side.squaredNorm() > along.squaredNorm()) along = side;
  }
  const double length = along.norm();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double slack = 2 * error * length;
  for (const auto& row : net) {
    for (const Vec3& p : row) {
      const double left = along.x() * p.y() - along.y() * p.x();
      low = std::min(low, left);
      high = std::max(high, left);
      slack = std::max(slack, 2 * error * length + 4 * kUnitRoundoff * length * p.head<2>().norm());
    }
  }
  if (low > slack || high < -slack) return Lie::aside;
  return low > -slack && high < slack ? Lie::edge_on : Lie::across;
}

/// The inverse of the derivative in the middle of a piece, and how far the others are from it (largest row sum).
struct Slope {
  Eigen::Matrix2d inverse;
  double deviation;
};

Slope slope_of(const Net& net, double error) {
  Slope slope{Eigen::Matrix2d::Zero(), std::numeric_limits<double>::infinity()};
  const auto step = [](const DoubleDouble3& a, const DoubleDouble3& b) {
    return Vec2(rounded(b.x - a.x), rounded(b.y - a.y));
  };
  std::array<std::array<Vec2, 4>, 3> along_u, along_v;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      along_u[i][j] = step(net[i][j], net[i + 1][j]);
      along_v[i][j] = step(net[j][i], net[j][i + 1]);
    }
  }
  Eigen::Matrix2d middle = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      middle.col(0) += along_u[i][j] / 4;
      middle.col(1) += along_v[i][j] / 4;
    }
  }
  const double determinant = middle(0, 0) * middle(1, 1) - middle(0, 1) * middle(1, 0);
  if (!(std::abs(determinant) > 0)) return slope;
  slope.inverse << middle(1, 1), -middle(0, 1), -middle(1, 0), middle(0, 0);
  slope.inverse /= determinant;
  Vec2 by_u = Vec2::Zero(), by_v = Vec2::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      by_u = by_u.cwiseMax((3 * (slope.inverse * along_u[i][j]) - Vec2(1, 0)).cwiseAbs());
      by_v = by_v.cwiseMax((3 * (slope.inverse * along_v[i][j]) - Vec2(0, 1)).cwiseAbs());
    }
  }
  const double rounding = 8 * error * slope.inverse.lpNorm<1>();
  slope.deviation = (by_u + by_v).maxCoeff() + rounding;
  return slope;
}

/// A hit in the parameters of the whole surface, t counted from the NearLine's start.
struct Found {
  double u, v, t;
  double place_error;  ///< bound on the distance along the surface from the true hit
};

class Search {
 public:
  /// `origin`: where the ray begins; hits whose error reaches it are the origin itself.
  Search(const Net& net, double net_error, double low, double high, double origin, double surface_error)
      : low_(low), high_(high), origin_(origin), surface_error_(surface_error) {
    const Span span = span_of(rounded_net(net));
    size_ = (span.high - span.low).norm();
    error_ = kNetError * span.low.cwiseAbs().cwiseMax(span.high.cwiseAbs()).maxCoeff() + net_error;
    waiting_.push_back({net, 0, 0, 1, 1});
  }

  std::optional<Found> nearest() {
    double smallest = kSmallestPiece * size_;
    for (int looked_at = 1; !waiting_.empty(); ++looked_at) {
      const Piece piece = waiting_.back();
      waiting_.pop_back();
      look_at(piece, smallest);
      if (looked_at % kPatience == 0) smallest *= 4;
    }
    return best_;
  }

 private:
  void look_at(const Piece& piece, double smallest) {
    const RoundedNet net = rounded_net(piece.net);
    const Span span = span_of(net);
    if ((span.low.head<2>().array() > error_).any() || (span.high.head<2>().array() < -error_).any()) return;
    if (span.high.z() < low_ - error_ || span.low.z() > high_ + error_) return;
    if (best_ && span.low.z() > best_->t + error_) return;
    if (lie_of(net, error_) != Lie::across) return;
    const double size = (span.high - span.low).norm();
    if (!(size > smallest)) {  // also where numbers beyond the domain have left none
      keep({piece.u + piece.u_size / 2, piece.v + piece.v_size / 2, 0.5 * (span.low.z() + span.high.z()), size});
      return;
    }
    const Slope slope = slope_of(piece.net, error_);
    if (slope.deviation <= kSimple && settled(piece, net, slope)) return;
    split(piece, net);
  }

  /// The piece has one hit at most: finds it, or makes sure that there is none. False where it lies just outside.
  bool settled(const Piece& piece, const RoundedNet& net, const Slope& slope) {
    Vec2 at(0.5, 0.5);
    Vec2 step = slope.inverse * place_at(piece.net, 0.5, 0.5).head<2>();
    // The map differs from the middle derivative by at most `deviation`: a hit inside is no farther than half a side.
    if (step.lpNorm<Eigen::Infinity>() > 0.5 * (1 + slope.deviation) * (1 + 0x1p-20)) return true;
    for (int k = 0; k < kNewtonSteps; ++k) {
      at -= step;
      if (!((at - Vec2(0.5, 0.5)).lpNorm<Eigen::Infinity>() <= 1)) return false;
      step = slope.inverse * place_at(piece.net, at.x(), at.y()).head<2>();
      if (step.lpNorm<Eigen::Infinity>() < 0x1p-50) break;
    }
    const double edge = kBezierEdge / std::min(piece.u_size, piece.v_size);
    if ((at - Vec2(0.5, 0.5)).lpNorm<Eigen::Infinity>() > 0.5 + edge) return false;
    const BezierPoint found = at_net(net, at.x(), at.y());
    // What is left of the step, and rounding of the point, divided by the least stretch of the map.
    const double left = (step.lpNorm<Eigen::Infinity>() + error_ * slope.inverse.lpNorm<1>()) / (1 - slope.deviation);
    keep({piece.u + at.x() * piece.u_size, piece.v + at.y() * piece.v_size, place_at(piece.net, at.x(), at.y()).z(),
          left * (found.along_u.norm() + found.along_v.norm()) * 2});
    return true;
  }

  void keep(const Found& found) {
    if (!(found.t > low_) || !(found.t < high_) || (best_ && !(found.t < best_->t))) return;
    if (found.t - origin_ <= found.place_error + surface_error_) return;
    best_ = found;
  }

  void split(const Piece& piece, const RoundedNet& net) {
    double along_u = 0, along_v = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        along_u += (net[i + 1][k] - net[i][k]).norm();
        along_v += (net[k][i + 1] - net[k][i]).norm();
      }
    }
    auto halves = halved(piece, along_u >= along_v);
    // The nearer half is looked at first: what lies behind its hit is left out.
    const auto nearest = [](const Piece& half) { return span_of(rounded_net(half.net)).low.z(); };
    const bool second_is_nearer = nearest(halves[1]) < nearest(halves[0]);
    waiting_.push_back(halves[second_is_nearer ? 0 : 1]);
    waiting_.push_back(halves[second_is_nearer ? 1 : 0]);
  }

  double low_, high_, origin_, surface_error_, size_ = 0, error_ = 0;
  std::vector<Piece> waiting_;
  std::optional<Found> best_;
};

/// Control points as seen along the ray, counted from the NearLine's start.
Net net_along(const Ray& ray, const NearLine& line, const Vec3& centre, const BezierSurface& surface) {
  const Vec3& d = ray.direction;
  int kz = 0;
  d.cwiseAbs().maxCoeff(&kz);
  const int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
  const DoubleDouble along_x = DoubleDouble(d[kx]) / d[kz], along_y = DoubleDouble(d[ky]) / d[kz];
  const DoubleDouble scale = DoubleDouble(d.norm()) / d[kz];
  Net net;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const DoubleDouble3 c = exact_difference(surface.control[i][j], centre);
      const std::array<DoubleDouble, 3> p{c.x - line.start.x, c.y - line.start.y, c.z - line.start.z};
      const DoubleDouble z = p[static_cast<std::size_t>(kz)];
      net[i][j] = {p[static_cast<std::size_t>(kx)] - along_x * z, p[static_cast<std::size_t>(ky)] - along_y * z,
                   scale * z};
    }
  }
  return net;
}

double largest_coordinate(const BezierSurface& surface) {
  double largest = 0;
  for (const auto& row : surface.control) {
    for (const Vec3& p : row) {
      require(p.allFinite(), "intersect: the control points are finite");
      largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
    }
  }
  return largest;
}

/// P_u × P_v; where it vanishes (an edge drawn together to a point), that of a point a little inside.
Vec3 normal_at(const BezierSurface& surface, double u, double v) {
  for (double inward = 0; inward < 1; inward = inward == 0 ? 0x1p-20 : 4 * inward) {
    const BezierPoint p = at(surface, u + inward * (0.5 - u), v + inward * (0.5 - v));
    const Vec3 normal = p.along_u.cross(p.along_v);
    if (normal.norm() > 0x1p-30 * p.along_u.norm() * p.along_v.norm()) return normal.stableNormalized();
  }
  return Vec3::UnitZ();
}

}  // namespace

BezierPoint at(const BezierSurface& surface, double u, double v) {
  return at_net(surface.control, u, v);
}

std::optional<Hit> intersect(const Ray& ray, const BezierSurface& surface) {
  require_direction(ray);
  const double largest = largest_coordinate(surface);
  const Vec3 centre =
      0.25 * (surface.control[0][0] + surface.control[0][3] + surface.control[3][0] + surface.control[3][3]);
  const NearLine line(ray, centre);
  const double speed = ray.direction.norm();
  const double origin = -line.shift * speed;
  const double low = std::max(0.0, ray.t_min) * speed + origin, high = ray.t_max * speed + origin;
  // Rounding of the point in the scene's coordinates, and of the net in which the ray sees the surface.
  const double surface_error = kPointRounding * kUnitRoundoff * (largest + line.distance);
  const auto found =
      Search(net_along(ray, line, centre, surface), 4 * line.start_error, low, high, origin, surface_error).nearest();
  if (!found) return std::nullopt;
  Hit hit;
  hit.t = line.shift + found->t / speed;
  hit.uv = Vec2(found->u, found->v).cwiseMax(0).cwiseMin(1);
  const BezierPoint there = at(surface, hit.uv.x(), hit.uv.y());
  const double moved = std::max(std::abs(hit.uv.x() - found->u), std::abs(hit.uv.y() - found->v));
  hit.point = there.point;
  hit.normal = normal_at(surface, hit.uv.x(), hit.uv.y());
  hit.surface_error = surface_error;
  // Parameters are rounded, and kept from beyond the edges.
  hit.point_error =
      surface_error + found->place_error + (moved + kUnitRoundoff) * 2 * (there.along_u.norm() + there.along_v.norm());
  return looks_at(ray, hit.t) ? std::optional(hit) : std::nullopt;
}

}  // namespace etendue
