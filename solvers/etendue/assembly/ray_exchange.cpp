// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/ray_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/assembly/round_checks.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/core/split_mix.hpp"
#include "etendue/form_factor/patch_chart.hpp"
#include "etendue/geometry/jordan.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/newell.hpp"

namespace etendue {

namespace {

/// Of coordinates: how far apart rounding may leave surfaces that touch.
constexpr double kContact = 16 * kUnitRoundoff;

/// The n-th number of a stream depends on seed and stream alone.
class Stream {
 public:
  Stream(std::uint64_t seed, std::uint64_t number) : state_(split_mix(seed) ^ split_mix(number * kGoldenStep + 1)) {}
  /// In [0, 1).
  double unit() { return unit_interval(split_mix(state_ += kGoldenStep)); }

 private:
  std::uint64_t state_;
};

/// A point of a convex polygon, each as likely as any other.
Vec3 point_of(const Polygon& polygon, Stream& random) {
  const auto& v = polygon.vertices();
  double target = random.unit() * polygon.area();
  std::size_t k = 1;
  for (; k + 2 < v.size(); ++k) {
    const double area = 0.5 * (v[k] - v[0]).cross(v[k + 1] - v[0]).norm();
    if (target < area) break;
    target -= area;
  }
  const double root = std::sqrt(random.unit()), share = random.unit();
  return (1 - root) * v[0] + root * ((1 - share) * v[k] + share * v[k + 1]);
}

/// A direction before the plane, its likelihood proportional to the cosine with the normal.
Vec3 direction_from(const Vec3& normal, Stream& random) {
  const double square = random.unit(), turn = 2 * std::numbers::pi * random.unit();
  const TangentFrame frame = tangent_frame(normal);
  const double radius = std::sqrt(square);
  return radius * std::cos(turn) * frame.u + radius * std::sin(turn) * frame.v + std::sqrt(1 - square) * normal;
}

struct Start {
  Vec3 point, normal;
};

Start start_on(const Polygon& polygon, Stream& random) {
  return {point_of(polygon, random), polygon.normal()};
}

Start start_on(const CurvedPatch& patch, Stream& random) {
  if (const auto* polygon = std::get_if<Polygon>(&patch)) return start_on(*polygon, random);
  const double share = random.unit(), turn = 2 * std::numbers::pi * random.unit();
  const auto around = [turn](const Vec3& axis) -> Vec3 {
    const TangentFrame frame = tangent_frame(axis);
    return std::cos(turn) * frame.u + std::sin(turn) * frame.v;
  };
  if (const auto* sphere = std::get_if<Sphere>(&patch)) {  // heights are equally likely (Archimedes)
    const double height = 2 * share - 1;
    const Vec3 out =
        (std::sqrt((1 - height) * (1 + height)) * around(Vec3::UnitZ()) + height * Vec3::UnitZ()).normalized();
    return {sphere->centre + sphere->radius * out, out};
  }
  if (const auto* disc = std::get_if<Disc>(&patch)) {
    return {disc->centre + std::sqrt(share) * disc->radius * around(disc->normal), disc->normal};
  }
  const auto& cylinder = std::get<Cylinder>(patch);
  const Vec3 along = cylinder.top - cylinder.base, out = around(along.normalized()).normalized();
  return {cylinder.base + share * along + cylinder.radius * out, out};
}

/// What arrives where: the faces and round surfaces as a scene, and which elements lie in which face.
struct Target {
  const ElementMesh& mesh;
  Scene scene;
  std::unique_ptr<const Accelerator> accelerator;
  std::vector<std::vector<std::size_t>> elements_of;

  Target(const ElementMesh& elements, std::span<const RoundSurface> rounds)
      : mesh(elements), elements_of(elements.faces.size()) {
    scene.materials.emplace_back();
    for (const Face& face : mesh.faces) scene.objects.push_back({"", face.polygon, 0, {}});
    for (std::size_t k = 0; k < mesh.elements.size(); ++k) elements_of[mesh.elements[k].face].push_back(k);
    for (const RoundSurface& round : rounds) add(round.shape);
    for (const RoundSurface& round : rounds) close(round.shape, rounds);
    accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  }

  void add(const CurvedPatch& shape) {
    elements_of.push_back({mesh.elements.size() + elements_of.size() - mesh.faces.size()});
    if (const auto* sphere = std::get_if<Sphere>(&shape)) scene.objects.push_back({"", *sphere, 0, {}});
    if (const auto* disc = std::get_if<Disc>(&shape)) scene.objects.push_back({"", *disc, 0, {}});
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) scene.objects.push_back({"", *cylinder, 0, {}});
  }

  /// A cylinder counts as filled: an end that no disc closes stops what enters there.
  void close(const CurvedPatch& shape, std::span<const RoundSurface> rounds) {
    const auto* cylinder = std::get_if<Cylinder>(&shape);
    if (cylinder == nullptr) return;
    const Vec3 axis = (cylinder->top - cylinder->base).normalized();
    for (const Vec3& end : {cylinder->base, cylinder->top}) {
      bool closed = false;
      for (const RoundSurface& other : rounds) {
        const auto* disc = std::get_if<Disc>(&other.shape);
        closed =
            closed || (disc != nullptr && caps(*disc, *cylinder) && (disc->centre - end).norm() < cylinder->radius);
      }
      if (!closed) scene.objects.push_back({"", Disc{end, axis, cylinder->radius}, 0, {}});
    }
  }

  /// Calls `arrive(element)` for each element whose front the ray meets first; several where subsurfaces lie in a face.
  template <class Arrive>
  void trace(Ray ray, std::size_t own_face, const Arrive& arrive) const {
    auto nearest = accelerator->nearest(ray).hit;
    while (nearest && nearest->object == own_face) {  // its own plane, met in the rounding of the starting point
      ray.t_min = nearest->hit.t;
      nearest = accelerator->nearest(ray).hit;
    }
    if (!nearest || nearest->object >= elements_of.size()) return;
    const auto& candidates = elements_of[nearest->object];
    if (nearest->object >= mesh.faces.size()) {
      if (nearest->hit.normal.dot(ray.direction) < 0) arrive(candidates.front());
      return;
    }
    const Polygon& met = mesh.faces[nearest->object].polygon;
    if (met.normal().dot(ray.direction) >= 0) return;
    // What lies on the starting point's own surface covers it: nothing passes between.
    const double room = kContact * (ray.origin.lpNorm<1>() + met.centroid().lpNorm<1>());
    if (std::abs(met.normal().dot(ray.origin - met.centroid())) <= room) return;
    const int axis = dominant_axis(met.normal());
    for (const std::size_t element : candidates) {
      // Elements of a whole undivided face are met as the face is; the rim is nobody's to lose.
      if (candidates.size() == 1 || encloses(mesh.elements[element].polygon.vertices(), nearest->hit.point, axis)) {
        arrive(element);
      }
    }
  }
};

/// Relative entropy of a coin with chance p against one with chance q.
double entropy(double p, double q) {
  const auto term = [](double a, double b) { return a == 0 ? 0 : a * std::log(a / b); };
  return term(p, q) + term(1 - p, 1 - q);
}

}  // namespace

double chance_bound(std::uint64_t count, std::uint64_t of, double doubt) {
  const double p = static_cast<double>(count) / static_cast<double>(of);
  const double most = std::log(2 / doubt) / static_cast<double>(of);
  const auto end = [&](double limit) {  // as far towards `limit` as the entropy allows, rounded outward
    double inside = p, outside = limit;
    constexpr int kHalvings = 60;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (inside + outside);
      (entropy(p, middle) <= most ? inside : outside) = middle;
    }
    return std::abs(outside - p);
  };
  return std::max(end(0), end(1));
}

RayExchange::RayExchange(const ElementMesh& mesh, const RaySettings& settings, const Execution& execution,
                         std::span<const RoundSurface> rounds)
    : settings_(settings), areas_(areas_of(mesh)), arrivals_(mesh.elements.size() + rounds.size()) {
  for (const RoundSurface& round : rounds) areas_.push_back(area_of(round.shape));
  const Target target(mesh, rounds);
  const std::size_t flat = mesh.elements.size();
  double largest = 0;
  for (const RoundSurface& round : rounds) {
    const PatchBall ball = ball_around(round.shape);
    largest = std::max(largest, ball.middle.cwiseAbs().maxCoeff() + ball.size);
  }
  const double nearest_meeting = kTouching * largest;
  complete_ = parallel_for(arrivals_.size(), execution, [&](std::size_t i) {
    const std::size_t face = i < flat ? mesh.elements[i].face : mesh.faces.size() + i - flat;
    std::map<std::size_t, std::uint64_t> counts;
    Stream random(settings.seed, i);
    for (int k = 0; k < settings.rays; ++k) {
      Ray ray;
      const Start start =
          i < flat ? start_on(mesh.elements[i].polygon, random) : start_on(rounds[i - flat].shape, random);
      ray.origin = start.point;
      ray.direction = direction_from(start.normal, random);
      ray.t_min = rounds.empty() ? 0 : nearest_meeting;  // the back of a disc that lies on another is no obstacle
      target.trace(ray, face, [&](std::size_t element) { ++counts[element]; });
    }
    arrivals_[i].assign(counts.begin(), counts.end());
  });
}

void RayExchange::find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const {
  const auto of = static_cast<std::uint64_t>(settings_.rays);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const auto [from, to] = areas_[i] <= areas_[j] ? std::pair(i, j) : std::pair(j, i);
    const Arrivals& all = arrivals_[from];
    const auto found = std::lower_bound(all.begin(), all.end(), std::pair(to, std::uint64_t{0}));
    const std::uint64_t count = found != all.end() && found->first == to ? found->second : 0;
    const double chance = static_cast<double>(count) / static_cast<double>(of);
    exchanges[k] = {areas_[from] * chance, areas_[from] * chance_bound(count, of, kRayDoubt)};
    ++report.sampled;
  }
}

}  // namespace etendue
