// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/spectrum_reader.hpp"

#include "etendue/optics/dispersion.hpp"
#include "etendue/optics/illuminants.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

constexpr std::size_t kMostPoints = 10000;
constexpr ValueRange kWavelength{0, 1e6, true};  // [nm]: a millimetre is radio
/// Of black bodies [K]: below, next to nothing of what they send out is visible; above, its colour stays the same.
constexpr ValueRange kTemperature{500, 1e6};

using Points = std::vector<Spectrum::Point>;

/// Those of the pairs that are sound.
Points read_pairs(const SceneNode& node, const ValueRange& values) {
  Points points;
  for (const SceneNode& pair : node.items(2, kMostPoints, "pairs of a wavelength [nm] and a value")) {
    const auto numbers = pair.items(2, 2, "numbers, a wavelength [nm] and a value");
    if (numbers.size() != 2) continue;
    const auto wavelength = numbers[0].number(kWavelength), value = numbers[1].number(values);
    if (!wavelength || !value) continue;
    if (!points.empty() && !(*wavelength > points.back().wavelength)) {
      numbers[0].complain("found " + shortest(*wavelength) + " after " + shortest(points.back().wavelength) +
                          ", expected ascending wavelengths");
    }
    points.push_back({*wavelength, *value});
  }
  return points;
}

Points read_steps(const SceneNode& node, const ValueRange& values) {
  if (!node.is(keys_of("spectrum"))) return {};
  const auto from_node = node.member("from_nm"), step_node = node.member("step_nm"), list = node.member("values");
  const auto from = from_node ? from_node->number(kWavelength) : std::nullopt;
  const auto step = step_node ? step_node->number(kWavelength) : std::nullopt;
  Points points;
  if (!list) return points;
  for (const SceneNode& item : list->items(2, kMostPoints, "numbers")) {
    const auto value = item.number(values);
    if (!from || !step || !value) continue;
    points.push_back({*from + *step * static_cast<double>(points.size()), *value});
  }
  return points;
}

Spectrum glow(double temperature) {
  Spectrum spectrum = through_table(daylight_d65());
  for (Spectrum::Point& point : spectrum.points) point.value = black_body(point.wavelength, temperature);
  return spectrum;
}

}  // namespace

std::optional<Spectrum> read_spectrum(const SceneNode& node, const ValueRange& values) {
  const auto kind = node.json().kind;
  if (kind != JsonValue::Kind::array && kind != JsonValue::Kind::object) {
    node.expected("pairs [wavelength in nm, value], or an object with \"from_nm\", \"step_nm\" and \"values\"");
    return std::nullopt;
  }
  const std::size_t faults = node.errors().count();
  const Spectrum spectrum{kind == JsonValue::Kind::array ? read_pairs(node, values) : read_steps(node, values)};
  if (node.errors().count() > faults) return std::nullopt;
  const double first = spectrum.points.front().wavelength, last = spectrum.points.back().wavelength;
  if (first <= kShortestVisible && last >= kLongestVisible) return spectrum;
  node.complain("found wavelengths from " + shortest(first) + " to " + shortest(last) +
                " nm, expected all visible ones, from " + shortest(kShortestVisible) + " or less to " +
                shortest(kLongestVisible) + " or more");
  return std::nullopt;
}

std::optional<Illuminant> read_illuminant(const SceneNode& node) {
  const auto kind = node.json().kind;
  if (kind == JsonValue::Kind::string) {
    const std::string& name = node.json().text;
    if (name == "D65") return illuminant(through_table(daylight_d65()));
    if (name == "A") return illuminant(through_table(incandescent_a()));
    if (name == "sun") return illuminant(glow(kSunTemperature));
  }
  if (kind == JsonValue::Kind::number) {
    const auto temperature = node.number(kTemperature);
    if (!temperature) return std::nullopt;
    return illuminant(glow(*temperature));
  }
  if (kind != JsonValue::Kind::array && kind != JsonValue::Kind::object) {
    node.expected("\"D65\", \"A\", \"sun\", a temperature in " + kTemperature.text() + " K, or a spectrum");
    return std::nullopt;
  }
  const auto spectrum = read_spectrum(node, kNonNegative);
  if (!spectrum) return std::nullopt;
  if (is_visible(*spectrum)) return illuminant(*spectrum);
  node.complain("found a light of which the eye sees nothing, expected a power above 0 at a visible wavelength");
  return std::nullopt;
}

void read_reflectance(const SceneNode& material_node, Material& material) {
  const auto node = material_node.member("reflectance");
  if (!node) return;
  for (const char* key : {"k_d", "k_a", "pattern"}) {
    if (material_node.member(key))
      node->complain("found \"reflectance\" beside \"" + std::string(key) + "\", expected one of them");
  }
  material.reflectance = read_spectrum(*node, kFraction);
  if (material.reflectance) material.k_d = material.k_a = colour_by_daylight(*material.reflectance);
}

}  // namespace etendue
