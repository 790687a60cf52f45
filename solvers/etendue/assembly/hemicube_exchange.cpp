// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/hemicube_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/core/split_mix.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"

namespace etendue {

namespace {

/// Elements of a face that cover more than its area by this share lie over one another.
constexpr double kOverlaid = 0x1p-20;

/// What is asked of the factors that judge: far below what pixels reach.
constexpr Tolerance kJudge{1e-6, 1e-9};

bool faces(const Polygon& polygon, const Vec3& point) {
  return polygon.normal().dot(point - polygon.centroid()) > 0;
}

/// Adds the pixels of a buffer to the elements that they show.
template <class Shown>
void count_pixels(const ItemBuffer& buffer, std::size_t view, const PixelProjection& projection, const Shown& shown,
                  std::vector<double>& factors) {
  const PixelView& window = buffer.view();
  for (int row = 0; row < window.rows; ++row) {
    for (int column = 0; column < window.columns; ++column) {
      const std::int32_t item = buffer.item(column, row);
      if (shown(item)) factors[static_cast<std::size_t>(item)] += projection.delta(view, column, row);
    }
  }
}

std::vector<SeenShare> gathered(const std::vector<double>& factors) {
  std::vector<SeenShare> shares;
  for (std::size_t k = 0; k < factors.size(); ++k) {
    if (factors[k] > 0) shares.push_back({k, factors[k]});
  }
  return shares;
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
  const std::uint64_t counter = split_mix(split_mix(seed + kGoldenStep) ^ (element * kGoldenStep + 1)) + point;
  return 2 * std::numbers::pi * unit_interval(split_mix(counter * kGoldenStep));
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
  LookingDesk desk;
  return seen_from(point, own_face, projection, turn, desk, 1);
}

std::vector<SeenShare> ItemScene::seen_from(const Vec3& point, std::size_t own_face, const PixelProjection& projection,
                                            double turn, LookingDesk& desk, int threads) const {
  const Vec3& normal = mesh_.faces[own_face].polygon.normal();
  std::vector<std::size_t>& above = desk.above_;
  std::vector<char>& fronts = desk.fronts_;
  std::vector<double>& factors = desk.factors_;
  above.clear();
  fronts.assign(mesh_.elements.size(), 0);
  factors.assign(mesh_.elements.size(), 0.0);
  for (const std::size_t k : drawn_) {
    const auto& v = items_[k].polygon->vertices();
    const bool reaches = std::any_of(v.begin(), v.end(), [&](const Vec3& c) { return normal.dot(c - point) > 0; });
    if (items_[k].face != own_face && reaches) above.push_back(k);
    if (k < fronts.size()) fronts[k] = faces(*items_[k].polygon, point);
  }
  const std::vector<PixelView> views = projection.views(point, normal, turn);
  while (desk.buffers_.size() < views.size()) desk.buffers_.emplace_back(views[desk.buffers_.size()]);
  Execution drawing;
  drawing.threads = threads;
  parallel_for(views.size(), drawing, [&](std::size_t view) {
    ItemBuffer& buffer = desk.buffers_[view];
    buffer.look(views[view]);
    for (const std::size_t k : above) {
      buffer.draw(items_[k].polygon->vertices(), items_[k].polygon->normal(), static_cast<std::int32_t>(k));
    }
  });
  const auto shown = [&](std::int32_t item) {
    return item != kNoItem && static_cast<std::size_t>(item) < fronts.size() && fronts[static_cast<std::size_t>(item)];
  };
  // One view after the other: the order of the sums does not depend on threads.
  for (std::size_t view = 0; view < views.size(); ++view) {
    const ItemBuffer& buffer = desk.buffers_[view];
    count_pixels(buffer, view, projection, shown, factors);
    for (const std::size_t k : above) {
      if (k < fronts.size() || !faces(*items_[k].polygon, point)) continue;
      for (const std::size_t element : overlaid_[items_[k].face]) {
        const Polygon& polygon = mesh_.elements[element].polygon;
        buffer.visit_pixels(polygon.vertices(), polygon.normal(), static_cast<std::int32_t>(k),
                            [&](int column, int row) { factors[element] += projection.delta(view, column, row); });
      }
    }
  }
  return gathered(factors);
}

std::vector<SeenShare> mean_seen(const ItemScene& scene, const Element& from, std::size_t number,
                                 const HemicubeSettings& settings, const PixelProjection& projection, LookingDesk& desk,
                                 int threads) {
  const std::vector<StandPoint> points = stand_points(from.polygon, settings.points);
  std::vector<SeenShare> all;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double turn = settings.rotate ? turn_of(settings.seed, number, k) : 0;
    auto shares = scene.seen_from(points[k].point, from.face, projection, turn, desk, threads);
    if (points.size() == 1) return shares;
    for (SeenShare& share : shares) share.factor *= points[k].share;
    all.insert(all.end(), shares.begin(), shares.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const SeenShare& a, const SeenShare& b) { return a.element < b.element; });
  std::vector<SeenShare> mean;
  for (const SeenShare& share : all) {
    if (!mean.empty() && mean.back().element == share.element) {
      mean.back().factor += share.factor;
    } else {
      mean.push_back(share);
    }
  }
  return mean;
}

HemicubeExchange::HemicubeExchange(const ElementMesh& mesh, const HemicubeSettings& settings,
                                   const Execution& execution)
    : mesh_(mesh), settings_(settings), areas_(areas_of(mesh)), seen_(mesh.elements.size()), sight_(mesh) {
  const ItemScene scene(mesh);
  const PixelProjection projection(settings.body, settings.resolution);
  complete_ = parallel_for(mesh.elements.size(), execution, [&](std::size_t i) {
    LookingDesk desk;
    seen_[i] = mean_seen(scene, mesh.elements[i], i, settings_, projection, desk, 1);
  });
}

/// A_i F_ij as i sees it.
double HemicubeExchange::seen_exchange(std::size_t from, std::size_t to) const {
  const auto found =
      std::lower_bound(seen_[from].begin(), seen_[from].end(), to,
                       [](const SeenShare& seen, std::size_t element) { return seen.element < element; });
  return found != seen_[from].end() && found->element == to ? areas_[from] * found->factor : 0;
}

std::vector<std::size_t> HemicubeExchange::blockers(const SurfacePair& pair) const {
  return sight_.between(pair.i, pair.j).blockers;
}

void HemicubeExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges,
                            TileReport& report) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const PairSight sight = sight_.between(i, j).sight;
    exchanges[k] = {0, 0};
    if (sight == PairSight::averted || sight == PairSight::blocked) {
      ++(sight == PairSight::averted ? report.averted : report.blocked);
      continue;
    }
    const double forth = seen_exchange(i, j), back = seen_exchange(j, i);
    const double share = areas_[j] / (areas_[i] + areas_[j]);
    const double value = share * forth + (1 - share) * back;
    const Bounded factor = form_factor(mesh_.elements[i].polygon, mesh_.elements[j].polygon, kJudge);
    const Bounded free{areas_[i] * factor.value, areas_[i] * factor.bound};
    if (sight == PairSight::clear) {
      exchanges[k] = {value, std::abs(value - free.value) + free.bound};
      ++report.clear;
    } else {
      exchanges[k] = {value, std::max(value, free.value + free.bound - value)};
      ++report.obstructed;
    }
  }
}

}  // namespace etendue
