// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/material_reader.hpp"

#include <algorithm>

#include "etendue/io/bump_reader.hpp"
#include "etendue/io/highlight_reader.hpp"
#include "etendue/io/spectrum_reader.hpp"
#include "etendue/optics/frost.hpp"
#include "etendue/reflectance/noise.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

/// Phong exponents beyond tell nothing from a mirror; refractive indices beyond occur in no glass.
constexpr ValueRange kExponent{1, 1e6};
constexpr ValueRange kRefractiveIndex{0.1, 10};
constexpr ValueRange kPower{1, 1000};  // beyond, the rim is thinner than any pixel
constexpr ValueRange kFrost{0, kMostFrost};
/// ρ = 1 makes the radiosity equation of a closed room singular.
constexpr ValueRange kReflectance{0, 1, false, true};

double number(const SceneNode& node, const char* key, const ValueRange& interval, double otherwise) {
  const auto member = node.member(key);
  return member ? member->number(interval).value_or(otherwise) : otherwise;
}

Rgb colour(const SceneNode& node, const char* key, const ValueRange& interval, const Rgb& otherwise) {
  const auto member = node.member(key);
  return member ? member->colour(interval).value_or(otherwise) : otherwise;
}

/// Coefficients of Cauchy's formula, in micrometres: beyond them no medium disperses.
constexpr ValueRange kCauchy{-10, 10};
/// Strengths of resonances, and squares of their wavelengths in micrometres.
constexpr ValueRange kStrength{-100, 100};
constexpr ValueRange kResonance{0, 1e6};
constexpr int kMostPriority = 1000;

std::optional<Sellmeier> read_sellmeier(const SceneNode& node) {
  Sellmeier sellmeier;
  const std::size_t most = sellmeier.strength.size();
  const auto strengths = node.member("strength"), resonances = node.member("resonance");
  if (!strengths || !resonances) return std::nullopt;
  const auto b = strengths->items(1, most, "numbers"), c = resonances->items(1, most, "numbers");
  if (b.size() != c.size()) {
    resonances->complain("found " + std::to_string(c.size()) + " resonances, expected as many as strengths, " +
                         std::to_string(b.size()));
    return std::nullopt;
  }
  for (std::size_t i = 0; i < std::min(b.size(), most); ++i) {
    sellmeier.strength[i] = b[i].number(kStrength).value_or(0);
    sellmeier.resonance[i] = c[i].number(kResonance).value_or(0);
  }
  return sellmeier;
}

/// The name of a known medium, or an object with the formula's coefficients.
std::optional<Dispersion> read_dispersion(const SceneNode& node) {
  if (node.json().kind == JsonValue::Kind::string) {
    std::vector<std::string> names;
    for (const KnownMedium& medium : known_media()) names.emplace_back(medium.name);
    const auto name = node.choice(names);
    const KnownMedium* const medium = name ? find_medium(*name) : nullptr;
    return medium ? std::optional(medium->dispersion) : std::nullopt;
  }
  if (node.json().kind != JsonValue::Kind::object) {
    node.expected("the name of a medium, or an object with \"a\" (Cauchy), or with \"strength\" and \"resonance\"");
    return std::nullopt;
  }
  std::optional<Dispersion> dispersion;
  if (node.member("strength") || node.member("resonance")) {
    if (node.is(keys_of("sellmeier"))) dispersion = read_sellmeier(node);
  } else if (node.is(keys_of("cauchy")) && node.member("a")) {
    dispersion = Cauchy{number(node, "a", kCauchy, 1), number(node, "b", kCauchy, 0), number(node, "c", kCauchy, 0)};
  }
  if (dispersion && !has_index(*dispersion, kRefractiveIndex.low, kRefractiveIndex.high)) {
    node.complain("found a formula whose index leaves " + kRefractiveIndex.text() +
                  " between 380 and 780 nm, expected one of a transparent medium");
    return std::nullopt;
  }
  return dispersion;
}

void read_inside(const SceneNode& node, double scale, Material& material) {
  material.eta = number(node, "eta", kRefractiveIndex, 1);
  if (const auto fresnel = node.member("fresnel")) material.fresnel = fresnel->truth().value_or(false);
  // per length of the file, whose unit need not be the scene's
  material.absorption = colour(node, "absorption", kNonNegative, Rgb::Zero()) / scale;
  material.frost = number(node, "frost", kFrost, 0);
  if (const auto priority = node.member("priority")) {
    material.priority = static_cast<int>(priority->integer(-kMostPriority, kMostPriority).value_or(0));
  }
  if (const auto dispersion = node.member("dispersion")) {
    material.dispersion = read_dispersion(*dispersion);
    if (material.dispersion) material.eta = refractive_index(*material.dispersion, kLineD);
    if (node.member("eta")) dispersion->complain("found \"dispersion\" beside \"eta\", expected one of them");
  }
}

constexpr long kMostLightSamples = 64;  // a side: 4,096 shadow rays

Vec3 point(const SceneNode& node, const char* key, double scale) {
  const auto member = node.member(key);
  return member ? Vec3(scale * member->vector().value_or(Vec3::Zero())) : Vec3(Vec3::Zero());
}

Vec3 unit(const SceneNode& node, const char* key, const Vec3& otherwise) {
  const auto member = node.member(key);
  return member ? member->direction().value_or(otherwise) : otherwise;
}

/// Across: two edges of a square must not lie along one line. The sine that directions of a few digits leave.
constexpr double kLeastSine = 1e-6;

constexpr ValueRange kTurbulence{0, 1e3};

int octaves(const SceneNode& node) {
  const auto member = node.member("octaves");
  const auto count = member ? member->integer(1, kMostOctaves) : std::nullopt;
  return count ? static_cast<int>(*count) : Noise{}.octaves;
}

/// Of a type that is known; of others all keys were looked at.
Pattern read_form(const SceneNode& node, const std::string& type, double scale) {
  const Vec3 origin = point(node, "origin", scale), axis = unit(node, "axis", Vec3::UnitZ());
  const double size = scale * number(node, "size", kPositive, 1);
  if (type == "wood") return Wood{origin, axis, scale * number(node, "ring", kPositive, 1)};
  if (type == "noise") return Noise{origin, size, octaves(node), read_seed(node)};
  if (type == "marble") {
    const double turbulence = number(node, "turbulence", kTurbulence, Marble{}.turbulence);
    return Marble{origin, axis, size, turbulence, octaves(node), read_seed(node)};
  }
  const Vec3 u = unit(node, "u", Vec3::UnitX()), v = unit(node, "v", Vec3::UnitY());
  if (!(u.cross(v).norm() > kLeastSine)) {
    node.complain("found \"u\" along \"v\", expected the directions of two edges of a square");
  }
  return Checkerboard{origin, u, v, size};
}

/// A second colour and where it shows, or a texture.
void read_pattern(const SceneNode& node, double scale, TextureFiles& textures, Material& material) {
  const auto type = node.kind(pattern_types());
  std::vector<std::string> names;
  for (const std::string& each : pattern_types()) names.push_back(each + "_pattern");
  if (!node.is(type ? keys_of(*type + "_pattern") : keys_of_any(names))) return;
  if (type && (*type == "image" || *type == "squares")) {
    material.texture = read_texture(node, *type, scale, textures);
    return;
  }
  MaterialPattern pattern;
  pattern.k_d = colour(node, "k_d", kFraction, Rgb::Zero());
  pattern.k_a = colour(node, "k_a", kFraction, pattern.k_d);
  if (!type) {  // whatever it may be: its numbers, once each
    (void)read_form(node, "checkerboard", scale);
    (void)number(node, "ring", kPositive, 1);
    (void)number(node, "turbulence", kTurbulence, 1);
    (void)octaves(node);
    (void)read_seed(node);
    return;
  }
  pattern.pattern = read_form(node, *type, scale);
  material.pattern = pattern;
}

int read_samples(const SceneNode& node) {
  const auto member = node.member("samples");
  const auto samples = member ? member->integer(1, kMostLightSamples) : std::nullopt;
  return samples ? static_cast<int>(*samples) : RectangleLight{}.samples;
}

Falloff read_falloff(const SceneNode& node, double scale) {
  const auto law = node.member("falloff"), d0 = node.member("d0");
  const std::optional<std::string> name = law ? law->choice({"none", "linear", "inverse-square"}) : "none";
  Falloff falloff{Falloff::Law::none, scale, d0 ? d0->number(kNonNegative).value_or(0) : 0};
  if (name == "linear") falloff.law = Falloff::Law::linear;
  if (name == "inverse-square") falloff.law = Falloff::Law::inverse_square;
  if (d0 && name && *name != "linear")
    d0->complain("found \"d0\" with the falloff \"" + *name + "\", expected it with \"linear\"");
  return falloff;
}

std::optional<Light> read_rectangle_light(const SceneNode& node, const Placement& placement, const Rgb& intensity) {
  const auto vector = [&](const char* key) {
    const auto member = node.member(key);
    return member ? member->vector() : std::nullopt;
  };
  const auto corner = vector("corner"), u = vector("u"), v = vector("v");
  if (!corner || !u || !v) return std::nullopt;
  if (!(u->cross(*v).norm() > kLeastSine * u->norm() * v->norm())) {
    node.complain("found \"u\" along \"v\", expected the edges of a rectangle");
    return std::nullopt;
  }
  return Light(RectangleLight{placement.point(*corner), placement.vector(*u), placement.vector(*v), intensity,
                              read_samples(node)});
}

std::optional<Light> read_sphere_light(const SceneNode& node, const Placement& placement, const Rgb& intensity) {
  const auto centre = node.member("centre");
  const auto place = centre ? centre->vector() : std::nullopt;
  const double radius = number(node, "radius", kPositive, 1);
  if (!place) return std::nullopt;
  return Light(SphereLight{placement.point(*place), placement.scale * radius, intensity, read_samples(node)});
}

std::optional<TransparencyLaw> read_see_through(const SceneNode& node) {
  if (!node.is(keys_of("see_through"))) return std::nullopt;
  TransparencyLaw law;
  law.range = {number(node, "least", kFraction, 0), number(node, "greatest", kFraction, 1)};
  law.power = number(node, "power", kPower, 1);
  if (law.range.least <= law.range.greatest) return law;
  node.complain("found \"least\" " + shortest(law.range.least) + " above \"greatest\" " + shortest(law.range.greatest) +
                ", expected the silhouette's to be the smaller one");
  return std::nullopt;
}

/// That k_d, or the colour of a reflectance, may be taken for it.
void check_rho(const SceneNode& node, const Material& material) {
  const Rgb& rho = material.rho;
  if ((rho >= 0).all() && (rho < 1).all()) return;
  if (const auto reflectance = node.member("reflectance")) {
    reflectance->complain("found a reflectance whose colour by daylight is [" + rounded(rho[0], 6) + ", " +
                          rounded(rho[1], 6) + ", " + rounded(rho[2], 6) +
                          "], expected channels in [0, 1), since \"rho\" is taken from it; give \"rho\" beside it");
  } else {
    node.member("k_d")->expected("a number below 1, since \"rho\" is taken from it; give \"rho\" in [0, 1) to keep 1");
  }
}

}  // namespace

Material read_material(const SceneNode& node, const std::string& name, double scale, TextureFiles& textures) {
  Material material;
  material.name = name;
  if (!node.is(keys_of("material"))) return material;
  material.k_d = colour(node, "k_d", kFraction, Rgb::Zero());
  material.k_a = colour(node, "k_a", kFraction, material.k_d);
  read_reflectance(node, material);
  material.k_s = number(node, "k_s", kFraction, 0);
  material.phong_exponent = number(node, "n", kExponent, 1);
  if (const auto law = node.member("highlight")) material.highlight = read_highlight(*law, material.phong_exponent);
  material.k_r = number(node, "k_r", kFraction, 0);
  material.k_t = number(node, "k_t", kFraction, 0);
  read_inside(node, scale, material);
  material.rho = colour(node, "rho", kReflectance, material.k_d);
  material.emission = colour(node, "emission", kNonNegative, Rgb::Zero());
  if (const auto pattern = node.member("pattern")) read_pattern(*pattern, scale, textures, material);
  if (const auto law = node.member("see_through")) material.see_through = read_see_through(*law);
  if (const auto bump = node.member("bump")) material.bump = read_bump(*bump, scale);
  if (material.k_r + material.k_t > 1) {
    node.warn("found \"k_r\" + \"k_t\" = " + shortest(material.k_r + material.k_t) + " in material '" + name +
              "', expected at most 1: the rays that go on bring more than arrives");
  }
  if (!node.member("rho")) check_rho(node, material);
  return material;
}

std::optional<Light> read_light(const SceneNode& node, const Placement& placement) {
  const auto type = node.kind(light_types());
  if (!node.is(type ? keys_of(*type + "_light")
                    : keys_of_any({"point_light", "directional_light", "rectangle_light", "sphere_light"})))
    return std::nullopt;
  const auto intensity_node = node.member("intensity");
  const auto intensity = intensity_node ? intensity_node->colour(kNonNegative) : std::nullopt;
  if (type == "rectangle") return read_rectangle_light(node, placement, intensity.value_or(Rgb::Zero()));
  if (type == "sphere") return read_sphere_light(node, placement, intensity.value_or(Rgb::Zero()));
  // Of a light of unknown type both are read, for their errors.
  const auto position_node = node.member("position"), direction_node = node.member("direction");
  const auto position = position_node && type != "directional" ? position_node->vector() : std::nullopt;
  const auto direction = direction_node && type != "point" ? direction_node->direction() : std::nullopt;
  const Falloff falloff = type == "directional" ? Falloff{} : read_falloff(node, placement.scale);
  if (!type || !intensity) return std::nullopt;
  if (position) return Light(PointLight{placement.point(*position), *intensity, falloff});
  if (direction) return Light(DirectionalLight{*direction, *intensity});
  return std::nullopt;
}

}  // namespace etendue
