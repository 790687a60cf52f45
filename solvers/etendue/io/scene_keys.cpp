// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/scene_keys.hpp"

#include <algorithm>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

using Keys = std::vector<std::string>;

/// A shape: what every shape has, and its own keys.
KeySet shape(const char* type, const Keys& mandatory, const Keys& optional = {}) {
  KeySet set{type,
             {"type", "material"},
             {"comment", "name", "transform", "velocity", "elements", "element_size", "grading", "patches"}};
  set.mandatory.insert(set.mandatory.end(), mandatory.begin(), mandatory.end());
  set.optional.insert(set.optional.end(), optional.begin(), optional.end());
  return set;
}

}  // namespace

Keys KeySet::all() const {
  Keys keys = mandatory;
  keys.insert(keys.end(), optional.begin(), optional.end());
  return keys;
}

const std::vector<KeySet>& scene_key_sets() {
  static const std::vector<KeySet> sets{
      {"scene",
       {"format", "version", "unit"},
       {"$schema", "comment", "name", "include", "camera", "background", "ambient", "illuminant", "align_mesh",
        "materials", "lights", "objects"}},
      {"camera",
       {"eye", "up", "horizontal_fov_deg", "resolution"},
       {"comment", "look_at", "gaze", "lens_radius", "focal_distance", "shutter"}},
      {"material", {}, {"comment", "k_d",      "k_a",     "reflectance", "k_s",         "n",           "k_r",
                        "k_t",     "eta",      "fresnel", "dispersion",  "absorption",  "priority",    "frost",
                        "rho",     "emission", "pattern", "bump",        "environment", "see_through", "highlight"}},
      {"phong_highlight", {"type"}, {"comment", "eta", "k"}},
      {"blinn_highlight", {"type"}, {"comment"}},
      {"facets_highlight", {"type", "roughness"}, {"comment", "distribution", "shadowing", "eta", "k"}},
      {"spectrum", {"from_nm", "step_nm", "values"}, {"comment"}},
      {"see_through", {"greatest"}, {"comment", "least", "power"}},
      {"cauchy", {"a"}, {"comment", "b", "c"}},
      {"sellmeier", {"strength", "resonance"}, {"comment"}},
      {"checkerboard_pattern", {"type", "k_d", "size"}, {"comment", "k_a", "origin", "u", "v"}},
      {"wood_pattern", {"type", "k_d", "ring"}, {"comment", "k_a", "origin", "axis"}},
      {"noise_pattern", {"type", "k_d", "size"}, {"comment", "k_a", "origin", "octaves", "seed"}},
      {"marble_pattern",
       {"type", "k_d", "size"},
       {"comment", "k_a", "origin", "axis", "turbulence", "octaves", "seed"}},
      {"squares_pattern", {"type"}, {"comment", "columns", "rows", "seed", "mapping", "tiles"}},
      {"image_pattern", {"type", "file"}, {"comment", "wrap", "mapping", "tiles"}},
      {"parameters_mapping", {"type"}, {"comment"}},
      {"plane_mapping", {"type", "width"}, {"comment", "height", "origin", "pole", "equator"}},
      {"cylinder_mapping", {"type", "height"}, {"comment", "origin", "pole", "equator"}},
      {"sphere_mapping", {"type"}, {"comment", "centre", "pole", "equator"}},
      {"box_mapping", {"type", "size"}, {"comment", "centre", "pole", "equator"}},
      {"waves_bump", {"type", "height", "waves"}, {"comment", "origin", "u", "v", "size"}},
      {"table_bump", {"type", "heights"}, {"comment", "height", "repeat", "edges", "origin", "u", "v", "size"}},
      {"rough_bump", {"type", "height", "cells"}, {"comment", "seed", "origin", "u", "v", "size"}},
      {"point_light", {"type", "position", "intensity"}, {"comment", "falloff", "d0"}},
      {"directional_light", {"type", "direction", "intensity"}, {"comment"}},
      {"rectangle_light", {"type", "corner", "u", "v", "intensity"}, {"comment", "samples"}},
      {"sphere_light", {"type", "centre", "radius", "intensity"}, {"comment", "samples"}},
      shape("sphere", {"centre", "radius"}),
      shape("polygon", {"vertices"}, {"holes"}),
      shape("triangle", {"vertices"}),
      shape("plane", {"point", "normal"}),
      shape("disc", {"centre", "normal", "radius"}),
      shape("cylinder", {"base", "top", "radius"}, {"caps"}),
      shape("cone", {"base", "top", "base_radius"}, {"top_radius", "caps"}),
      shape("torus", {"centre", "axis", "ring_radius", "tube_radius"}),
      shape("quadric", {"squares", "constant"}, {"products", "linear", "low", "high", "centre", "size"}),
      shape("bezier", {"control"}),
      shape("box", {}, {"low", "high", "centre", "size"}),
      shape("mesh", {"vertices"}, {"triangles", "quads", "texture"}),
      {"group", {"type", "children"}, {"comment", "name", "transform", "velocity"}},
      {"translate", {"translate"}, {"comment"}},
      {"rotate", {"rotate"}, {"comment"}},
      {"rotation", {"axis", "angle_deg"}, {"comment"}},
      {"scale", {"scale"}, {"comment"}},
  };
  return sets;
}

const KeySet& keys_of(const std::string& name) {
  const auto& sets = scene_key_sets();
  const auto found = std::find_if(sets.begin(), sets.end(), [&](const KeySet& set) { return set.name == name; });
  require(found != sets.end(), "keys_of: the kind of object exists");
  return *found;
}

KeySet keys_of_any(const Keys& names) {
  KeySet any{"any", {"type"}, {}};
  for (const std::string& name : names) {
    for (const std::string& key : keys_of(name).all()) {
      if (const Keys known = any.all(); std::find(known.begin(), known.end(), key) == known.end())
        any.optional.push_back(key);
    }
  }
  return any;
}

const Keys& object_types() {
  static const Keys types{"sphere", "polygon", "triangle", "plane", "disc", "cylinder", "cone",
                          "torus",  "quadric", "bezier",   "box",   "mesh", "group"};
  return types;
}

const Keys& pattern_types() {
  static const Keys types{"checkerboard", "wood", "noise", "marble", "squares", "image"};
  return types;
}

const Keys& mapping_types() {
  static const Keys types{"parameters", "plane", "cylinder", "sphere", "box"};
  return types;
}

const Keys& bump_types() {
  static const Keys types{"waves", "table", "rough"};
  return types;
}

const Keys& highlight_types() {
  static const Keys types{"phong", "blinn", "facets"};
  return types;
}

const Keys& light_types() {
  static const Keys types{"point", "directional", "rectangle", "sphere"};
  return types;
}

}  // namespace etendue
