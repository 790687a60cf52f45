// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/hemicube_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/form_factor/point_polygon.hpp"

namespace etendue {

namespace {

/// Elements of a face that cover more than its area by this share lie over one another.
constexpr double kOverlaid = 0x1p-20;

/// Doubling the points along a side shows three quarters of an error that falls with their square, and less of one that falls
/// more slowly, as it does where elements touch: half.
constexpr double kUnseenByDoubling = 2;

std::uint64_t mixed(std::uint64_t z) {  // SplitMix64's finalizer
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Sums for every element, and which of them were touched.
class Tally {
 public:
  explicit Tally(std::size_t elements) : factor_(elements, 0.0), rim_(elements, 0.0) {}
  void see(std::size_t element, double delta) { factor_[element] += delta; }
  void border(std::size_t element, double delta) { rim_[element] += delta; }
  std::vector<SeenShare> gathered() const {
    std::vector<SeenShare> shares;
    for (std::size_t k = 0; k < factor_.size(); ++k) {
      if (factor_[k] > 0 || rim_[k] > 0) shares.push_back({k, factor_[k], rim_[k]});
    }
    return shares;
  }

 private:
  std::vector<double> factor_, rim_;
};

bool faces(const Polygon& polygon, const Vec3& point) {
  return polygon.normal().dot(point - polygon.centroid()) > 0;
}

/// Counts the pixels of a buffer by the elements they show, and those that lie on outlines.
template <class Shown>
void count_pixels(const ItemBuffer& buffer, std::size_t view, const PixelProjection& projection, const Shown& shown,
                  Tally& tally) {
  const PixelView& window = buffer.view();
  const auto differ = [&](int column, int row, int other_column, int other_row, double delta) {
    if (!window.has(other_column, other_row)) return;  // goes on with the next face of the body
    const std::int32_t here = buffer.item(column, row), there = buffer.item(other_column, other_row);
    if (here == there) return;
    if (shown(here)) tally.border(static_cast<std::size_t>(here), 0.5 * delta);
    if (shown(there)) tally.border(static_cast<std::size_t>(there), 0.5 * delta);
  };
  for (int row = 0; row < window.rows; ++row) {
    for (int column = 0; column < window.columns; ++column) {
      if (!window.has(column, row)) continue;
      const double delta = projection.delta(view, column, row);
      const std::int32_t item = buffer.item(column, row);
      if (shown(item)) tally.see(static_cast<std::size_t>(item), delta);
      differ(column, row, column + 1, row, delta);
      differ(column, row, column, row + 1, delta);
    }
  }
}

/// The corners of a quadrilateral, weighed by (s, t).
Vec3 inside(const std::vector<Vec3>& v, double s, double t) {
  return (1 - s) * (1 - t) * v[0] + s * (1 - t) * v[1] + s * t * v[2] + (1 - s) * t * v[3];
}

std::vector<StandPoint> cells_of(const std::vector<Vec3>& v, int n) {
  std::vector<StandPoint> points;
  for (int b = 0; b < n; ++b) {
    for (int a = 0; a < n; ++a) {
      const double s = (a + 0.5) / n, t = (b + 0.5) / n;
      const Vec3 along_s = (1 - t) * (v[1] - v[0]) + t * (v[2] - v[3]);
      const Vec3 along_t = (1 - s) * (v[3] - v[0]) + s * (v[2] - v[1]);
      points.push_back({inside(v, s, t), along_s.cross(along_t).norm()});
    }
  }
  return points;
}

std::vector<StandPoint> triangles_of(const std::vector<Vec3>& v, int n) {
  std::vector<StandPoint> points;
  for (std::size_t k = 1; k + 1 < v.size(); ++k) {
    const Vec3 first = (v[k] - v[0]) / n, second = (v[k + 1] - v[0]) / n;
    const double area = first.cross(second).norm();
    for (int a = 0; a < n; ++a) {
      for (int b = 0; a + b < n; ++b) {
        points.push_back({v[0] + (a + 1.0 / 3) * first + (b + 1.0 / 3) * second, area});
        if (a + b + 1 < n) points.push_back({v[0] + (a + 2.0 / 3) * first + (b + 2.0 / 3) * second, area});
      }
    }
  }
  return points;
}

}  // namespace

double turn_of(std::uint64_t seed, std::size_t element, std::size_t point) {
  const std::uint64_t counter = mixed(mixed(seed + 0x9e3779b97f4a7c15u) ^ (element * 0x9e3779b97f4a7c15u + 1)) + point;
  return 2 * std::numbers::pi * static_cast<double>(mixed(counter * 0x9e3779b97f4a7c15u) >> 11) * 0x1p-53;
}

std::vector<StandPoint> stand_points(const Polygon& polygon, int per_side) {
  require(per_side >= 1, "stand_points: at least one point a side");
  const auto& v = polygon.vertices();
  if (per_side == 1) return {{polygon.centroid(), 1}};
  std::vector<StandPoint> points = v.size() == 4 ? cells_of(v, per_side) : triangles_of(v, per_side);
  double sum = 0;
  for (const StandPoint& point : points) sum += point.share;
  for (StandPoint& point : points) point.share /= sum;
  return points;
}

ItemScene::ItemScene(const ElementMesh& mesh) : mesh_(mesh), overlaid_(mesh.faces.size()) {
  std::vector<double> covered(mesh.faces.size(), 0.0);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const Element& element = mesh.elements[k];
    covered[element.face] += element.polygon.area();
    overlaid_[element.face].push_back(k);
    items_.push_back({&element.polygon, element.face});
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    items_.push_back({&mesh.faces[f].polygon, f});
    const double area = mesh.faces[f].polygon.area();
    // What elements leave of a face hides too: then the face is drawn and they are found on it.
    const bool divided = std::abs(covered[f] - area) <= kOverlaid * area;
    if (divided) {
      drawn_.insert(drawn_.end(), overlaid_[f].begin(), overlaid_[f].end());
      overlaid_[f].clear();
    } else {
      drawn_.push_back(mesh.elements.size() + f);
    }
  }
}

std::vector<SeenShare> ItemScene::seen_from(const Vec3& point, std::size_t own_face, const PixelProjection& projection,
                                            double turn) const {
  const Vec3& normal = mesh_.faces[own_face].polygon.normal();
  std::vector<std::size_t> above;  // the items that reach over the horizon
  std::vector<char> fronts(mesh_.elements.size(), 0);
  for (const std::size_t k : drawn_) {
    const auto& v = items_[k].polygon->vertices();
    const bool reaches = std::any_of(v.begin(), v.end(), [&](const Vec3& c) { return normal.dot(c - point) > 0; });
    if (items_[k].face != own_face && reaches) above.push_back(k);
    if (k < fronts.size()) fronts[k] = faces(*items_[k].polygon, point);
  }
  Tally tally(mesh_.elements.size());
  const auto shown = [&](std::int32_t item) {
    return item != kNoItem && static_cast<std::size_t>(item) < fronts.size() && fronts[static_cast<std::size_t>(item)];
  };
  const std::vector<PixelView> views = projection.views(point, normal, turn);
  for (std::size_t view = 0; view < views.size(); ++view) {
    ItemBuffer buffer(views[view]);
    for (const std::size_t k : above) {
      buffer.draw(items_[k].polygon->vertices(), items_[k].polygon->normal(), static_cast<std::int32_t>(k));
    }
    count_pixels(buffer, view, projection, shown, tally);
    for (const std::size_t k : above) {
      if (k < fronts.size() || !faces(*items_[k].polygon, point)) continue;
      for (const std::size_t element : overlaid_[items_[k].face]) {
        const Polygon& polygon = mesh_.elements[element].polygon;
        double seen = 0, widest = 0;
        std::size_t pixels = 0;
        buffer.visit_pixels(polygon.vertices(), polygon.normal(), static_cast<std::int32_t>(k),
                            [&](int column, int row) {
                              const double delta = projection.delta(view, column, row);
                              seen += delta;
                              widest = std::max(widest, delta);
                              ++pixels;
                            });
        // Its outline is not in the buffer: that of a square of as many pixels, twice over.
        tally.see(element, seen);
        tally.border(element, 4 * std::sqrt(static_cast<double>(pixels)) * widest);
      }
    }
  }
  return tally.gathered();
}

HemicubeExchange::HemicubeExchange(const ElementMesh& mesh, const HemicubeSettings& settings,
                                   const Execution& execution)
    : mesh_(mesh), settings_(settings), areas_(areas_of(mesh)), seen_(mesh.elements.size()) {
  require(settings.points >= 1, "HemicubeExchange: at least one point a side");
  slack_ = kTouching * diagonal(mesh);
  const ItemScene scene(mesh);
  const PixelProjection projection(settings.body, settings.resolution);
  largest_delta_ = projection.largest_delta();
  complete_ = parallel_for(mesh.elements.size(), execution, [&](std::size_t i) {
    const std::vector<StandPoint> points = stand_points(mesh.elements[i].polygon, settings.points);
    std::vector<SeenShare> all(mesh.elements.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double turn = settings.rotate ? turn_of(settings.seed, i, k) : 0;
      for (const SeenShare& share : scene.seen_from(points[k].point, mesh.elements[i].face, projection, turn)) {
        all[share.element].factor += points[k].share * share.factor;
        all[share.element].rim += points[k].share * share.rim;
      }
    }
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (all[j].factor > 0 || all[j].rim > 0) seen_[i].push_back({j, all[j].factor, all[j].rim});
    }
  });
}

/// A_i F_ij as i sees it, and what the pixels may have lost of it.
Bounded HemicubeExchange::side(std::size_t from, std::size_t to) const {
  const auto found =
      std::lower_bound(seen_[from].begin(), seen_[from].end(), to,
                       [](const SeenShare& share, std::size_t element) { return share.element < element; });
  const bool is_seen = found != seen_[from].end() && found->element == to;
  return {is_seen ? areas_[from] * found->factor : 0.0, areas_[from] * ((is_seen ? found->rim : 0.0) + largest_delta_)};
}

/// How much the unobstructed factor changes when twice as many points stand along each side: exact sums, no pixels.
double HemicubeExchange::proximity(std::size_t from, std::size_t to) const {
  const Polygon& polygon = mesh_.elements[from].polygon;
  const auto mean = [&](int per_side) {
    double sum = 0;
    for (const StandPoint& at : stand_points(polygon, per_side)) {
      sum += at.share * point_to_polygon(at.point, polygon.normal(), mesh_.elements[to].polygon).value;
    }
    return sum;
  };
  return areas_[from] * kUnseenByDoubling * std::abs(mean(2 * settings_.points) - mean(settings_.points));
}

bool HemicubeExchange::averted(std::size_t i, std::size_t j) const {
  const auto behind = [&](const Polygon& from, const Polygon& to) {
    return std::all_of(to.vertices().begin(), to.vertices().end(),
                       [&](const Vec3& corner) { return from.normal().dot(corner - from.centroid()) <= slack_; });
  };
  const Polygon &first = mesh_.elements[i].polygon, &second = mesh_.elements[j].polygon;
  return mesh_.elements[i].face == mesh_.elements[j].face || behind(first, second) || behind(second, first);
}

void HemicubeExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges,
                            TileReport& report) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    if (averted(i, j)) {
      exchanges[k] = {0, 0};
      ++report.averted;
      continue;
    }
    const Bounded forth = side(i, j), back = side(j, i);
    const double share = areas_[j] / (areas_[i] + areas_[j]);
    const double difference = std::abs(forth.value - back.value);
    // Behind blockers the unobstructed change says too much, and is not asked.
    const bool seen = forth.value > 0 || back.value > 0;
    const double near_by = seen ? share * proximity(i, j) + (1 - share) * proximity(j, i) : 0;
    exchanges[k] = {share * forth.value + (1 - share) * back.value,
                    difference + share * forth.bound + (1 - share) * back.bound + near_by};
    ++report.sampled;
    ++report.checked;
    report.defect = std::max(report.defect, difference / std::max(areas_[i], areas_[j]));
  }
}

}  // namespace etendue
