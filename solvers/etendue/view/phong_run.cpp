// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/phong_run.hpp"

#include "etendue/core/contract.hpp"
#include "etendue/optics/unit.hpp"
#include "etendue/raytracing/shade.hpp"

namespace etendue {

PhongRun::PhongRun(const FacetShader& shader) : shader_(shader), cosines_(std::size_t{kLength} * shader.lights()) {}

void PhongRun::put(const Facet& facet, const Eigen::Array3d& weights) {
  points_.put(count_, mixed(weights, facet.corners));
  normals_.put(count_, mixed(weights, facet.normals));
}

void PhongRun::normalize() {
  const Vec3& eye = shader_.scene().camera.eye;
  views_.x = eye.x() - points_.x;
  views_.y = eye.y() - points_.y;
  views_.z = eye.z() - points_.z;
  const Column across = normals_.dot(normals_).sqrt(), away = views_.dot(views_).sqrt();
  normals_.divide(across);
  views_.divide(away);
  if (across.minCoeff() > 0 && away.minCoeff() > 0) return;
  for (int i = 0; i < count_; ++i) {
    if (!(across[i] > 0)) normals_.put(i, pixels_[static_cast<std::size_t>(i)].facet->normal);
    if (!(away[i] > 0)) views_.put(i, shader_.to_viewer(points_.at(i)));
  }
}

void PhongRun::see(std::size_t light) {
  const Light& source = shader_.scene().lights[light];
  const auto cosines = [&](int i) -> LightCosines& {
    return cosines_[static_cast<std::size_t>(i) * shader_.lights() + light];
  };
  Column incidence, across;
  if (const auto* directional = std::get_if<DirectionalLight>(&source)) {
    require(is_unit(directional->direction), "PhongRun: the direction of a light is a unit vector");
    incidence = normals_.dot(directional->direction);
    across = views_.dot(directional->direction);
  } else {
    Vectors to_light;
    for (int i = 0; i < count_; ++i) {
      const LightSample sample = towards(source, points_.at(i));
      to_light.put(i, sample.to_light);  // zero in the light itself: then N·L is, too
      cosines(i).share = arriving_share(source, sample.distance);
    }
    incidence = normals_.dot(to_light);
    across = views_.dot(to_light);
  }
  const Column mirror = 2 * incidence * normals_.dot(views_) - across;
  for (int i = 0; i < count_; ++i) {
    cosines(i).incidence = incidence[i];
    cosines(i).mirror = mirror[i];
  }
}

void PhongRun::finish() {
  if (count_ == 0) return;
  normalize();
  for (std::size_t light = 0; light < shader_.lights(); ++light) see(light);
  for (int i = 0; i < count_; ++i) {
    const Pixel& pixel = pixels_[static_cast<std::size_t>(i)];
    const std::span<const LightCosines> cosines(cosines_.data() + static_cast<std::size_t>(i) * shader_.lights(),
                                                shader_.lights());
    *pixel.colour = shader_.reflected(*pixel.facet, *pixel.weights, points_.at(i), cosines);
  }
  count_ = 0;
}

}  // namespace etendue
