// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/item_buffer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

constexpr double kThird = 1.0 / 3.0;

/// A front and the back of a plate without thickness lie at one depth: the back is moved away by this share.
constexpr double kBackShare = 0x1p-40;

/// The inner side of the plane through the eye and an edge: plane · (x, y, 1) + margin ≥ 0.
struct EdgePlane {
  Vec3 plane;
  double margin;
};

/// A polygon as the eye sees it: axes across, up, gaze.
struct SeenPolygon {
  std::vector<Vec3> corners;
  std::vector<EdgePlane> edges;
  Vec3 normal;
  double height = 0;  ///< of the polygon's plane over the eye, along its normal; negative where its front is seen
  double reach = 0;   ///< largest coordinate that had a part in it
};

Vec3 in_axes(const PixelView& view, const Vec3& v) {
  return {view.across.dot(v), view.up.dot(v), view.gaze.dot(v)};
}

/// Into `polygon`, whose memory is used again.
void see(SeenPolygon& polygon, const PixelView& view, std::span<const Vec3> corners, const Vec3& normal) {
  polygon.corners.clear();
  polygon.edges.clear();
  polygon.normal = in_axes(view, normal);
  polygon.reach = view.eye.cwiseAbs().maxCoeff();
  Vec3 middle = Vec3::Zero();
  for (const Vec3& corner : corners) {
    polygon.reach = std::max(polygon.reach, corner.cwiseAbs().maxCoeff());
    polygon.corners.push_back(in_axes(view, corner - view.eye));
    middle += (corner - view.eye) / static_cast<double>(corners.size());
  }
  polygon.height = normal.dot(middle);
}

void find_edges(SeenPolygon& polygon, const PixelView& view) {
  const double farthest_x = std::max(std::abs(view.left), std::abs(view.left + view.columns * view.pixel));
  const double farthest_y = std::max(std::abs(view.bottom), std::abs(view.bottom + view.rows * view.pixel));
  const double moved = kCornerRoundings * kUnitRoundoff * polygon.reach * (farthest_x + farthest_y + 1);
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Vec3& from = polygon.corners[k];
    const Vec3& to = polygon.corners[(k + 1) % polygon.corners.size()];
    const Vec3 plane = polygon.height < 0 ? to.cross(from) : from.cross(to);
    polygon.edges.push_back({plane, moved * (from.lpNorm<1>() + to.lpNorm<1>())});
  }
}

/// Do all corners lie beyond one side of the pyramid from the eye through the window?
bool beside(const SeenPolygon& polygon, const PixelView& view) {
  const double right = view.left + view.columns * view.pixel, top = view.bottom + view.rows * view.pixel;
  const double slack = 4 * kCornerRoundings * kUnitRoundoff * polygon.reach;
  std::array<bool, 5> all{true, true, true, true, true};
  for (const Vec3& c : polygon.corners) {
    all[0] = all[0] && c.x() < view.left * c.z() - slack;
    all[1] = all[1] && c.x() > right * c.z() + slack;
    all[2] = all[2] && c.y() < view.bottom * c.z() - slack;
    all[3] = all[3] && c.y() > top * c.z() + slack;
    all[4] = all[4] && c.z() <= 0;
  }
  return std::find(all.begin(), all.end(), true) != all.end();
}

/// Pixels [begin, end) whose samples may lie between two coordinates, one to spare on either side.
struct PixelRange {
  int begin, end;
};
PixelRange pixels_between(double low, double high, double origin, double pixel, int count) {
  const double most = count;
  const double begin = std::clamp(std::floor((low - origin) / pixel) - 1, 0.0, most);
  const double end = std::clamp(std::ceil((high - origin) / pixel) + 1, 0.0, most);
  return {static_cast<int>(begin), static_cast<int>(std::max(begin, end))};
}

PixelRange rows_of(const SeenPolygon& polygon, const PixelView& view) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& c : polygon.corners) {
    if (c.z() <= kEdgeOn * polygon.reach) return {0, view.rows};  // reaches to the eye's side: anywhere in the window
    low = std::min(low, c.y() / c.z());
    high = std::max(high, c.y() / c.z());
  }
  return pixels_between(low, high, view.bottom, view.pixel, view.rows);
}

/// The columns of a row that all edges allow, for samples at the height of either a pixel's centre or a half pixel's.
PixelRange columns_of(const SeenPolygon& polygon, const PixelView& view, int row) {
  const double middle = view.bottom + (row + 0.5) * view.pixel;
  double low = view.left, high = view.left + view.columns * view.pixel;
  for (const EdgePlane& edge : polygon.edges) {
    // A sample is off the middle of its row by at most half a pixel.
    const double rest = edge.plane.y() * middle + edge.plane.z() + edge.margin +
                        (view.window == ViewOutline::rectangle ? 0 : 0.5 * view.pixel * std::abs(edge.plane.y()));
    const double end = -rest / edge.plane.x();
    if (edge.plane.x() > 0) low = std::max(low, end);
    if (edge.plane.x() < 0) high = std::min(high, end);
    if (edge.plane.x() == 0 && rest < 0) return {0, 0};
  }
  return low <= high + view.pixel ? pixels_between(low, high, view.left, view.pixel, view.columns) : PixelRange{0, 0};
}

}  // namespace

bool PixelView::has(int column, int row) const {
  return column >= 0 && row >= 0 && column < columns && row < rows &&
         (window == ViewOutline::rectangle || column + row >= columns - 1);
}

Vec2 PixelView::sample(int column, int row) const {
  const double part = window == ViewOutline::upper_triangle && column + row == columns - 1 ? 2 * kThird : 0.5;
  return {left + (column + part) * pixel, bottom + (row + part) * pixel};
}

Vec3 PixelView::direction(int column, int row) const {
  const Vec2 at = sample(column, row);
  return at.x() * across + at.y() * up + gaze;
}

ItemBuffer::ItemBuffer(const PixelView& view) {
  look(view);
}

void ItemBuffer::look(const PixelView& view) {
  require(view.columns > 0 && view.rows > 0 && view.pixel > 0, "ItemBuffer: the view has pixels");
  require(view.across.cross(view.up).dot(view.gaze) > 0, "ItemBuffer: the axes are right-handed");
  view_ = view;
  const std::size_t count = static_cast<std::size_t>(view.columns) * static_cast<std::size_t>(view.rows);
  items_.assign(count, kNoItem);
  inverse_depth_.assign(count, 0.0);
}

template <class Body>
void ItemBuffer::cover(std::span<const Vec3> corners, const Vec3& normal, const Body& body) const {
  static thread_local SeenPolygon polygon;  // thousands are drawn: their memory is asked for once a thread
  see(polygon, view_, corners, normal);
  if (std::abs(polygon.height) <= kEdgeOn * polygon.reach || beside(polygon, view_)) return;
  find_edges(polygon, view_);
  const double share = polygon.height < 0 ? 1 : 1 - kBackShare;
  const Vec3 inverse = share / polygon.height * polygon.normal;  // 1/depth = inverse · (x, y, 1)
  const PixelRange rows = rows_of(polygon, view_);
  for (int row = rows.begin; row < rows.end; ++row) {
    const PixelRange columns = columns_of(polygon, view_, row);
    const auto inside = [&](const Vec2& at) {
      bool all = true;
      for (const EdgePlane& edge : polygon.edges) {
        all = all && edge.plane.x() * at.x() + edge.plane.y() * at.y() + edge.plane.z() + edge.margin >= 0;
      }
      return all;
    };
    const auto show = [&](int column, const Vec2& at) {
      const double inverse_depth = inverse.x() * at.x() + inverse.y() * at.y() + inverse.z();
      if (inverse_depth > 0) body(column, row, inverse_depth);
    };
    int begin = columns.begin, end = columns.end;
    if (view_.window == ViewOutline::rectangle) {
      // Along a row each edge's sum rises or falls, rounded or not: what is inside lies together.
      while (begin < end && !inside(view_.sample(begin, row))) ++begin;
      while (begin < end && !inside(view_.sample(end - 1, row))) --end;
      for (int column = begin; column < end; ++column) show(column, view_.sample(column, row));
      continue;
    }
    for (int column = begin; column < end; ++column) {
      if (!view_.has(column, row)) continue;
      const Vec2 at = view_.sample(column, row);
      if (inside(at)) show(column, at);
    }
  }
}

void ItemBuffer::draw(std::span<const Vec3> corners, const Vec3& normal, std::int32_t item) {
  require(item >= 0 && corners.size() >= 3, "ItemBuffer::draw: an item with three corners or more");
  cover(corners, normal, [&](int column, int row, double inverse_depth) {
    const std::size_t at = index(column, row);
    if (!(inverse_depth > inverse_depth_[at])) return;
    inverse_depth_[at] = inverse_depth;
    items_[at] = item;
  });
}

std::vector<ItemBuffer::Pixel> ItemBuffer::covered_with(std::span<const Vec3> corners, const Vec3& normal,
                                                        std::int32_t item) const {
  std::vector<Pixel> pixels;
  cover(corners, normal, [&](int column, int row, double) {
    if (items_[index(column, row)] == item) pixels.push_back({column, row});
  });
  return pixels;
}

}  // namespace etendue
