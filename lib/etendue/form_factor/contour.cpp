// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "etendue/form_factor/edge_decay.hpp"
#include "etendue/form_factor/edge_terms.hpp"
#include "etendue/form_factor/flat_pair.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

/// Below this ellipse parameter halving the interval is cheaper than adding nodes.
constexpr double kNarrowEllipse = 1.7;
/// Pieces of one edge after which the plane case is taken with whatever its deviation costs.
constexpr int kMostPieces = 300;

template <class T>
struct Node {
  T x, weight;
};

template <class T>
Node<T> node_of(int n, std::size_t i);
template <>
Node<double> node_of(int n, std::size_t i) {
  const QuadratureNode& node = gauss_legendre(n)[i];
  return {node.x, node.weight};
}
template <>
Node<DoubleDouble> node_of(int n, std::size_t i) {
  const WideQuadratureNode& node = wide_gauss_legendre(n)[i];
  return {node.x, node.weight};
}

template <class T>
struct Sum {
  T value{};
  double truncation = 0;
  double rounding = 0;
};

/// ∬ ln r over two edges.
template <class T>
class EdgePair {
 public:
  EdgePair(const Edge<T>& outer, const Edge<T>& inner, double goal) : outer_(outer), inner_(inner), goal_(goal) {
    double reach = 0;
    for (const Triple<T>& p : {outer.start, outer.end}) {
      for (const Triple<T>& q : {inner.start, inner.end}) reach = std::max(reach, leading(norm(q - p)));
    }
    // ∫ |ln r| over a segment no longer than 2 reach, both ends within reach of p.
    largest_ = 2 * reach * (2 + std::abs(std::log(reach)));
  }

  Sum<T> integrate() {
    add(outer_, T(0), 1);
    return sum_;
  }

 private:
  /// The piece of the outer edge from the share `start` on, `width` of its length long.
  void add(const Edge<T>& piece, const T& start, double width) {
    ++pieces_;
    const double goal = goal_ * width, length = leading(piece.length);
    const Decay plain = plain_decay(piece, inner_);
    if (plain.rho >= kNarrowEllipse && add_gauss(length, start, width, plain, goal)) return;
    const FlatPair<T> flat = flat_pair(piece, inner_, largest_);
    const bool hopeless = pieces_ > kMostPieces;
    if (flat.deviation <= goal || flat.deviation <= kRounding<T> * length * largest_ ||
        (hopeless && flat.deviation < largest_ * length)) {
      add_planar(piece, flat);
      return;
    }
    if (plain.rho < kNarrowEllipse) {
      const Decay bent = bent_decay(piece, inner_);
      if (bent.rho >= kNarrowEllipse && add_gauss(length, start, width, bent, goal)) return;
    }
    if (hopeless || 2 * length * largest_ <= std::max(goal, kRounding<T> * leading(outer_.length) * largest_)) {
      sum_.truncation += 2 * length * largest_;
      const T middle = start + T(0.5 * width);
      sum_.value = sum_.value + piece.length * inner_integral(at(middle), inner_, outer_.coordinates).value;
      return;
    }
    const T middle = start + T(0.5 * width);
    const Triple<T> cut = at(middle);
    const T half = T(0.5) * piece.length;
    add({piece.start, cut, outer_.direction, half, outer_.coordinates}, start, 0.5 * width);
    add({cut, piece.end, outer_.direction, half, outer_.coordinates}, middle, 0.5 * width);
  }

  Triple<T> at(const T& share) const { return outer_.start + (share * outer_.length) * outer_.direction; }

  void add_planar(const Edge<T>& piece, const FlatPair<T>& flat) {
    const Rounded<T> pair = planar_pair(piece.length, flat.start, flat.end, outer_.coordinates + inner_.coordinates);
    sum_.value = sum_.value + pair.value + T(flat.lift);
    sum_.truncation += flat.deviation;
    sum_.rounding += kRounding<T> * pair.roundings;
  }

  bool add_gauss(double length, const T& start, double width, const Decay& decay, double goal) {
    const double half_length = 0.5 * length;
    int n = 2;
    double truncation = 0;
    for (;; ++n) {
      truncation = half_length * decay.weight * logarithmic_truncation(n, decay.rho);
      if (truncation <= goal || n == kMaxGaussNodes) break;
    }
    if (truncation > goal && truncation > kRounding<T> * length * largest_) return false;
    const T half(0.5 * width), middle = start + half;
    T value{};
    double roundings = 0;
    for (int i = 0; i < n; ++i) {
      const Node<T> node = node_of<T>(n, static_cast<std::size_t>(i));
      const Rounded<T> g = inner_integral(at(middle + half * node.x), inner_, outer_.coordinates);
      value = value + node.weight * g.value;
      roundings += leading(node.weight) * g.roundings;
    }
    const T scale = half * outer_.length;
    sum_.value = sum_.value + scale * value;
    sum_.truncation += truncation;
    sum_.rounding += half_length * kRounding<T> * (roundings + kSumRoundings * std::abs(leading(value)));
    return true;
  }

  static constexpr double kSumRoundings = kMaxGaussNodes + 4;  // of the weights, the products, the sum, the half length
  const Edge<T>& outer_;
  const Edge<T>& inner_;
  double goal_;
  double largest_ = 0;
  int pieces_ = 0;
  Sum<T> sum_;
};

template <class T>
std::vector<Edge<T>> edges_of(std::span<const Chain> chains) {
  std::vector<Edge<T>> edges;
  for (const Chain& chain : chains) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Edge<T> edge = make_edge(narrowed<T>(chain[i]), narrowed<T>(chain[(i + 1) % chain.size()]));
      if (leading(edge.length) > 0) edges.push_back(edge);
    }
  }
  return edges;
}

template <class T>
QuadratureSum contour(std::span<const Chain> first, std::span<const Chain> second, double goal) {
  const std::vector<Edge<T>> edges_1 = edges_of<T>(first), edges_2 = edges_of<T>(second);
  const double share = goal / static_cast<double>(edges_1.size() * edges_2.size());
  Sum<T> total;
  for (const Edge<T>& a : edges_1) {
    for (const Edge<T>& b : edges_2) {
      const T cosine = dot(a.direction, b.direction);
      const double weight = std::abs(leading(cosine));
      if (weight == 0) continue;
      // The integral is symmetric; the shorter edge outside keeps the ellipses wide.
      const bool swap = leading(a.length) > leading(b.length);
      const Sum<T> pair = EdgePair<T>(swap ? b : a, swap ? a : b, share / weight).integrate();
      total.value = total.value + cosine * pair.value;
      total.truncation += weight * pair.truncation;
      // The cosine errs by a few roundings of one, more where an edge is shorter than its coordinates.
      constexpr double kCosine = 8;
      const double turned = a.coordinates / leading(a.length) + b.coordinates / leading(b.length);
      total.rounding += weight * pair.rounding + kCosine * (1 + turned) * kRounding<T> * std::abs(leading(pair.value));
    }
  }
  return {leading(total.value), total.truncation, total.rounding + kUnitRoundoff * std::abs(leading(total.value))};
}

}  // namespace

QuadratureSum double_contour(std::span<const Chain> first, std::span<const Chain> second, double goal, Digits digits) {
  return digits == Digits::single ? contour<double>(first, second, goal) : contour<DoubleDouble>(first, second, goal);
}

}  // namespace etendue
