// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/highlight_reader.hpp"

#include <string>

#include "etendue/io/scene_keys.hpp"

namespace etendue {

namespace {

/// Rougher or smoother facets, and other indices, are no surface that anybody has.
constexpr ValueRange kRoughness{0.001, 10};
constexpr ValueRange kIndex{0.01, 100};
constexpr ValueRange kExtinction{0, 100};

std::string choice(const SceneNode& node, const char* key, const std::vector<std::string>& words) {
  const auto member = node.member(key);
  return member ? member->choice(words).value_or(words.front()) : words.front();
}

/// η and k of a surface that has them.
template <class Law>
void read_index(const SceneNode& node, Law& law) {
  const auto eta = node.member("eta"), k = node.member("k");
  if (eta) law.eta = eta->colour(kIndex).value_or(law.eta);
  if (k) law.k = k->colour(kExtinction).value_or(law.k);
}

FacetHighlight read_facets(const SceneNode& node) {
  const std::string shape = choice(node, "distribution", {"beckmann", "gaussian", "ggx"});
  const std::string hidden = choice(node, "shadowing", {"grooves", "smith"});
  const auto roughness_node = node.member("roughness");
  const double roughness = roughness_node ? roughness_node->number(kRoughness).value_or(1) : 1;
  const auto distribution = shape == "ggx"        ? FacetDistribution::ggx
                            : shape == "gaussian" ? FacetDistribution::gaussian
                                                  : FacetDistribution::beckmann;
  auto shadowing = hidden == "smith" ? FacetShadowing::smith : FacetShadowing::grooves;
  if (distribution == FacetDistribution::gaussian && shadowing == FacetShadowing::smith) {
    node.member("shadowing")
        ->expected("\"grooves\" with the gaussian distribution, for which Smith's has no closed form");
    shadowing = FacetShadowing::grooves;
  }
  FacetHighlight law{Facets(distribution, roughness, shadowing)};
  read_index(node, law);
  return law;
}

}  // namespace

std::optional<Highlight> read_highlight(const SceneNode& node, double exponent) {
  const auto type = node.kind(highlight_types());
  if (!node.is(type ? keys_of(*type + "_highlight")
                    : keys_of_any({"phong_highlight", "blinn_highlight", "facets_highlight"})))
    return std::nullopt;
  if (!type || *type == "facets") {
    const FacetHighlight facets = read_facets(node);
    return type ? std::optional<Highlight>(facets) : std::nullopt;
  }
  if (*type == "blinn") return BlinnHighlight{exponent};
  if (!node.member("eta") && !node.member("k")) return std::nullopt;  // Phong's with k_s alone
  FresnelHighlight law{exponent};
  read_index(node, law);
  return law;
}

}  // namespace etendue
