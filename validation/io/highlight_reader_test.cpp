// SPDX-License-Identifier: Apache-2.0
#include "io/scene_texts.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr const char* kBall = R"({"type": "sphere", "material": "b", "centre": [0, 0, 0], "radius": 7})";

std::string with_highlight(const std::string& law) {
  return R"({"format": "etendue-scene", "version": 1, "unit": "m", "materials": {"b": {"k_s": 0.5, "n": 12, "highlight": )" +
         law + "}}}";
}

// CLAIM      A highlight is what the file says, with its defaults as documented.
// ORACLE     exact: the documented meaning of each key.
// TOLERANCE  none.
TEST(HighlightReader, HoldsWhatTheFileSays) {
  proves({"IU.4.2.2", "IU.2.7.1"}, Oracle::exact, "the documented meaning of each key");
  const TemporaryFolder folder;
  const auto read_law = [&](const std::string& law) {
    folder.add("b.json", with_highlight(law));
    return read(folder, scene_of(kBall, R"("include": ["b.json"], )")).materials[0].highlight;
  };
  EXPECT_TRUE(holds(!read_law(R"({"type": "phong"})").has_value()));
  const auto coat = std::get<FresnelHighlight>(*read_law(R"({"type": "phong", "k": [1, 2, 3]})"));
  EXPECT_TRUE(holds(coat.exponent == 12 && (coat.eta == 1.5).all() && coat.k[2] == 3));
  EXPECT_TRUE(holds(std::get<BlinnHighlight>(*read_law(R"({"type": "blinn"})")).exponent == 12));
  const auto usual = std::get<FacetHighlight>(*read_law(R"({"type": "facets", "roughness": 0.5})"));
  EXPECT_TRUE(holds((usual.eta == 1.5).all() && (usual.k == 0).all()));
  const auto same = [](const FacetHighlight& law, const Facets& facets) {
    bool equal = true;
    for (const double n_h : {0.3, 0.7, 1.0}) {
      equal = equal && law.facets.distribution(n_h) == facets.distribution(n_h) &&
              law.facets.shadowing(n_h, 0.4, 0.2, 0.6) == facets.shadowing(n_h, 0.4, 0.2, 0.6);
    }
    return equal;
  };
  EXPECT_TRUE(holds(same(usual, Facets(FacetDistribution::beckmann, 0.5, FacetShadowing::grooves))));
  const auto ggx = std::get<FacetHighlight>(*read_law(R"({"type": "facets", "roughness": 0.2, "distribution": "ggx",
      "shadowing": "smith", "eta": [0.2, 1, 2], "k": 3})"));
  EXPECT_TRUE(holds(same(ggx, Facets(FacetDistribution::ggx, 0.2, FacetShadowing::smith))));
  EXPECT_TRUE(holds(ggx.eta[0] == 0.2 && ggx.eta[2] == 2 && (ggx.k == 3).all()));
  const auto gauss =
      std::get<FacetHighlight>(*read_law(R"({"type": "facets", "roughness": 0.2, "distribution": "gaussian"})"));
  EXPECT_TRUE(holds(same(gauss, Facets(FacetDistribution::gaussian, 0.2, FacetShadowing::grooves))));
}

// CLAIM      What is wrong with a highlight is said, at its place.
// ORACLE     exact: the words of each message.
// TOLERANCE  none.
TEST(HighlightReader, RefusesAHighlightThatIsNone) {
  proves({}, Oracle::exact, "one message for each fault");
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& law, const std::string& words) {
    folder.add("b.json", with_highlight(law));
    const auto scene = read_scene(folder.add("scene.json", scene_of(kBall, R"("include": ["b.json"], )")));
    EXPECT_TRUE(holds(!scene && scene.error().message.find(words) != std::string::npos))
        << (scene ? "taken: " + law : scene.error().message);
  };
  refused(R"({"type": "fong"})", R"(highlight/type: found "fong", expected one of "phong")");
  refused(R"({"type": "facets"})", R"(highlight: found no key "roughness")");
  refused(R"({"type": "facets", "roughness": 0})", "highlight/roughness: found 0");
  refused(R"({"type": "facets", "roughness": 1, "eta": 0})", "highlight/eta: found 0");
  refused(R"({"type": "facets", "roughness": 1, "k": [1, 2]})", "highlight/k: found");
  refused(R"({"type": "facets", "roughness": 1, "distribution": "gaussian", "shadowing": "smith"})",
          "highlight/shadowing: found \"smith\", expected \"grooves\"");
  refused(R"({"type": "blinn", "roughness": 1})", "highlight/roughness: found an unknown key");
}

}  // namespace
}  // namespace etendue::validation
