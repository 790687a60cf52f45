// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/texture.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// The texels that one of `count` equal parts covers of `from`, and how much of each.
struct Cover {
  int first, last;  // last one included
  double of_first, of_last;
};
Cover cover(int part, int count, int from) {
  const double width = static_cast<double>(from) / count;
  const double begin = part * width, end = part + 1 == count ? from : (part + 1) * width;
  const int first = static_cast<int>(begin), last = std::min(from - 1, static_cast<int>(std::ceil(end)) - 1);
  if (first == last) return {first, last, 1, 0};
  return {first, last, first + 1 - begin, end - last};
}

/// Of what a row or a column holds, over a part of it.
template <class Texel>
Eigen::Array3d mean_over(const Cover& part, const Texel& at) {
  Eigen::Array3d sum = part.of_first * at(part.first);
  double width = part.of_first;
  for (int i = part.first + 1; i < part.last; ++i) {
    sum += at(i);
    width += 1;
  }
  if (part.last > part.first) {
    sum += part.of_last * at(part.last);
    width += part.of_last;
  }
  return sum / width;
}

/// u within the image, in [0, 1].
double wrapped(double u, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(u, 0.0, 1.0);
  if (wrap == Wrap::repeat) return u - std::floor(u);
  const double twice = u - 2 * std::floor(u / 2);
  return twice > 1 ? 2 - twice : twice;
}

/// Two texels and how much of the second.
struct Pair {
  int a, b;
  double share;
};
Pair neighbours(double u, int count, Wrap wrap) {
  const double place = wrapped(u, wrap) * count - 0.5;  // from the first texel's centre
  const double low = std::floor(place);
  const int a = static_cast<int>(low), b = a + 1;
  const auto index = [&](int i) {
    if (wrap == Wrap::repeat) return i < 0 ? i + count : i >= count ? i - count : i;
    return std::clamp(i, 0, count - 1);  // a mirrored image has the edge's texels beside themselves
  };
  return {index(a), index(b), place - low};
}

Eigen::Array3d between_levels(const TexturePyramid& image, const PatternPoint& at, double level, const Wraps& wraps) {
  const int last = image.levels() - 1;
  if (!(level < last)) return image.mean();
  const int below = static_cast<int>(level);
  const double share = level - below;
  const Eigen::Array3d fine = image.between_texels(below, at, wraps);
  if (share == 0) return fine;
  return (1 - share) * fine + share * image.between_texels(below + 1, at, wraps);
}

/// Lengths of the axes of the ellipse p cos s + q sin s, and a vector along the longer one.
struct Axes {
  double longer, shorter;
  Vec2 along;
};
Axes axes_of(const Vec2& p, const Vec2& q) {
  // Eigenvalues of p pᵀ + q qᵀ are their squares; of its eigenvector the form that does not cancel.
  const double xx = p.x() * p.x() + q.x() * q.x(), yy = p.y() * p.y() + q.y() * q.y();
  const double xy = p.x() * p.y() + q.x() * q.y();
  const double mean = (xx + yy) / 2, spread = std::hypot((xx - yy) / 2, xy);
  const Vec2 along = xx >= yy ? Vec2(mean + spread - yy, xy) : Vec2(xy, mean + spread - xx);
  const double least = mean - spread;
  return {std::sqrt(mean + spread), std::sqrt(least < 0 ? 0 : least), along};
}

/// No longer than the image along either direction.
Vec2 limited(const Vec2& edge) {
  return edge / std::max(1.0, edge.lpNorm<Eigen::Infinity>());
}

}  // namespace

TexturePyramid::TexturePyramid(int columns, int rows, std::vector<Eigen::Array3d> texels) {
  require(columns >= 1 && rows >= 1, "TexturePyramid: at least one texel");
  require(texels.size() == static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
          "TexturePyramid: columns times rows texels");
  levels_.push_back({columns, rows, std::move(texels)});
  while (levels_.back().columns > 1 || levels_.back().rows > 1) levels_.push_back(halved(levels_.back()));
}

TexturePyramid::Level TexturePyramid::halved(const Level& level) {
  const auto at = [](int row, int columns, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  };
  const int columns = std::max(1, level.columns / 2), rows = std::max(1, level.rows / 2);
  std::vector<Eigen::Array3d> narrow(at(level.rows, columns, 0));
  for (int column = 0; column < columns; ++column) {
    const Cover part = cover(column, columns, level.columns);
    for (int row = 0; row < level.rows; ++row) {
      narrow[at(row, columns, column)] =
          mean_over(part, [&](int i) -> const Eigen::Array3d& { return level.texels[at(row, level.columns, i)]; });
    }
  }
  Level half{columns, rows, std::vector<Eigen::Array3d>(at(rows, columns, 0))};
  for (int row = 0; row < rows; ++row) {
    const Cover part = cover(row, rows, level.rows);
    for (int column = 0; column < columns; ++column) {
      half.texels[at(row, columns, column)] =
          mean_over(part, [&](int i) -> const Eigen::Array3d& { return narrow[at(i, columns, column)]; });
    }
  }
  return half;
}

const Eigen::Array3d& TexturePyramid::texel(int level, int column, int row) const {
  const Level& of = levels_[static_cast<std::size_t>(level)];
  return of
      .texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(of.columns) + static_cast<std::size_t>(column)];
}

Eigen::Array3d TexturePyramid::between_texels(int level, const PatternPoint& at, const Wraps& wraps) const {
  const Pair x = neighbours(at.u, columns(level), wraps.u), y = neighbours(at.v, rows(level), wraps.v);
  const int last = rows(level) - 1;  // rows are counted from the top
  const Eigen::Array3d low = (1 - x.share) * texel(level, x.a, last - y.a) + x.share * texel(level, x.b, last - y.a);
  const Eigen::Array3d high = (1 - x.share) * texel(level, x.a, last - y.b) + x.share * texel(level, x.b, last - y.b);
  return (1 - y.share) * low + y.share * high;
}

Eigen::Array3d filtered(const TexturePyramid& image, const PatternPoint& at, const PatternFootprint& footprint,
                        const Wraps& wraps) {
  require(std::isfinite(at.u) && std::isfinite(at.v), "filtered: the place is finite");
  // What is no number is as large as the image, too.
  if (!(axes_of(footprint.first, footprint.second).shorter < 1)) return image.mean();
  const Vec2 size(image.columns(), image.rows());
  const Vec2 p = limited(footprint.first).cwiseProduct(size), q = limited(footprint.second).cwiseProduct(size);
  const auto [longer, shorter, along] = axes_of(p, q);
  const double width = std::max({shorter, longer / kMostProbes, 1.0});
  const int probes = std::clamp(static_cast<int>(std::ceil(longer / width)), 1, kMostProbes);
  const double level = std::log2(width);
  if (probes == 1) return between_levels(image, at, level, wraps);
  const Vec2 axis = (longer / along.norm() * along).cwiseQuotient(size);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int k = 0; k < probes; ++k) {
    const double off = (k + 0.5) / probes - 0.5;
    sum += between_levels(image, {at.u + off * axis.x(), at.v + off * axis.y()}, level, wraps);
  }
  return sum / probes;
}

}  // namespace etendue
