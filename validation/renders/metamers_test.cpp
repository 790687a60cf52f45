// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "etendue/io/scene_reader.hpp"
#include "etendue/optics/illuminants.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/view/shaded_view.hpp"
#include "optics/direct_colour.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/scene_builder.hpp"

// Pictures by wavelengths: surfaces that daylight cannot tell apart, and lamps that can.
namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

Rgb seen_along(const Ray& ray, const Scene& scene, int wavelengths) {
  RenderOptions options;
  options.wavelengths = wavelengths;
  return see(ray, *make_accelerator(scene, AcceleratorKind::brute_force), options, {}).colour;
}

/// A floor seen and lit from straight above.
Scene floor_of(const Material& material) {
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, material);
  scene.lights.emplace_back(DirectionalLight{{0, 0, 1}, Rgb(0.75, 0.5, 1)});
  scene.ambient = Rgb::Constant(0.25);
  return scene;
}
const Ray kFromAbove{Vec3(0.25, 0.5, 2), Vec3(0, 0, -1)};

Illuminant lamp() {
  return illuminant(through_table(incandescent_a()));
}
Illuminant day() {
  return illuminant(through_table(daylight_d65()));
}

// CLAIM      IU.2.9b: a pixel traced at N wavelengths is the sum over them of reflectance, light and observer, in the monitor's RGB,
//            times the colours of the lights: at the table's 81 wavelengths, and at each third of them.
// ORACLE     closed form: the sum in extended precision, with a matrix from the primaries; N·L = 1.
// TOLERANCE  direct_colour()'s bound, of twice as many sums and three more factors: twice that.
TEST(SpectralPixel, IsTheSumOverWavelengths) {
  proves({"IU.2.9b"}, Oracle::closed_form, "sums over the CIE's table in extended precision");
  for (int kind = 0; kind < 6; ++kind) {
    const auto reflectance = [&](long double at) -> long double {
      return 0.5 + 0.5 * std::sin(static_cast<double>(at) / (9 + 5 * kind));
    };
    Material material;
    material.reflectance.emplace();
    for (int at = 380; at <= 780; at += 5)
      material.reflectance->points.push_back({static_cast<double>(at), static_cast<double>(reflectance(at))});
    Scene scene = floor_of(material);
    for (const bool incandescent : {false, true}) {
      scene.illuminant = incandescent ? lamp() : day();
      for (const int wavelengths : {81, 27}) {
        const DirectColour expected = direct_colour(reflectance, incandescent ? incandescent_light : daylight_light,
                                                    static_cast<std::size_t>(81 / wavelengths));
        const Rgb seen = seen_along(kFromAbove, scene, wavelengths);
        for (int c = 0; c < 3; ++c) {
          const double light = 0.25 + std::get<DirectionalLight>(scene.lights[0]).intensity[c];
          EXPECT_TRUE(near(seen[c], light * static_cast<double>(expected.value[c]),
                           2 * light * static_cast<double>(expected.bound[c])));
        }
      }
    }
  }
}

// CLAIM      What has no spectrum looks the same with three channels and by wavelengths, by daylight as with no light named, and by
//            another light in its white; a grey reflectance is that grey, to a rounding per wavelength.
// ORACLE     identity: the same ray without wavelengths, and without an illuminant.
// TOLERANCE  none; of the grey by wavelengths 8 N u, the weights' (with an absolute sum below 2).
TEST(SpectralPixel, LeavesColoursOfThreeChannelsAlone) {
  proves({"IU.2.9", "IU.2.9b"}, Oracle::identity, "the same ray without wavelengths");
  Material red;
  red.k_d = red.k_a = {0.75, 0.25, 0.125};
  Scene scene = floor_of(red);
  const Rgb plain = seen_along(kFromAbove, scene, 0);
  for (const auto& light : {day(), lamp()}) {
    scene.illuminant = light;
    for (const int wavelengths : {0, 7, 81})
      EXPECT_TRUE(holds((seen_along(kFromAbove, scene, wavelengths) == light.white * plain).all()));
  }
  scene.illuminant = day();
  EXPECT_TRUE(holds((seen_along(kFromAbove, scene, 81) == plain).all()));
  Material grey = diffuse(0.5);
  const Rgb expected = seen_along(kFromAbove, floor_of(grey), 0);
  grey.reflectance = Spectrum{{{380, 0.5}, {780, 0.5}}};
  Scene spectral = floor_of(grey);
  spectral.illuminant = day();
  for (const int wavelengths : {1, 7, 81}) {
    const Rgb seen = seen_along(kFromAbove, spectral, wavelengths);
    EXPECT_TRUE(within((seen - expected).abs().maxCoeff(), 8 * (wavelengths + 4) * u));
  }
}

// CLAIM      Pictures of three channels show a light as its white, by rasteriser as by rays.
// ORACLE     identity: the picture without an illuminant, times the white.
// TOLERANCE  two roundings.
TEST(SpectralPixel, IsWhiteOfTheLightInRasterisedPictures) {
  proves({"IU.2.9"}, Oracle::identity, "the same picture without an illuminant");
  Scene scene;
  scene.camera = straight(16, 12);
  scene.background = {0.25, 0.5, 0.75};
  scene.ambient = Rgb::Constant(0.3);
  add(scene, Sphere{{0, 0, 4}, 1.5}, diffuse(0.7));
  const auto picture = [&] { return view_shaded(scene, {}, {}).value().image; };
  const Image plain = picture();
  scene.illuminant = lamp();
  const Image warm = picture();
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 16; ++column) {
      const Rgb expected = scene.illuminant->white * plain.at(column, row);
      EXPECT_TRUE(within((warm.at(column, row) - expected).abs().maxCoeff(), 4 * u));
    }
  }
}

/// Two balls, one of which reflects by wavelength, behind a glass ball that does not; a triangle that does lies before all.
Scene spectral_balls() {
  Scene scene;
  scene.camera = straight(48, 36);
  scene.background = {0.25, 0.5, 0.75};
  scene.ambient = Rgb::Constant(0.25);
  scene.lights.emplace_back(DirectionalLight{Vec3(1, 2, -2).normalized(), Rgb(0.75, 0.5, 1)});
  Material waves = diffuse(0.4);
  waves.reflectance = Spectrum{{{380, 0.1}, {500, 0.7}, {580, 0.05}, {640, 0.7}, {780, 0.2}}};
  add(scene, Sphere{{-1, 0, 5}, 1}, waves);
  add(scene, Sphere{{1, 0, 5}, 1}, diffuse(0.4));
  Material glass = diffuse(0.2);
  glass.see_through = TransparencyLaw{{0.5, 0.5}, 1};
  add(scene, Sphere{{0, 0.5, 3}, 0.4}, glass);
  waves.see_through = glass.see_through;
  add(scene, Triangle{{0.4, -0.8, 2.5}, {1, -0.8, 2.5}, {0.4, -0.3, 2.5}}, waves);
  return scene;
}

// CLAIM      IU.2.9b: a rasterised picture at N wavelengths is the sum of pictures at each, in every way of shading; seen through glass and as
//            glass, too. Pixels that show no reflectance are those of three channels, to the bit.
// ORACLE     metamorphic, linearity: pictures of scenes whose grey is the reflectance at one wavelength, added up with the weights of the CIE's
//            table. The local model is linear in k_d and k_a, wherever these are interpolated.
// TOLERANCE  a picture's own roundings, some 30 u of at most 1, times the absolute sum of the weights, below 3 for N = 9; 4 N u for
//            the sum. Mixed pixels have both kinds of samples, and white for each: the weights sum to 1 by daylight.
TEST(SpectralPicture, IsTheSumOfRasterisedPictures) {
  proves({"IU.2.9b"}, Oracle::metamorphic, "pictures in one grey each, added up");
  constexpr int kWavelengths = 9;
  const Scene scene = spectral_balls();
  auto samples = lit(even_wavelengths(kWavelengths), day());
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong, Shading::dot}) {
    ShadingOptions options;
    options.shading = shading;
    const auto picture = [&](const Scene& shown) { return view_shaded(shown, options).value().image; };
    const Image plain = picture(scene);
    Image sum(plain.columns, plain.rows);
    for (const WavelengthSample& sample : samples) {
      Scene grey = scene;
      for (Material& material : grey.materials) {
        if (material.reflectance)
          material.k_d = material.k_a = Rgb::Constant(material.reflectance->at(sample.wavelength));
      }
      const Image one = picture(grey);
      for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += sample.weight * one.pixels[i];
    }
    Scene lit_scene = scene;
    lit_scene.illuminant = day();
    options.wavelengths = kWavelengths;
    const Image seen = picture(lit_scene);
    std::uint64_t same = 0, apart = 0;
    double worst = 0;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
      worst = std::max(worst, (seen.pixels[i] - sum.pixels[i]).abs().maxCoeff());
      same += (seen.pixels[i] == plain.pixels[i]).all() ? 1u : 0u;
      apart += (seen.pixels[i] - plain.pixels[i]).abs().maxCoeff() > 0.02 ? 1u : 0u;
    }
    EXPECT_TRUE(within(worst, (3 * 30 + 4 * kWavelengths) * u));
    EXPECT_TRUE(holds(same > 1000 && apart > 50)) << same << ' ' << apart;
  }
}

// CLAIM      IU.2.9b: by rasteriser the shipped pair is what it is by rays: one colour by daylight, two by incandescent light.
// ORACLE     another method: the ray tracer, at the middle of each half, where no shadow falls.
// TOLERANCE  the normal of a polygon of the net is the square's own; some 20 roundings for each of 81 wavelengths.
TEST(MetamericPair, IsRasterisedAsItIsTraced) {
  proves({"IU.2.9b"}, Oracle::program, "rays through the same pixels");
  for (const char* file : {"scene.json", "incandescent.json"}) {
    Scene scene = read_scene(source_root() / "scenes/metamers" / file).value().scene;
    scene.camera.columns /= 8;
    scene.camera.rows /= 8;
    RenderOptions rays;
    rays.sampling.samples_per_side = 1;
    rays.facts = {PictureFact::object};
    ShadingOptions shading;
    shading.samples = 1;
    rays.wavelengths = shading.wavelengths = 81;
    rays.shadows.kind = ShadowKind::opaque;
    const auto traced = render(*make_accelerator(scene, AcceleratorKind::bounding_volumes), rays, {});
    const auto drawn = view_shaded(scene, shading);
    ASSERT_TRUE(traced.ok() && drawn.ok());
    std::uint64_t square = 0, unlike = 0;
    for (std::size_t i = 0; i < traced->image.pixels.size(); ++i) {
      const auto object = static_cast<int>(traced->facts[0].pixels[i][0]);
      if (object < 0 || !std::holds_alternative<Polygon>(scene.objects[static_cast<std::size_t>(object)].shape))
        continue;
      if (!scene.materials[scene.objects[static_cast<std::size_t>(object)].material].reflectance) continue;
      ++square;
      unlike += (traced->image.pixels[i] - drawn->image.pixels[i]).abs().maxCoeff() > 20 * 81 * u ? 1u : 0u;
    }
    EXPECT_GT(square, 100u);
    EXPECT_TRUE(all_agree(unlike, square));
  }
}

struct Halves {
  Rgb even, waves;
};

/// What the camera sees of the middle of each half of the square in scenes/metamers.
Halves halves(const Scene& scene, int wavelengths) {
  const auto towards = [&](const Vec3& point) {
    return seen_along({scene.camera.eye, (point - scene.camera.eye).normalized()}, scene, wavelengths);
  };
  return {towards({-2.25, 0, 1}), towards({-0.75, 0, 1})};
}

const Material& named(const Scene& scene, const char* name) {
  for (const Material& material : scene.materials) {
    if (material.name == name) return material;
  }
  throw std::runtime_error(name);
}

// CLAIM      IU.2.9b: of the shipped pair daylight shows one colour, at 81 wavelengths and with three channels; incandescent light
//            shows two at 81 wavelengths, as far apart as the sums say and by more than 0.05 of the white, and one with three.
// ORACLE     closed form: the sums over the numbers in the scene's file, in extended precision, times ambient and Lambert's light.
// TOLERANCE  twice direct_colour()'s bound for each; the pair's numbers have 16 decimals, which is less.
TEST(MetamericPair, IsOneColourByDaylightAndTwoByIncandescentLight) {
  proves({"IU.2.9b"}, Oracle::closed_form, "sums over the shipped numbers in extended precision");
  for (const bool incandescent : {false, true}) {
    const char* file = incandescent ? "incandescent.json" : "scene.json";
    const Scene scene = read_scene(source_root() / "scenes/metamers" / file).value().scene;
    const auto reflectance = [&](const char* name) -> ByWavelength {
      const Spectrum spectrum = *named(scene, name).reflectance;
      return [=](long double at) -> long double { return spectrum.at(static_cast<double>(at)); };
    };
    const ByWavelength power = incandescent ? incandescent_light : daylight_light;
    const DirectColour even = direct_colour(reflectance("even"), power);
    const DirectColour waves = direct_colour(reflectance("waves"), power);
    const auto& light = std::get<DirectionalLight>(scene.lights.at(0));
    const double cosine = light.direction.dot(Vec3(0, -1, 0));
    const Halves seen = halves(scene, 81), flat = halves(scene, 0);
    for (int c = 0; c < 3; ++c) {
      const double lit = scene.ambient[c] + cosine * light.intensity[c];
      const double bound = 2 * lit * static_cast<double>(even.bound[c] + waves.bound[c]);
      EXPECT_TRUE(near(seen.even[c], lit * static_cast<double>(even.value[c]), bound));
      EXPECT_TRUE(near(seen.waves[c], lit * static_cast<double>(waves.value[c]), bound));
      EXPECT_TRUE(near(flat.even[c], flat.waves[c], bound)) << "three channels know one colour";
      EXPECT_TRUE(incandescent || near(seen.even[c], seen.waves[c], bound));
    }
    if (!incandescent) continue;
    EXPECT_TRUE(holds(static_cast<double>(waves.value[0] - even.value[0]) > 0.05 * scene.illuminant->white[0]));
    EXPECT_TRUE(holds(static_cast<double>(even.value[1] - waves.value[1]) > 0.05 * scene.illuminant->white[1]));
  }
}

// CLAIM      With other numbers of wavelengths daylight shows the pair apart by what its page says.
// ORACLE     table: scenes/metamers/README.md, whose numbers are sums written in Python.
// TOLERANCE  half of the last printed digit.
TEST(MetamericPair, IsApartByAsMuchAsItsPageSays) {
  proves({"IU.2.9b"}, Oracle::table, "numbers of scenes/metamers/README.md, sums written in Python");
  const Scene scene = read_scene(source_root() / "scenes/metamers/scene.json").value().scene;
  struct Row {
    int wavelengths;
    double apart, digit;
  };
  for (const Row& row : {Row{9, 0.063, 1e-3}, Row{16, 0.012, 1e-3}, Row{32, 0.0005, 1e-4}, Row{64, 0.0012, 1e-4},
                         Row{401, 0.0008, 1e-4}}) {
    const Halves seen = halves(scene, row.wavelengths);
    const double white = seen.even[1] / 0.4;
    EXPECT_TRUE(near((seen.waves - seen.even).abs().maxCoeff() / white, row.apart, row.digit / 2));
  }
}

}  // namespace
}  // namespace etendue::validation
