// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "io/scene_texts.hpp"
#include "support/evidence.hpp"

// Reflectances and illuminants of scene files.
namespace etendue::validation {
namespace {

const std::string kBall = R"({"type": "sphere", "material": "a", "centre": [0, 0, 0], "radius": 1})";

/// A sound scene but for its only material, and for its illuminant.
std::string spectral(const std::string& material, const std::string& illuminant = R"("A")") {
  return R"({"format": "etendue-scene", "version": 1, "unit": "m", "illuminant": )" + illuminant +
         R"(, "camera": {"eye": [0, -4, 0], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [8, 6]},
"materials": {"a": {)" +
         material + R"(}}, "objects": [)" + kBall + "]}";
}

// CLAIM      Reflectances come as pairs or in steps, and mean the same; illuminants as a name, a temperature or a spectrum; daylight
//            is the one of scenes that have a reflectance and name none, others have none.
// ORACLE     exact: one spectrum written in both ways; values at its points; a black body's ratio by Wien's approximation.
// TOLERANCE  none; the leaving out of 1 in the denominator: e^(−hc/λkT) = 1e-8 for T = 1000 K at 780 nm; 1e-7 with the constant.
TEST(SpectrumReader, HoldsWhatTheFileSays) {
  proves({"IU.2.9b"}, Oracle::exact, "one spectrum written in two ways");
  const TemporaryFolder folder;
  const Scene pairs =
      read(folder, spectral(R"("reflectance": [[380, 0.25], [580, 0.5], [780, 0.75]], "k_s": 0.5)", R"("D65")"));
  const Scene steps = read(
      folder, spectral(R"("reflectance": {"from_nm": 380, "step_nm": 200, "values": [0.25, 0.5, 0.75]}, "k_s": 0.5)"));
  for (const double at : {380.0, 405.0, 580.0, 630.0, 780.0}) {
    EXPECT_TRUE(holds(pairs.materials[0].reflectance->at(at) == 0.25 + 0.5 * (at - 380) / 400));
    EXPECT_TRUE(holds(steps.materials[0].reflectance->at(at) == pairs.materials[0].reflectance->at(at)));
  }
  const Material& material = steps.materials[0];
  EXPECT_TRUE(holds((material.k_d == colour_by_daylight(*material.reflectance)).all()));
  EXPECT_TRUE(holds((material.k_a == material.k_d).all() && (material.rho == material.k_d).all()));
  EXPECT_TRUE(holds((pairs.white() == 1).all() && steps.white()[0] > 1.5 && steps.white()[2] < 0.5));

  const Scene glow = read(folder, spectral(R"("k_d": 0.5)", "1000"));
  const double expected = std::pow(700.0 / 780, 5) * std::exp(1.438776877e7 / 1000 * (1.0 / 700 - 1.0 / 780));
  EXPECT_TRUE(near(glow.illuminant->power.at(780) / glow.illuminant->power.at(700), expected, 1e-7));
  const Scene sun = read(folder, spectral(R"("k_d": 0.5)", R"("sun")"));
  const Scene star = read(folder, spectral(R"("k_d": 0.5)", "5772"));
  for (const double at : {380.0, 500.0, 780.0})
    EXPECT_TRUE(holds(sun.illuminant->power.at(at) == star.illuminant->power.at(at)));
  const Scene flat = read(folder, spectral(R"("k_d": 0.5)", "[[300, 2], [900, 2]]"));
  EXPECT_TRUE(holds(flat.illuminant->power.at(400) == flat.illuminant->power.at(700)));

  EXPECT_TRUE(holds(!read(folder, scene_of(kBall)).illuminant.has_value()));
  const std::string without = scene_of(R"({"type": "sphere", "material": "b", "centre": [0, 0, 0], "radius": 1})",
                                       R"("include": ["b.json"], )");
  folder.add("b.json", R"({"format": "etendue-scene", "version": 1, "unit": "m",
    "materials": {"b": {"reflectance": [[380, 0.25], [780, 0.5]]}}})");
  EXPECT_TRUE(holds((read(folder, without).illuminant.value().white == 1).all()));
}

// CLAIM      What is wrong with a spectrum is said, with its place: values outside [0, 1], wavelengths that do not ascend, too few,
//            visible ones left out, a second colour beside it, a colour that radiosity cannot take, a light that is none.
// ORACLE     exact: the words of each message, and the kind of error, of which the program makes the exit code 3.
// TOLERANCE  none.
TEST(SpectrumReader, SaysWhatIsWrongAndWhere) {
  proves({}, Oracle::exact, "one message for each fault");
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& words) {
    const auto scene = read_scene(folder.add("scene.json", text));
    EXPECT_TRUE(holds(!scene && scene.error().code == ErrorCode::invalid_input &&
                      scene.error().message.find(words) != std::string::npos))
        << (scene ? "taken: " + text : scene.error().message);
  };
  const auto reflectance = [&](const std::string& value, const std::string& words) {
    refused(spectral(R"("reflectance": )" + value), ": /materials/a/reflectance" + words);
  };
  reflectance("[[380, 0.1], [780, -0.5]]", "/1/1: found -0.5, expected a number in [0, 1]");
  reflectance("[[380, 1.5], [780, 0.5]]", "/0/1: found 1.5, expected a number in [0, 1]");
  reflectance(R"({"from_nm": 380, "step_nm": 400, "values": [0.5, 2]})",
              "/values/1: found 2, expected a number in [0, 1]");
  reflectance("[[380, 0.1], [500, 0.1], [500, 0.2], [780, 0.5]]",
              "/2/0: found 500 after 500, expected ascending wavelengths");
  reflectance("[[780, 0.1], [380, 0.5]]", "/1/0: found 380 after 780, expected ascending wavelengths");
  reflectance("[[380, 0.1]]", ": found an array of 1 item, expected an array of 2 or more pairs");
  reflectance("[[380, 0.1], [780]]", "/1: found an array of 1 item, expected an array of 2 numbers");
  reflectance("[]", ": found an array of 0 items, expected an array of 2 or more pairs");
  reflectance("[[400, 0.1], [780, 0.5]]", ": found wavelengths from 400 to 780 nm, expected all visible ones");
  reflectance(R"({"from_nm": 380, "step_nm": 5, "values": [0.1, 0.2]})",
              ": found wavelengths from 380 to 385 nm, expected all visible ones, from 380 or less to 780 or more");
  reflectance(R"({"from_nm": 380, "values": [0.1, 0.2]})", R"(: found no key "step_nm", expected one)");
  reflectance(R"({"from_nm": 380, "step_nm": 0, "values": [0.1, 0.2]})", "/step_nm: found 0, expected a number in (0");
  reflectance("0.5", ": found 0.5, expected pairs [wavelength in nm, value], or an object with");
  for (const char* key : {R"("k_d": 0.5)", R"("k_a": 0.5)", R"("pattern": {"type": "squares"})"}) {
    refused(spectral(std::string(R"("reflectance": [[380, 0.1], [780, 0.5]], )") + key),
            R"(: /materials/a/reflectance: found "reflectance" beside ")");
  }
  reflectance("[[380, 1], [780, 1]]", ": found a reflectance whose colour by daylight is [1, 1, 1], expected");
  reflectance("[[380, 0], [520, 0], [521, 1], [540, 1], [541, 0], [780, 0]]",
              ": found a reflectance whose colour by daylight is [-");
  EXPECT_TRUE(
      holds(read_scene(folder.add("one.json", spectral(R"("reflectance": [[380, 1], [780, 1]], "rho": 0.9)"))).ok()));

  const auto light = [&](const std::string& value, const std::string& words) {
    refused(spectral(R"("k_d": 0.5)", value), ": /illuminant" + words);
  };
  light(R"("D55")", R"(: found "D55", expected "D65", "A", "sun", a temperature in [500, 1e+06] K, or a spectrum)");
  light("499", ": found 499, expected a number in [500, 1e+06]");
  light("true", R"(: found true, expected "D65", "A", "sun", a temperature in [500, 1e+06] K, or a spectrum)");
  light("[[380, 1], [780, -1]]", "/1/1: found -1, expected a number in [0, 1e+50]");
  light("[[380, 0], [780, 0]]", ": found a light of which the eye sees nothing, expected a power above 0");
  light("[[500, 1], [780, 1]]", ": found wavelengths from 500 to 780 nm, expected all visible ones");
  folder.add("lamp.json", R"({"format": "etendue-scene", "version": 1, "unit": "m", "illuminant": "A"})");
  refused(scene_of(kBall, R"("include": ["lamp.json"], )"),
          "/illuminant: found this in an included file, expected it in the main file only");
}

}  // namespace
}  // namespace etendue::validation
