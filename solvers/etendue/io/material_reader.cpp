// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/material_reader.hpp"

#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

/// Phong exponents beyond tell nothing from a mirror; refractive indices beyond occur in no glass.
constexpr Interval kExponent{1, 1e6};
constexpr Interval kRefractiveIndex{0.1, 10};
/// ρ = 1 makes the radiosity equation of a closed room singular.
constexpr Interval kReflectance{0, 1, false, true};

double number(const SceneNode& node, const char* key, const Interval& interval, double otherwise) {
  const auto member = node.member(key);
  return member ? member->number(interval).value_or(otherwise) : otherwise;
}

Rgb colour(const SceneNode& node, const char* key, const Interval& interval, const Rgb& otherwise) {
  const auto member = node.member(key);
  return member ? member->colour(interval).value_or(otherwise) : otherwise;
}

}  // namespace

Material read_material(const SceneNode& node, const std::string& name) {
  Material material;
  material.name = name;
  if (!node.is(keys_of("material"))) return material;
  material.k_d = colour(node, "k_d", kFraction, Rgb::Zero());
  material.k_a = colour(node, "k_a", kFraction, material.k_d);
  material.k_s = number(node, "k_s", kFraction, 0);
  material.phong_exponent = number(node, "n", kExponent, 1);
  material.k_r = number(node, "k_r", kFraction, 0);
  material.k_t = number(node, "k_t", kFraction, 0);
  material.eta = number(node, "eta", kRefractiveIndex, 1);
  material.rho = colour(node, "rho", kReflectance, material.k_d);
  material.emission = colour(node, "emission", kNonNegative, Rgb::Zero());
  if (material.k_r + material.k_t > 1) {
    node.complain("found \"k_r\" + \"k_t\" = " + shortest(material.k_r + material.k_t) +
                  ", expected at most 1: the rays that go on would bring more than arrives");
  }
  if (!node.member("rho") && !(material.rho < 1).all()) {
    node.member("k_d")->expected("a number below 1, since \"rho\" is taken from it; give \"rho\" in [0, 1) to keep 1");
  }
  return material;
}

std::optional<Light> read_light(const SceneNode& node, const Placement& placement) {
  const auto type = node.kind(light_types());
  if (!node.is(type ? keys_of(*type + "_light") : keys_of_any({"point_light", "directional_light"})))
    return std::nullopt;
  const auto intensity_node = node.member("intensity");
  const auto intensity = intensity_node ? intensity_node->colour(kNonNegative) : std::nullopt;
  // Of a light of unknown type both are read, for their errors.
  const auto position_node = node.member("position"), direction_node = node.member("direction");
  const auto position = position_node && type != "directional" ? position_node->vector() : std::nullopt;
  const auto direction = direction_node && type != "point" ? direction_node->direction() : std::nullopt;
  if (!type || !intensity) return std::nullopt;
  if (position) return Light(PointLight{placement.point(*position), *intensity});
  if (direction) return Light(DirectionalLight{*direction, *intensity});
  return std::nullopt;
}

}  // namespace etendue
