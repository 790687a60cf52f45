// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/shade.hpp"

#include <limits>

#include "etendue/geometry/spawn.hpp"
#include "etendue/optics/absorption.hpp"
#include "etendue/raytracing/area_light.hpp"
#include "etendue/raytracing/shading_normal.hpp"
#include "etendue/reflectance/local.hpp"

namespace etendue {

namespace {

const Rgb& intensity(const Light& light) {
  return std::visit([](const auto& each) -> const Rgb& { return each.intensity; }, light);
}

Vec3 middle(const Light& light) {
  if (const auto* rectangle = std::get_if<RectangleLight>(&light))
    return rectangle->corner + (rectangle->u + rectangle->v) / 2;
  if (const auto* sphere = std::get_if<SphereLight>(&light)) return sphere->centre;
  return std::get<PointLight>(light).position;
}

bool has_area(const Light& light) {
  return std::holds_alternative<RectangleLight>(light) || std::holds_alternative<SphereLight>(light);
}

}  // namespace

LightSample towards(const Light& light, const Vec3& point) {
  if (const auto* directional = std::get_if<DirectionalLight>(&light)) {
    return {directional->direction, std::numeric_limits<double>::infinity()};
  }
  const Vec3 way = middle(light) - point;
  // Scaled by its largest component, as Eigen's stableNorm() and stableNormalized(), to the bit, but at once.
  const double largest = way.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return {way, 0};
  const double distance = largest * (way * (1 / largest)).norm();
  return {way / ((way / largest).norm() * largest), distance};
}

double arriving_share(const Light& light, double distance) {
  const auto* point = std::get_if<PointLight>(&light);
  return point == nullptr ? 1 : arriving_share(point->falloff, distance);
}

namespace {

Ray shadow_ray_into(const Vec3& to_light, const Hit& hit, const Light& light, AcneCure cure) {
  Ray ray;
  ray.origin = cure == AcneCure::error_bound ? offset_origin(hit, to_light) : hit.point;
  if (cure == AcneCure::moved_origin) ray.origin += kShadowTolerance * to_light;
  if (cure == AcneCure::tolerance) ray.t_min = kShadowTolerance;
  const LightSample sample = towards(light, ray.origin);
  ray.direction = sample.to_light;
  ray.t_max = sample.distance;
  return ray;
}

}  // namespace

Ray shadow_ray(const Hit& hit, const Light& light, AcneCure cure) {
  return shadow_ray_into(towards(light, hit.point).to_light, hit, light, cure);
}

namespace {

/// On the viewer's side, as `normal` is.
Vec3 bumped(const SceneHit& met, const Ray& ray, const Vec3& normal, const Scene& scene) {
  const Object& object = scene.objects[met.object];
  const Vec3 point = at_rest(object, met.hit.point, ray.time);
  const Vec3 outward = shading_normal(*scene.materials[object.material].bump, object.shape, point, met.hit.normal);
  return normal.dot(met.hit.normal) < 0 ? Vec3(-outward) : outward;
}

}  // namespace

Shaded local_illumination(const RayNode& node, const Accelerator& accelerator, const SampleKey& key,
                          const Shadows& shadows, double wavelength) {
  const SceneHit& met = *node.hit;
  const Scene& scene = accelerator.scene();
  const Material& material = scene.materials[scene.objects[met.object].material];
  const Vec3 to_viewer = -node.ray.direction;
  const Vec3 normal = met.hit.normal.dot(to_viewer) < 0 ? Vec3(-met.hit.normal) : met.hit.normal;

  Shaded result;
  thread_local std::vector<IncidentLight> arriving;  // its memory is kept from hit to hit
  arriving.clear();
  SurfaceColour colour = colour_at(scene, met, node.ray, node.before + node.length);
  if (wavelength > 0 && material.reflectance)
    colour.k_d = colour.k_a = Rgb::Constant(material.reflectance->at(wavelength));
  const bool returns_light = (colour.k_d != 0).any() || material.k_s != 0;
  const auto look_for = [&](const Light& light) {
    const LightSample sample = towards(light, met.hit.point);
    if (!(normal.dot(sample.to_light) > 0)) return;
    ++result.shadow_rays;
    Ray towards_light = shadow_ray_into(sample.to_light, met.hit, light, shadows.cure);
    towards_light.time = node.ray.time;
    const Passage way = passage(towards_light, {met.object, node.media, wavelength}, accelerator, shadows);
    result.tests += way.tests;
    if ((way.share > 0).any())
      arriving.push_back({sample.to_light, intensity(light) * way.share, arriving_share(light, sample.distance)});
  };
  for (std::size_t i = 0; i < scene.lights.size() && returns_light; ++i) {
    const Light& light = scene.lights[i];
    if (!has_area(light)) {
      look_for(light);
      continue;
    }
    for (int part = 0; part < shadow_rays(light); ++part) look_for(light_part(light, part, key.part(i)));
  }
  const LocalReflection surface{colour.k_a, colour.k_d, material.k_s, material.phong_exponent,
                                material.highlight ? &*material.highlight : nullptr};
  const Vec3 shaded = material.bump ? bumped(met, node.ray, normal, scene) : normal;
  result.colour = local_reflection(surface, shaded, to_viewer, scene.ambient, arriving) + material.emission;
  return result;
}

namespace {

/// What the images around a mirror show in a direction.
Rgb mapped(const RayNode& mirror, const Vec3& direction, const Scene& scene) {
  return scene.materials[scene.objects[mirror.hit->object].material].environment->at(direction);
}

}  // namespace

Shaded shade(const RayTree& tree, const Accelerator& accelerator, const SampleKey& key, const Shadows& shadows) {
  const Scene& scene = accelerator.scene();
  Shaded total;
  thread_local std::vector<Rgb> colour;  // its memory is kept from tree to tree
  colour.assign(tree.nodes.size(), Rgb::Zero());
  // Children come after their parents, so from the back every ray's own sum is complete when it is passed on.
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const RayNode& node = tree.nodes[i];
    if (node.end == RayEnd::left_scene) colour[i] = scene.background;
    if (node.end == RayEnd::environment) colour[i] = mapped(tree.nodes[node.parent], node.ray.direction, scene);
    if (node.end == RayEnd::surface) {
      const Shaded local = local_illumination(node, accelerator, key.part(i), shadows, tree.wavelength);
      colour[i] += local.colour;
      total.shadow_rays += local.shadow_rays;
      total.tests += local.tests;
    }
    if (node.medium) colour[i] *= transmittance(scene.materials[*node.medium].absorption, node.length);
    if (node.parent != RayNode::kNone) colour[node.parent] += node.coefficient * colour[i];
  }
  total.colour = colour[0];
  return total;
}

}  // namespace etendue
