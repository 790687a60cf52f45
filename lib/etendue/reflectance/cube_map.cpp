// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/cube_map.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// The pixel whose square on the cube a direction goes through.
const Eigen::Array3d& pixel_at(const CubeImages& images, const Vec3& direction) {
  const CubePoint place = cube_mapping(direction);
  const auto index = [&](double share) {
    return std::clamp(static_cast<int>(share * images.size), 0, images.size - 1);
  };
  const int column = index(place.at.u), row = images.size - 1 - index(place.at.v);
  const auto at =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(images.size) + static_cast<std::size_t>(column);
  return images.pixels[static_cast<std::size_t>(place.face)][at];
}

/// The colour at the corner of three faces, whose gazes are a, b and c: the mean of the pixels there, whose directions have the
/// corner's as their mean.
Eigen::Array3d corner(const CubeImages& images, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double in = 1 - 1.0 / images.size;
  return (pixel_at(images, a + in * (b + c)) + pixel_at(images, b + in * (a + c)) +
          pixel_at(images, c + in * (a + b))) /
         3;
}

/// Colours along the edge of the faces that look at a and b, in places of the pixels along e, and before and behind them at the corners.
///
/// The pixels a + (1 − h) b + z e and b + (1 − h) a + z e, h = 1/size, are as far from the middle: their mean points to the place
/// z / (1 − h/2) on the edge. What is wanted at z is linear between such places.
std::vector<Eigen::Array3d> along_edge(const CubeImages& images, const Vec3& a, const Vec3& b, const Vec3& e) {
  const int n = images.size;
  const double h = 1.0 / n;
  std::vector<double> places{-1};
  std::vector<Eigen::Array3d> means{corner(images, a, b, -e)};
  const auto centre = [&](int j) { return (2 * j + 1) * h - 1; };
  for (int j = 0; j < n; ++j) {
    const Vec3 along = centre(j) * e;
    places.push_back(centre(j) / (1 - h / 2));
    means.push_back((pixel_at(images, a + (1 - h) * b + along) + pixel_at(images, b + (1 - h) * a + along)) / 2);
  }
  places.push_back(1);
  means.push_back(corner(images, a, b, e));
  std::vector<Eigen::Array3d> wanted{means.front()};
  std::size_t next = 1;
  for (int j = 0; j < n; ++j) {
    while (places[next] < centre(j)) ++next;
    const double share = (centre(j) - places[next - 1]) / (places[next] - places[next - 1]);
    wanted.push_back((1 - share) * means[next - 1] + share * means[next]);
  }
  wanted.push_back(means.back());
  return wanted;
}

/// Between which two knots a place lies: at 0, (i + ½)/size and 1.
struct Cell {
  int first;
  double share;

  Cell(double at, int size) {
    const double place = at * size - 0.5;
    first = std::clamp(static_cast<int>(std::floor(place)) + 1, 0, size);
    const double begin = first == 0 ? -0.5 : first - 1, end = first == size ? size - 0.5 : first;
    share = std::clamp((place - begin) / (end - begin), 0.0, 1.0);  // absorbs the rounding of the place
  }
};

}  // namespace

Eigen::Array3d& CubeMap::knot(std::size_t face, int column, int row) {
  const auto side = static_cast<std::size_t>(size_) + 2;
  return faces_[face].knots[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
}

const Eigen::Array3d& CubeMap::knot(std::size_t face, int column, int row) const {
  return const_cast<CubeMap*>(this)->knot(face, column, row);
}

CubeMap::CubeMap(const CubeImages& images) : size_(images.size) {
  require(size_ >= 1, "CubeMap: the images have a pixel");
  const auto side = static_cast<std::size_t>(size_);
  for (const auto& pixels : images.pixels) {
    require(pixels.size() == side * side, "CubeMap: six square images of one size");
    require(std::all_of(pixels.begin(), pixels.end(), [](const Eigen::Array3d& p) { return p.isFinite().all(); }),
            "CubeMap: the colours are finite");
  }
  for (std::size_t f = 0; f < 6; ++f) {
    faces_[f].knots.resize((side + 2) * (side + 2));
    const auto& pixels = images.pixels[f];
    for (int row = 0; row < size_; ++row) {
      for (int column = 0; column < size_; ++column) {
        knot(f, column + 1, size_ - row) =
            pixels[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
      }
    }
    const CubeView view = cube_view(kCubeFaces[f]);
    const auto left = along_edge(images, view.gaze, -view.right, view.up);
    const auto right = along_edge(images, view.gaze, view.right, view.up);
    const auto below = along_edge(images, view.gaze, -view.up, view.right);
    const auto above = along_edge(images, view.gaze, view.up, view.right);
    for (int k = 0; k < size_ + 2; ++k) {
      const auto i = static_cast<std::size_t>(k);
      knot(f, 0, k) = left[i];
      knot(f, size_ + 1, k) = right[i];
      knot(f, k, 0) = below[i];
      knot(f, k, size_ + 1) = above[i];
    }
  }
}

Eigen::Array3d CubeMap::at(const Vec3& direction) const {
  const CubePoint place = cube_mapping(direction);
  const auto face = static_cast<std::size_t>(place.face);
  const Cell u(place.at.u, size_), v(place.at.v, size_);
  const Eigen::Array3d low = (1 - u.share) * knot(face, u.first, v.first) + u.share * knot(face, u.first + 1, v.first);
  const Eigen::Array3d high =
      (1 - u.share) * knot(face, u.first, v.first + 1) + u.share * knot(face, u.first + 1, v.first + 1);
  return (1 - v.share) * low + v.share * high;
}

}  // namespace etendue
