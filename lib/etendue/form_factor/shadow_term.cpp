// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/shadow_term.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Beyond zero by this share of a function's terms counts as zero: what cutting a cell along it leaves by rounding.
constexpr double kWeak = 0x1p-47;
/// A corner this near to a line, in units of the scene's size, counts as on it.
constexpr double kTouching = 0x1p-44;

bool same(const Interval3& a, const Interval3& b) {
  const auto equal = [](const Interval& p, const Interval& q) { return p.lower == q.lower && p.upper == q.upper; };
  return equal(a.x, b.x) && equal(a.y, b.y) && equal(a.z, b.z);
}

/// The value in [0, 1] of first/(first − second) for first ≥ 0 ≥ second or the other way round, whatever rounding made.
Interval share_of(const Interval& first, const Interval& second) {
  const Interval a = abs(first), b = abs(second);
  const double low = a.lower > 0 ? (Interval(a.lower) / (Interval(a.lower) + b.upper)).lower : 0;
  const double high = b.lower > 0 ? (Interval(a.upper) / (Interval(a.upper) + b.lower)).upper : 1;
  return {std::max(0.0, low), std::min(1.0, high)};
}

}  // namespace

Interval range_over(const Affine& f, const SourceCell& cell) {
  Interval range;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval value = f(cell.corners[i].x(), cell.corners[i].y());
    range = i == 0 ? value : hull(range, value);
  }
  return range;
}

Interval doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (Interval(b.x()) - a.x()) * (Interval(c.y()) - a.y()) - (Interval(b.y()) - a.y()) * (Interval(c.x()) - a.x());
}

CellSign sign_over(const Affine& f, const SourceCell& cell) {
  double surely_above = -kInfinity, surely_below = kInfinity;
  double lowest = kInfinity, highest = -kInfinity;
  for (const Vec2& corner : cell.corners) {
    const Interval value = f(corner.x(), corner.y());
    lowest = std::min(lowest, value.lower);
    highest = std::max(highest, value.upper);
    surely_above = std::max(surely_above, value.lower);
    surely_below = std::min(surely_below, value.upper);
  }
  const double noise = kWeak * (f.at.magnitude() + f.du.magnitude() + f.dv.magnitude());
  // Of a linear function's range over a triangle, the share x below zero is taken by at most 2x of the area.
  const auto wrong_share = [](double beyond, double within) {
    return beyond > 0 ? std::min(1.0, (Interval(2) * beyond / (Interval(beyond) + within)).upper) : 0.0;
  };
  if (lowest >= -noise && surely_above > noise) return {1, wrong_share(-lowest, surely_above), false};
  if (highest <= noise && surely_below < -noise) return {-1, wrong_share(highest, -surely_below), false};
  return {0, 0, surely_above > noise && surely_below < -noise};
}

namespace {

/// Without corners that are nearer to one another than kTouching, and those as near to the line of their neighbours;
/// what that moves, at most, is added to `swept`.
std::vector<Interval3> tidied(std::vector<Interval3> loop, double& swept) {
  for (bool again = true; again && loop.size() > 3;) {
    again = false;
    for (std::size_t i = 0; i < loop.size() && !again; ++i) {
      const std::size_t n = loop.size();
      const Interval3 &before = loop[(i + n - 1) % n], &here = loop[i], &after = loop[(i + 1) % n];
      const Interval3 chord = after - before, way = here - before;
      const double off =
          std::min({(norm(cross(chord, way)) / norm(chord)).upper, norm(way).upper, norm(after - here).upper});
      if (!(off <= kTouching)) continue;
      swept = above(swept + (Interval(off) * (norm(chord) + norm(way))).upper);
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      again = true;
    }
  }
  return loop;
}

}  // namespace

ShadowTerm::ShadowTerm(const SourceTriangle& source, std::vector<std::vector<Interval3>> loops) : source_(source) {
  for (std::size_t l = 0; l < loops.size(); ++l) {
    loops[l] = tidied(std::move(loops[l]), slack_);
    const std::size_t first = vertices_.size(), n = loops[l].size();
    for (std::size_t i = 0; i < n; ++i) {
      vertices_.push_back(loops[l][i]);
      loop_of_.push_back(l);
      edges_.push_back({l, first + i, first + (i + 1) % n});
    }
  }
  heights_.resize(edges_.size() * vertices_.size());
  on_line_.resize(heights_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Interval3 &c = vertices_[edges_[e].begin], &d = vertices_[edges_[e].end];
    for (std::size_t q = 0; q < vertices_.size(); ++q) {
      if (loop_of_[q] == edges_[e].loop) continue;
      const Interval3 way = vertices_[q] - c;
      const Interval3 normal = cross(d - c, way);
      Affine& h = heights_[e * vertices_.size() + q];
      h = {-dot(normal, c), dot(normal, source.along), dot(normal, source.across)};
      const double off = std::min((norm(normal) / norm(d - c)).upper, norm(way).upper);
      if (off <= kTouching) {
        on_line_[e * vertices_.size() + q] = true;
        touching_ = touching_ || off > 0;
      }
    }
  }
}

/// Where the other edge ends on this one's line the crossing is that end, from everywhere.
std::optional<Interval> ShadowTerm::fixed_crossing(std::size_t edge, std::size_t other) const {
  const Interval3& start = vertices_[edges_[edge].begin];
  const Interval3 way = vertices_[edges_[edge].end] - start;
  for (const std::size_t q : {edges_[other].begin, edges_[other].end}) {
    if (on_line(edge, q)) return dot(vertices_[q] - start, way) / square(way);
  }
  return std::nullopt;
}

int ShadowTerm::shared_vertex(int first, int second) const {
  if (first < 0 || second < 0) return -1;
  const Edge &a = edges_[static_cast<std::size_t>(first)], &b = edges_[static_cast<std::size_t>(second)];
  for (const std::size_t p : {a.begin, a.end}) {
    for (const std::size_t q : {b.begin, b.end}) {
      if (p == q || same(vertices_[p], vertices_[q])) return static_cast<int>(p);
    }
  }
  return -1;
}

Interval ShadowTerm::crossing(std::size_t edge, int other, const Interval& u, const Interval& v) const {
  const auto o = static_cast<std::size_t>(other);
  if (const auto fixed = fixed_crossing(edge, o)) return *fixed;
  const Interval first = height(o, edges_[edge].begin)(u, v), second = height(o, edges_[edge].end)(u, v);
  return first / (first - second);  // also where rounding has it a little beyond the edge: the sum stays analytic
}

Interval ShadowTerm::crossing_over(std::size_t edge, int other, const SourceCell& cell) const {
  const auto o = static_cast<std::size_t>(other);
  if (const auto fixed = fixed_crossing(edge, o)) return *fixed;
  const Interval a = range_over(height(o, edges_[edge].begin), cell), b = range_over(height(o, edges_[edge].end), cell);
  // What is weakly of one sign has none of the other.
  const auto one_sided = [](const Interval& x) {
    return x.middle() >= 0 ? Interval(std::max(0.0, x.lower), x.upper) : Interval(x.lower, std::min(0.0, x.upper));
  };
  return share_of(one_sided(a), one_sided(b));
}

int ShadowTerm::order_in_middle(std::size_t edge, int first, int second, const SourceCell& cell) const {
  const Vec2 middle = (cell.corners[0] + cell.corners[1] + cell.corners[2]) / 3;
  const Interval a = crossing(edge, first, middle.x(), middle.y());
  const Interval b = crossing(edge, second, middle.x(), middle.y());
  return a.upper <= b.lower ? -1 : b.upper <= a.lower ? 1 : 0;
}

// The lines of two edges of one flat outline meet in one point for every x, perhaps at infinity: in homogeneous
// coordinates w p + k d, w. The height is linear in the point.
Affine ShadowTerm::meeting_height(std::size_t edge, const Edge& first, const Edge& second) const {
  const Interval3 &p = vertices_[first.begin], &q = vertices_[second.begin];
  const Interval3 along = vertices_[first.end] - p, other = vertices_[second.end] - q;
  const Interval3 normal = cross(along, vertices_[second.end] - p);
  const Interval w = dot(cross(along, other), normal), k = dot(cross(q - p, other), normal);
  const Interval3& c = vertices_[edges_[edge].begin];
  const Interval3 turned = cross(vertices_[edges_[edge].end] - c, along);
  const Affine& h = height(edge, first.begin);
  return {w * h.at - k * dot(turned, c), w * h.du + k * dot(turned, source_.along),
          w * h.dv + k * dot(turned, source_.across)};
}

int ShadowTerm::compare(std::size_t edge, int first, int second, const SourceCell& cell, Topology& result) const {
  if (first == second) return -1;
  const Edge &a_edge = edges_[static_cast<std::size_t>(first)], &b_edge = edges_[static_cast<std::size_t>(second)];
  const bool one_loop = a_edge.loop == b_edge.loop;
  const auto on_first = [&](std::size_t q) { return on_line(static_cast<std::size_t>(first), q); };
  if (!one_loop && on_first(b_edge.begin) && on_first(b_edge.end)) return -1;  // one line, one crossing
  const int shared = shared_vertex(first, second);
  if (shared >= 0 && loop_of_[static_cast<std::size_t>(shared)] != edges_[edge].loop) {
    const Affine& by = height(edge, static_cast<std::size_t>(shared));
    const CellSign sign = sign_over(by, cell);
    // Edges of two loops also cross as one where the source sees both in one plane.
    CellSign plane{1, 0, false};
    if (!one_loop) {
      const std::size_t away = on_first(b_edge.begin) ? b_edge.end : b_edge.begin;
      plane = sign_over(height(static_cast<std::size_t>(first), away), cell);
      if (plane.mixed) {
        result.cut = height(static_cast<std::size_t>(first), away);
        return 0;
      }
    }
    if (sign.sign != 0 && plane.sign != 0) {
      // The two crossings meet only where the edge passes the shared corner: what holds in the middle holds everywhere.
      const int order = order_in_middle(edge, first, second, cell);
      if (order != 0) {
        result.share = above(result.share + above(sign.share + plane.share));
        return order;
      }
    } else if (sign.mixed) {
      result.cut = by;
      return 0;
    }
  }
  if (one_loop && shared < 0) {
    const Affine by = meeting_height(edge, a_edge, b_edge);
    const CellSign sign = sign_over(by, cell);
    if (sign.sign != 0) {
      const int order = order_in_middle(edge, first, second, cell);
      if (order != 0) {
        result.share = above(result.share + sign.share);
        return order;
      }
    } else if (sign.mixed) {
      result.cut = by;
      return 0;
    }
  }
  const Interval a = crossing_over(edge, first, cell), b = crossing_over(edge, second, cell);
  if (a.upper <= b.lower) return -1;
  if (b.upper <= a.lower) return 1;
  return 0;
}

std::optional<ShadowTerm::Bounds> ShadowTerm::clip(std::size_t edge, const SourceCell& cell, Topology& result) const {
  Bounds bounds;
  std::optional<Affine> cut;
  bool open = false;
  double share = 0;
  const Edge& e = edges_[edge];
  for (std::size_t o = 0; o < edges_.size(); ++o) {
    if (edges_[o].loop == e.loop) continue;
    const bool begin_on = on_line(o, e.begin), end_on = on_line(o, e.end);
    if (begin_on && end_on) {
      // The same line: of two edges that run together the first loop's counts; those that run against one another leave nothing.
      if (edges_[o].loop < e.loop) bounds.empty = true;
      continue;
    }
    const CellSign begin = begin_on ? CellSign{} : sign_over(height(o, e.begin), cell);
    const CellSign end = end_on ? CellSign{} : sign_over(height(o, e.end), cell);
    const bool begin_open = begin.sign == 0 && !begin_on, end_open = end.sign == 0 && !end_on;
    if (!begin_open && !end_open && begin.sign <= 0 && end.sign <= 0) {
      result.share = above(result.share + above(begin.share + end.share));
      bounds.empty = true;
    }
    if (begin_open || end_open) {
      if (begin.mixed && !cut) cut = height(o, e.begin);
      if (end.mixed && !cut) cut = height(o, e.end);
      open = true;
      continue;
    }
    share = above(share + above(begin.share + end.share));
    if (begin.sign > 0 && end.sign < 0) bounds.upper.push_back(static_cast<int>(o));
    if (begin.sign < 0 && end.sign > 0) bounds.lower.push_back(static_cast<int>(o));
  }
  if (bounds.empty) return bounds;
  for (const int low : bounds.lower) {
    for (const int high : bounds.upper) {
      Topology trial;
      if (compare(edge, high, low, cell, trial) < 0) {
        bounds.empty = true;
        result.share = above(result.share + above(share + trial.share));
        return bounds;
      }
    }
  }
  if (open) {
    if (cut) result.cut = cut;
    return std::nullopt;
  }
  result.share = above(result.share + share);
  return bounds;
}

ShadowTerm::Topology ShadowTerm::topology(const SourceCell& cell) const {
  Topology result;
  // An edge with all of another loop on its wrong side or on it leaves nothing.
  for (std::size_t o = 0; o < edges_.size(); ++o) {
    std::vector<int> outside(loop_of_.back() + 1, 1);
    double share = 0;
    std::vector<double> shares(outside.size(), 0);
    for (std::size_t q = 0; q < vertices_.size(); ++q) {
      if (loop_of_[q] == edges_[o].loop || on_line(o, q)) continue;
      const CellSign sign = sign_over(height(o, q), cell);
      shares[loop_of_[q]] = above(shares[loop_of_[q]] + sign.share);
      if (sign.sign >= 0) outside[loop_of_[q]] = 0;
    }
    for (std::size_t l = 0; l < outside.size(); ++l) {
      if (l == edges_[o].loop || outside[l] == 0) continue;
      share = shares[l];
      result.known = true;
      result.share = share;
      return result;
    }
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto bounds = clip(e, cell, result);
    if (!bounds) {
      result.loose = false;
      return result;
    }
    if (bounds->empty) continue;
    const auto last_of = [&](const std::vector<int>& candidates, int wanted) {
      int best = candidates.front();
      for (const int candidate : candidates) {
        const int order = compare(e, candidate, best, cell, result);
        if (order == 0) return -1;
        if (order == wanted && candidate != best) best = candidate;
      }
      return best;
    };
    Arc arc{e, {}, {}};
    bool told = true;
    if (!bounds->lower.empty()) {
      const int begins = last_of(bounds->lower, 1);
      told = begins >= 0;
      arc.begins = {begins};
    }
    if (told && !bounds->upper.empty()) {
      const int ends = last_of(bounds->upper, -1);
      told = ends >= 0;
      arc.ends = {ends};
    }
    if (told && !arc.begins.empty() && !arc.ends.empty()) {
      const int order = compare(e, arc.begins.front(), arc.ends.front(), cell, result);
      told = order != 0;
      if (order > 0) continue;
    }
    if (!told) {
      result.loose = !result.cut;
      if (!result.loose) return result;
      arc = {e, bounds->lower, bounds->upper};
    }
    result.arcs.push_back(arc);
  }
  if (result.loose) return result;
  result.known = true;
  result.cut.reset();
  return result;
}

}  // namespace etendue
