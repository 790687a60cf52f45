// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/shells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace etendue {

namespace {

/// An edge as one face has it.
struct Half {
  Vec3 start, end;
  std::size_t face;
  Vec3 into;  ///< the face, across the edge
};

bool before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

bool precedes(const Half& a, const Half& b) {
  if (a.start != b.start) return before(a.start, b.start);
  return a.end != b.end ? before(a.end, b.end) : a.face < b.face;
}

std::vector<Half> halves_of(const std::vector<Polygon>& faces) {
  std::vector<Half> halves;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::vector<Vec3>& v = faces[f].vertices();
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vec3 &start = v[k], &end = v[k + 1 < v.size() ? k + 1 : 0];
      halves.push_back({start, end, f, faces[f].normal().cross((end - start).normalized())});
    }
  }
  std::sort(halves.begin(), halves.end(), precedes);
  return halves;
}

/// The angle inside, behind both faces. Two sides of one plate have none between them: they count as all around.
double angle_between(const Half& half, const Half& other, const std::vector<Polygon>& faces) {
  constexpr double kNone = 0x1p-20;  // rounding; who is taken for whose neighbour proves nothing
  const double along = half.into.dot(other.into), down = -faces[half.face].normal().dot(other.into);
  const double angle = std::atan2(down, along);
  return angle > kNone ? angle : angle + 2 * std::numbers::pi;
}

constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

/// Of each half edge the other one with the narrowest angle between; kNobody where there is none.
std::vector<std::size_t> nearest(const std::vector<Half>& halves, const std::vector<Polygon>& faces) {
  std::vector<std::size_t> result(halves.size(), kNobody);
  for (std::size_t k = 0; k < halves.size(); ++k) {
    const Half& half = halves[k];
    const Half wanted{half.end, half.start, 0, {}};
    double least = 2 * std::numbers::pi;
    for (auto other = std::lower_bound(halves.begin(), halves.end(), wanted, precedes);
         other != halves.end() && other->start == half.end && other->end == half.start; ++other) {
      const double angle = angle_between(half, *other, faces);
      if (angle >= least) continue;
      least = angle;
      result[k] = static_cast<std::size_t>(other - halves.begin());
    }
  }
  return result;
}

/// Numbers of groups, joined two at a time.
class Groups {
 public:
  explicit Groups(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), std::size_t{0}); }
  std::size_t of(std::size_t member) {
    while (above_[member] != member) member = above_[member] = above_[above_[member]];
    return member;
  }
  void join(std::size_t one, std::size_t other) { above_[std::max(of(one), of(other))] = std::min(of(one), of(other)); }

 private:
  std::vector<std::size_t> above_;
};

}  // namespace

std::vector<Polygon> welded(const std::vector<Face>& faces, double slack) {
  struct Corner {
    std::size_t face, index;
    Vec3 at;
    double along;
  };
  // Across no plane that scenes are built along: few corners lie at one level. Near corners differ by no more than kSpread.
  const Vec3 oblique(0.6180, 0.7321, 0.4142);
  constexpr double kSpread = 2;
  std::vector<Corner> corners;
  std::vector<Polygon> polygons;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    polygons.push_back(faces[f].polygon);
    const std::vector<Vec3>& v = polygons[f].vertices();
    for (std::size_t k = 0; k < v.size(); ++k) corners.push_back({f, k, v[k], oblique.dot(v[k])});
  }
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return std::tie(a.along, a.face, a.index) < std::tie(b.along, b.face, b.index);
  });
  std::vector<std::vector<Vec3>> moved(faces.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    auto& [face, index, at, along] = corners[k];
    for (std::size_t j = k; j > 0 && along - corners[j - 1].along <= kSpread * slack; --j) {
      if ((at - corners[j - 1].at).cwiseAbs().maxCoeff() > slack) continue;
      at = corners[j - 1].at;
      break;
    }
    const std::vector<Vec3>& v = faces[face].polygon.vertices();
    if (at == v[index]) continue;
    if (moved[face].empty()) moved[face] = v;
    moved[face][index] = at;
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (moved[f].empty()) continue;
    if (auto polygon = Polygon::make(std::move(moved[f]))) polygons[f] = std::move(polygon).value();
  }
  return polygons;
}

std::vector<std::vector<std::size_t>> closed_shells(const std::vector<Polygon>& faces) {
  constexpr std::size_t kLeastFaces = 4;
  const std::vector<Half> halves = halves_of(faces);
  const std::vector<std::size_t> other = nearest(halves, faces);
  // Of three at one edge the first may be nearest to the second, and the second to the third: such edges stay open.
  const auto joined = [&](std::size_t k) { return other[k] != kNobody && other[other[k]] == k; };
  Groups groups(faces.size());
  for (std::size_t k = 0; k < halves.size(); ++k) {
    if (joined(k)) groups.join(halves[k].face, halves[other[k]].face);
  }
  std::vector<char> open(faces.size(), 0);
  for (std::size_t k = 0; k < halves.size(); ++k) {
    if (!joined(k)) open[groups.of(halves[k].face)] = 1;
  }
  std::vector<std::vector<std::size_t>> members(faces.size()), shells;
  for (std::size_t f = 0; f < faces.size(); ++f) members[groups.of(f)].push_back(f);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (members[f].size() >= kLeastFaces && open[f] == 0) shells.push_back(std::move(members[f]));
  }
  return shells;
}

}  // namespace etendue
