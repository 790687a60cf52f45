// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/reflectance/overflow.hpp"
#include "etendue/reflectance/transparency.hpp"
#include "optics/incidence.hpp"
#include "reflectance/colour.hpp"
#include "support/evidence.hpp"

// What happens to intensities before they are shown: three treatments of overflow, and seeing through clear objects.
namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

Rgb draw(Directions& random, double greatest) {
  const double red = random.uniform(0, greatest), green = random.uniform(0, greatest);
  return {red, green, random.uniform(0, greatest)};
}

// CLAIM      IU.2.8, IU.2.9: every treatment leaves alone what fits, and brings the rest into [0, 1].
// ORACLE     identity: the definitions; bit by bit for what fits.
// TOLERANCE  none.
TEST(Overflow, IsTreatedOnlyWhereThereIsAny) {
  proves({"IU.2.8", "IU.2.9"}, Oracle::identity, "what fits stays, the rest fits afterwards");
  Directions random(2701);
  std::vector<Rgb> fitting, overflowing;
  for (int i = 0; i < 1000; ++i) {
    fitting.push_back(draw(random, 1));
    overflowing.push_back(draw(random, 5));
  }
  std::uint64_t mismatches = 0;
  const std::vector<Rgb> kept = scale_image(fitting), scaled = scale_image(overflowing);
  for (std::size_t i = 0; i < fitting.size(); ++i) {
    mismatches += (clamp(fitting[i]) != fitting[i]).any() ? 1U : 0U;
    mismatches += (scale_pixel(fitting[i]) != fitting[i]).any() ? 1U : 0U;
    mismatches += (kept[i] != fitting[i]).any() ? 1U : 0U;
    for (const Rgb& result : {clamp(overflowing[i]), scale_pixel(overflowing[i]), scaled[i]})
      mismatches += (result >= 0).all() && (result <= 1).all() ? 0U : 1U;
  }
  EXPECT_TRUE(all_agree(mismatches, 6000));
}

// CLAIM      IU.2.8: scaling the image by its maximum keeps the ratios between all its values; limiting each value
//            does not, and flattens a slope into a band: on a linear ramp it makes a kink of the full slope, scaling
//            makes none.
// ORACLE     identity: second differences of a linear ramp vanish; dyadic ramp.
// TOLERANCE  2 u for the roundings of scaled values below one; the kink of the limited ramp exactly.
TEST(Overflow, ScalingTheImageMakesNoMachBand) {
  proves({"IU.2.8"}, Oracle::identity, "second differences of a linear ramp");
  const double slope = 0x1p-4;
  std::vector<Rgb> ramp;
  for (int i = 0; i <= 24; ++i) ramp.push_back(Rgb::Constant(slope * i));  // up to 1.5
  const std::vector<Rgb> scaled = scale_image(ramp);
  double limited_kink = 0;
  for (std::size_t i = 1; i + 1 < ramp.size(); ++i) {
    const auto kink = [](const Rgb& a, const Rgb& b, const Rgb& c) { return (a - 2 * b + c).abs().maxCoeff(); };
    EXPECT_TRUE(within(kink(scaled[i - 1], scaled[i], scaled[i + 1]), 2 * u));
    limited_kink = std::max(limited_kink, kink(clamp(ramp[i - 1]), clamp(ramp[i]), clamp(ramp[i + 1])));
  }
  EXPECT_TRUE(near(limited_kink, slope, 0));
  EXPECT_TRUE(near(scaled.back().x(), 1, 0));
}

// CLAIM      IU.2.9: dividing a pixel by its largest channel keeps hue and saturation and changes the brightness;
//            limiting changes the hue.
// ORACLE     identity: hue and saturation are functions of the ratios between channels; dyadic example.
// TOLERANCE  none for the example; two roundings for the ratios.
TEST(Overflow, ScalingAPixelKeepsHueAndSaturation) {
  proves({"IU.2.9"}, Oracle::identity, "ratios between channels");
  EXPECT_TRUE(within(difference(scale_pixel(Rgb(2, 1, 0.5)), Rgb(1, 0.5, 0.25)), 0));
  EXPECT_TRUE(within(difference(clamp(Rgb(2, 1, 0.5)), Rgb(1, 1, 0.5)), 0));  // orange becomes yellow
  Directions random(2702);
  for (int i = 0; i < 1000; ++i) {
    const Rgb pixel = draw(random, 5) + 0.1, scaled = scale_pixel(pixel);
    EXPECT_TRUE(within(difference(scaled / scaled.maxCoeff(), pixel / pixel.maxCoeff()), 3 * u));
  }
}

// CLAIM      IU.2.8: negative and undefined intensities are refused, not scaled.
// ORACLE     identity: the documented domain.
// TOLERANCE  none.
TEST(Overflow, RefusesWhatIsNoIntensity) {
  proves({"IU.2.8"}, Oracle::identity, "the documented domain");
  const Rgb negative(0, -1, 0), undefined(std::nan(""), 0, 0), infinite(0, 0, INFINITY);
  unsigned mismatches = accepted([&] { return clamp(undefined); });
  for (const Rgb& value : {negative, undefined, infinite}) {
    mismatches += accepted([&] { return scale_pixel(value); });
    mismatches += accepted([&] { return scale_image(std::vector<Rgb>{value}); });
  }
  EXPECT_TRUE(all_agree(mismatches, 7));
}

// CLAIM      IU.4.4b: transparency goes from t_min at the silhouette to t_max head-on, linearly or as 1 − (1 −
//            n_z)^m; it rises with n_z; m = 1 is the linear form, and for m = 2 and 3 the polynomial.
// ORACLE     closed form: the polynomials written out.
// TOLERANCE  3.1 u linear, (6 + m) u else, and 6 u for the polynomial of the check.
TEST(Transparency, FallsTowardsTheSilhouette) {
  proves({"IU.4.4b"}, Oracle::closed_form, "polynomials in n_z");
  Directions random(2703);
  for (int i = 0; i < 5000; ++i) {
    const double a = random.uniform(0, 1), b = random.uniform(0, 1), z = random.uniform(0, 1);
    const TransparencyRange range{std::min(a, b), std::max(a, b)};
    const double span = range.greatest - range.least;
    EXPECT_TRUE(near(transparency(z, range), range.least * (1 - z) + range.greatest * z, 9.1 * u));
    EXPECT_TRUE(near(transparency(z, range, 1), transparency(z, range), 10.1 * u));
    EXPECT_TRUE(near(transparency(z, range, 2), range.least + span * z * (2 - z), 14 * u));
    EXPECT_TRUE(near(transparency(z, range, 3), range.least + span * z * (3 - z * (3 - z)), 15 * u));
    for (const double m : {1.0, 2.0, 3.0}) {
      EXPECT_TRUE(near(transparency(0, range, m), range.least, 0));
      EXPECT_TRUE(near(transparency(1, range, m), range.greatest, u));
      EXPECT_GE(transparency(std::min(1.0, z + 0.01), range, m), transparency(z, range, m));
    }
  }
}

// CLAIM      IU.4.4a, E4: used as printed, t I_f + (1 − t) I_b with the t of the vase lets 0.8 through at the
//            silhouette and 0.1 in the middle, for t_min = 0.2, t_max = 0.9: reversed. Mended: 0.2 and 0.9.
// ORACLE     closed form: a black front before a white back shows what passes.
// TOLERANCE  u for the printed differences; 3.1 u of see_through() and 3.1 u of transparency().
TEST(Transparency, IsNotOpacity) {
  proves({"E4", "IU.4.4a", "IU.4.4b"}, Oracle::closed_form, "a black front before a white back");
  const TransparencyRange vase{0.2, 0.9};
  const Rgb black = Rgb::Zero(), white = Rgb::Ones();
  const auto printed = [](double t) { return 1 - t; };
  EXPECT_TRUE(near(printed(transparency(0, vase)), 0.8, u));
  EXPECT_TRUE(near(printed(transparency(1, vase)), 0.1, 2 * u));
  EXPECT_TRUE(within(difference(see_through(black, white, transparency(0, vase)), Rgb::Constant(0.2)), 6.2 * u));
  EXPECT_TRUE(within(difference(see_through(black, white, transparency(1, vase)), Rgb::Constant(0.9)), 6.2 * u));
}

// CLAIM      IU.4.4a, E4: the transparency that counts is the front's: a perfectly clear front (t = 1) shows the back, an
//            opaque one (t = 0) hides it; as printed, the two change places.
// ORACLE     exact: dyadic mixtures.
// TOLERANCE  none.
TEST(Transparency, IsThatOfTheFrontObject) {
  proves({"E4", "IU.4.4a"}, Oracle::exact, "dyadic mixtures");
  const Rgb front(1, 0.5, 0), back(0, 0.25, 1);
  const double clear = 1, opaque = 0;
  const auto printed = [&](double t) -> Rgb { return t * front + (1 - t) * back; };
  EXPECT_TRUE(apart(difference(printed(clear), back), 0, 0.25));
  EXPECT_TRUE(apart(difference(printed(opaque), front), 0, 0.25));
  EXPECT_TRUE(within(difference(see_through(front, back, clear), back), 0));
  EXPECT_TRUE(within(difference(see_through(front, back, opaque), front), 0));
  EXPECT_TRUE(within(difference(see_through(front, back, 0.25), Rgb(0.75, 0.4375, 0.25)), 0));
}

// CLAIM      IU.4.4a, IU.4.4b: the contracts are enforced.
// ORACLE     identity: the documented domain.
// TOLERANCE  none.
TEST(Transparency, RefusesWhatIsNotInItsDomain) {
  proves({"IU.4.4a", "IU.4.4b"}, Oracle::identity, "the documented domain");
  const auto at = [](double z, double least, double greatest, double m) {
    return accepted([=] { return transparency(z, TransparencyRange{least, greatest}, m); });
  };
  EXPECT_TRUE(all_agree(at(-0.1, 0, 1, 2) + at(1.1, 0, 1, 2) + at(0.5, 0.9, 0.2, 2) + at(0.5, -0.1, 1, 2) +
                            at(0.5, 0, 1.1, 2) + at(0.5, 0, 1, 0.5) + at(std::nan(""), 0, 1, 2),
                        7));
  EXPECT_TRUE(all_agree(accepted([] { return see_through(Rgb::Zero(), Rgb::Zero(), 1.5); }), 1));
}

// CLAIM      transparencies run anywhere from 0 to 1, both included.
// ORACLE     identity: the ends of the ranges.
// TOLERANCE  none.
TEST(Transparency, RunsFromNothingToAll) {
  proves({}, Oracle::identity, "ranges at the ends of the domain");
  const TransparencyRange all{0, 1}, half{0.5, 0.5};
  EXPECT_TRUE(holds(transparency(0, all) == 0 && transparency(1, all) == 1 && transparency(0.5, half) == 0.5));
}

}  // namespace
}  // namespace etendue::validation
