// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/picture_facts.hpp"

#include <algorithm>

#include "etendue/raytracing/camera_rays.hpp"

namespace etendue {

namespace {

bool asks_a_ray(PictureFact fact) {
  return fact != PictureFact::samples && fact != PictureFact::tree_depth;
}

Rgb from_hit(PictureFact fact, const std::optional<SceneHit>& met, const Ray& ray, const Scene& scene) {
  if (fact == PictureFact::object) return Rgb::Constant(met ? static_cast<double>(met->object) : -1);
  if (!met) return Rgb::Zero();
  if (fact == PictureFact::depth) return Rgb::Constant(met->hit.t);
  if (fact == PictureFact::albedo) return colour_at(scene, *met, ray, met->hit.t).k_d;
  const Vec3& normal = met->hit.normal;
  return normal.dot(ray.direction) > 0 ? Rgb(-normal.array()) : Rgb(normal.array());
}

}  // namespace

std::vector<Rgb> picture_facts(const Accelerator& accelerator, const CameraFrame& frame, int column, int row,
                               const PixelWork& work, const std::vector<PictureFact>& facts) {
  const Scene& scene = accelerator.scene();
  const Ray ray = eye_ray(frame, picture_point(scene.camera, column, row));
  std::optional<SceneHit> met;
  if (std::any_of(facts.begin(), facts.end(), asks_a_ray)) met = accelerator.nearest(ray).hit;
  std::vector<Rgb> values;
  for (const PictureFact fact : facts) {
    if (fact == PictureFact::samples) {
      values.push_back(Rgb::Constant(work.samples));
    } else if (fact == PictureFact::tree_depth) {
      values.push_back(Rgb::Constant(work.tree_depth));
    } else {
      values.push_back(from_hit(fact, met, ray, scene));
    }
  }
  return values;
}

std::string name(PictureFact fact) {
  switch (fact) {
    case PictureFact::depth:
      return "depth";
    case PictureFact::normal:
      return "normal";
    case PictureFact::albedo:
      return "albedo";
    case PictureFact::object:
      return "object";
    case PictureFact::samples:
      return "samples";
    case PictureFact::tree_depth:
      return "tree_depth";
  }
  return "";
}

std::vector<std::string> channel_names(PictureFact fact) {
  const std::string whole = name(fact);
  if (fact == PictureFact::normal) return {whole + ".X", whole + ".Y", whole + ".Z"};
  if (fact == PictureFact::albedo) return {whole + ".R", whole + ".G", whole + ".B"};
  return {whole};
}

const std::vector<PictureFact>& all_picture_facts() {
  static const std::vector<PictureFact> facts{PictureFact::depth,  PictureFact::normal,  PictureFact::albedo,
                                              PictureFact::object, PictureFact::samples, PictureFact::tree_depth};
  return facts;
}

}  // namespace etendue
