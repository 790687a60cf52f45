// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/heat.hpp"

#include <cmath>
#include <string>

#include "etendue/core/rounding.hpp"
#include "etendue/radiosity/equation.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

RowMatrix matrix(Eigen::Index n, std::initializer_list<double> rows) {
  RowMatrix result(n, n);
  auto value = rows.begin();
  for (Eigen::Index k = 0; k < n * n; ++k) result.data()[k] = *value++;
  return result;
}

GreyPatch held(double emissivity, double kelvin) {
  return {emissivity, HeldAt{kelvin}};
}

/// σ as CODATA prints it; its digits end there.
constexpr double kPrintedSigma = 5.670374419e-8;
constexpr double kSigmaDigits = 5e-10 / 5.67;  // half of the last digit, relatively

// CLAIM      IU.6-7: the net flux between two surfaces that see nothing else is the textbooks': infinite parallel plates,
//            concentric spheres, coaxial cylinders, from nearly black to nearly white, at any ratio of radii.
// ORACLE     closed form: q_1 = σ (T_1⁴ − T_2⁴) / (1/ε_1 + (A_1/A_2)(1/ε_2 − 1)), A_1/A_2 = 1, (r_1/r_2)², r_1/r_2.
// TOLERANCE  the returned bound, σ as printed, and 40 roundings of the formula, whose difference of fourth powers cancels
//            where the temperatures are close: of σ T_1⁴ / (1/ε_1 + …).
TEST(Heat, ExchangesWhatTheTextbooksSayBetweenTwoSurfaces) {
  proves({"IU.6-7"}, Oracle::closed_form, "grey-body exchange between plates, spheres and cylinders");
  for (const double ratio : {1.0, 0.25, 0.81, 1e-4}) {  // A_1/A_2; the outer surface sees itself
    const DenseFactors factors(matrix(2, {0, 1, ratio, 1 - ratio}));
    for (const double first : {1.0, 0.8, 0.05}) {
      for (const double second : {1.0, 0.3, 0.001}) {
        for (const double cold : {0.0, 300.0, 999.0}) {
          const auto exchange = exchange_heat(factors, {held(first, 1000), held(second, cold)});
          ASSERT_TRUE(exchange.ok()) << exchange.error().message;
          const double resistance = 1 / first + ratio * (1 / second - 1);
          const double expected = kPrintedSigma * (std::pow(1000, 4) - std::pow(cold, 4)) / resistance;
          const double rounding = 40 * kUnitRoundoff * kPrintedSigma * std::pow(1000, 4) / resistance;
          EXPECT_TRUE(
              near(exchange->net_flux(0), expected, exchange->net_flux_bound(0) + kSigmaDigits * expected + rounding));
          EXPECT_TRUE(near(exchange->net_flux(1), -ratio * expected,
                           exchange->net_flux_bound(1) + kSigmaDigits * ratio * expected + ratio * rounding));
          EXPECT_TRUE(within(exchange->net_flux_bound(0), 1e-9 * kPrintedSigma * std::pow(1000, 4)));
        }
      }
    }
  }
}

// CLAIM      IU.6-7: a thin sheet between two plates lets the flux of two gaps in series through, and takes the temperature
//            between; n sheets of emissivity ε let 1/(n + 1) through.
// ORACLE     closed form: resistances in series.
// TOLERANCE  the returned bound, σ as printed, 60 roundings.
TEST(Heat, ShieldsStandInSeries) {
  proves({"IU.6-7"}, Oracle::closed_form, "radiation shields: resistances in series");
  // Plate, side, other side, plate: each sees its opposite only.
  const DenseFactors one(matrix(4, {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}));
  const double hot = 800, cold = 400, left = 0.9, right = 0.2;
  const auto shielded =
      exchange_heat(one, {held(0.8, hot), {left, SheetWith{2}}, {right, SheetWith{1}}, held(0.5, cold)});
  ASSERT_TRUE(shielded.ok()) << shielded.error().message;
  const double first = 1 / 0.8 + 1 / left - 1, second = 1 / right + 1 / 0.5 - 1;
  const double drive = kPrintedSigma * (std::pow(hot, 4) - std::pow(cold, 4));
  const double expected = drive / (first + second), slack = kSigmaDigits * expected + 60 * kUnitRoundoff * drive;
  EXPECT_TRUE(near(shielded->net_flux(0), expected, shielded->net_flux_bound(0) + slack));
  EXPECT_TRUE(near(shielded->net_flux(3), -expected, shielded->net_flux_bound(3) + slack));
  EXPECT_TRUE(near(shielded->net_flux(1) + shielded->net_flux(2), 0,
                   shielded->net_flux_bound(1) + shielded->net_flux_bound(2)));
  const double between = kPrintedSigma * std::pow(hot, 4) - expected * first;
  const double known = 2 * shielded->radiosity_bound.maxCoeff() / right + slack * first +
                       2 * kSigmaDigits * kPrintedSigma * std::pow(hot, 4);
  EXPECT_TRUE(near(shielded->emissive_power(1), between, known));
  EXPECT_TRUE(near(shielded->emissive_power(2), shielded->emissive_power(1), known));
  EXPECT_TRUE(near(shielded->temperature(1), std::pow(between / kPrintedSigma, 0.25), 1e-9 * hot));
}

// CLAIM      IU.6-7: the bound holds where reflections multiply every error: between plates that absorb down to a hundred-millionth.
// ORACLE     closed form: q_1 = (E_1 − E_2)/(1/ε_1 + 1/ε_2 − 1) from the emissive powers themselves.
// TOLERANCE  the returned bound, and the closed form's own roundings: 4 of E_1 in the powers, 8 of the result. The bound is worth
//            something: below 1e-6 of the flux of one plate alone, though the errors are multiplied by up to 1/ε.
TEST(Heat, BoundsWhatNearlyWhitePlatesMultiply) {
  proves({"IU.6-7"}, Oracle::closed_form, "nearly white plates: 400 pairs of emissivities");
  const DenseFactors facing(matrix(2, {0, 1, 1, 0}));
  double used = 0, loose = 0;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double first = std::pow(10, -8 + 0.37 * i), second = std::pow(10, -8 + 0.37 * j + 0.011 * i);
      const auto found = exchange_heat(facing, {held(first, 700), held(second, 300)});
      ASSERT_TRUE(found.ok()) << found.error().message;
      const double hot = found->emissive_power(0), cold = found->emissive_power(1);
      const double parts = 1 / first + 1 / second - 1, expected = (hot - cold) / parts;
      const double rounding = (4 * hot / parts + 8 * expected) * kUnitRoundoff;
      used = std::max(used, std::abs(found->net_flux(0) - expected) / (found->net_flux_bound(0) + rounding));
      loose = std::max(loose, found->net_flux_bound(0) / (first * hot));
    }
  }
  EXPECT_TRUE(within(used, 1));
  EXPECT_TRUE(within(loose, 1e-6));
}

// CLAIM      IU.6-7: the same through a thin sheet whose sides are nearly white.
// ORACLE     closed form: q_1 = (E_1 − E_4)/(1/ε_1 + 1/ε_2 − 1 + 1/ε_3 + 1/ε_4 − 1) from the emissive powers of the plates.
// TOLERANCE  the returned bounds, and the closed form's own roundings: 4 of E_1 in the powers, 12 of the result. The bound of the
//            sheet's flux is worth something: below 1e-6 of what the plate alone gives off.
TEST(Heat, BoundsWhatNearlyWhiteSheetsMultiply) {
  proves({"IU.6-7"}, Oracle::closed_form, "a nearly white sheet between plates: 144 pairs of emissivities");
  const DenseFactors one(matrix(4, {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}));
  double used = 0, loose = 0;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      const double left = std::pow(10, -7 + 0.55 * i), right = std::pow(10, -7 + 0.55 * j + 0.017 * i);
      const auto found =
          exchange_heat(one, {held(0.9, 700), {left, SheetWith{2}}, {right, SheetWith{1}}, held(0.8, 300)});
      ASSERT_TRUE(found.ok()) << found.error().message;
      const double hot = found->emissive_power(0), parts = 1 / 0.9 + 1 / left - 1 + 1 / right + 1 / 0.8 - 1;
      const double expected = (hot - found->emissive_power(3)) / parts;
      const double rounding = (4 * hot / parts + 12 * expected) * kUnitRoundoff;
      for (const Eigen::Index side : {1, 2}) {
        const double flux = side == 1 ? -expected : expected, bound = found->net_flux_bound(side);
        used = std::max(used, std::abs(found->net_flux(side) - flux) / (bound + rounding));
        loose = std::max(loose, bound / (std::min(left, right) * hot));
      }
    }
  }
  EXPECT_TRUE(within(used, 1));
  EXPECT_TRUE(within(loose, 1e-6));
}

// CLAIM      IU.6-7, IU.6-9: an insulated wall re-radiates: between two black plates and an insulated surround the exchange is
//            that of the two resistances side by side; a prescribed flux gives back the temperature that causes it.
// ORACLE     closed form: q_1 = σ (T_1⁴ − T_2⁴)(1 − F_12²)/(2 − 2 F_12) for equal plates; the first solve for the second.
// TOLERANCE  the bounds; 1e-12 of the temperature for the way back, a quarter of the relative error of σT⁴.
TEST(Heat, InsulatedWallsReRadiate) {
  proves({"IU.6-7", "IU.6-9"}, Oracle::closed_form, "two black plates and a re-radiating surround");
  constexpr double kSeen = 0.2;  // F_12 = F_21; the surround has twice the area: F_3i = (1 − kSeen)/2
  const double rest = 1 - kSeen;
  const DenseFactors factors(matrix(3, {0, kSeen, rest, kSeen, 0, rest, rest / 2, rest / 2, kSeen}));
  const GreyPatch insulated{0.3, NetFlux{0}};
  const auto exchange = exchange_heat(factors, {held(1, 600), held(1, 500), insulated});
  ASSERT_TRUE(exchange.ok()) << exchange.error().message;
  const double drive = kPrintedSigma * (std::pow(600, 4) - std::pow(500, 4));
  const double expected = drive * (1 - kSeen * kSeen) / (2 - 2 * kSeen);
  EXPECT_TRUE(near(exchange->net_flux(0), expected,
                   exchange->net_flux_bound(0) + kSigmaDigits * expected + 60 * kUnitRoundoff * drive * 10));
  EXPECT_TRUE(near(exchange->net_flux(2), 0, 0));
  // Of grey walls the other way round: the flux that 600 K cause, prescribed.
  const auto grey = exchange_heat(factors, {held(0.7, 600), held(0.4, 500), insulated});
  const auto back = exchange_heat(factors, {{0.7, NetFlux{grey->net_flux(0)}}, held(0.4, 500), insulated});
  ASSERT_TRUE(grey.ok() && back.ok());
  EXPECT_TRUE(near(back->temperature(0), 600, 1e-12 * 600));
  EXPECT_TRUE(near(back->net_flux(1), grey->net_flux(1), back->net_flux_bound(1) + grey->net_flux_bound(1)));
}

// CLAIM      IU.6-6, IU.6-7: Gebhart factors of a closed enclosure sum to one, keep reciprocity ε_i A_i G_ij = ε_j A_j G_ji, and
//            give the net fluxes of the radiosities; all grey patches of one temperature exchange nothing.
// ORACLE     identities: everything emitted is absorbed; exchange both ways balances.
// TOLERANCE  the returned bounds, and rounding of sums of three.
TEST(Heat, GebhartFactorsAgreeWithRadiosities) {
  proves({"IU.6-6", "IU.6-7"}, Oracle::identity, "conservation, reciprocity, the other route to the flux");
  const Eigen::Vector3d areas(3, 4, 5), emissivity(0.9, 0.1, 0.5), kelvin(700, 400, 550);
  const DenseFactors factors(matrix(3, {0, 1. / 3, 2. / 3, 0.25, 0, 0.75, 0.4, 0.6, 0}));
  const auto gebhart = gebhart_factors(factors, emissivity);
  ASSERT_TRUE(gebhart.ok()) << gebhart.error().message;
  std::vector<GreyPatch> patches, even;
  for (int i = 0; i < 3; ++i) {
    patches.push_back(held(emissivity(i), kelvin(i)));
    even.push_back(held(emissivity(i), 500));
  }
  const auto exchange = exchange_heat(factors, patches), nothing = exchange_heat(factors, even);
  ASSERT_TRUE(exchange.ok() && nothing.ok());
  const double bound = gebhart->bound + gamma_bound(8);
  EXPECT_TRUE(within(gebhart->bound, 1e-14));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(near(gebhart->factors.row(i).sum(), 1, 3 * bound + 1 / 0.1 * gamma_bound(8)));
    double power = areas(i) * emissivity(i) * emissive_power(kelvin(i)), size = power;
    for (int j = 0; j < 3; ++j) {
      const double emitted = areas(j) * emissivity(j) * emissive_power(kelvin(j));
      power -= emitted * gebhart->factors(j, i);
      size += emitted;
      EXPECT_TRUE(near(emissivity(i) * areas(i) * gebhart->factors(i, j),
                       emissivity(j) * areas(j) * gebhart->factors(j, i), 10 * bound + 10 * gamma_bound(8)));
    }
    EXPECT_TRUE(near(power / areas(i), exchange->net_flux(i), exchange->net_flux_bound(i) + size * bound));
    // Row sums are one but for a rounding each, so what is exchanged is the rounding of σT⁴.
    EXPECT_TRUE(near(nothing->net_flux(i), 0, nothing->net_flux_bound(i) + gamma_bound(40) * emissive_power(500)));
  }
}

// CLAIM      IU.6-5, IU.6-6: an environment closes an open enclosure: rows sum to one, the way back is reciprocal, and a black
//            environment at T gives patches the same as openings to which σT⁴ is added; at 0 K nothing changes.
// ORACLE     identity: H_i = Σ_j F_ij J_j + (1 − Σ_j F_ij) σT⁴ by hand for one convex patch: q = ε σ (T_1⁴ − T⁴).
// TOLERANCE  the returned bounds, rounding of sums of three.
TEST(Heat, AnEnvironmentClosesWhatIsOpen) {
  proves({"IU.6-5", "IU.6-6"}, Oracle::identity, "closure and reciprocity; a body in large surroundings");
  // Two plates that see a fifth of each other.
  const DenseFactors open(matrix(2, {0, 0.2, 0.4, 0}));
  const Eigen::Vector2d areas(2, 1);
  for (const double size : {0.0, 2.2, 100.0}) {
    const auto closed = closed_by(size, open, areas);
    ASSERT_TRUE(closed.ok()) << closed.error().message;
    EXPECT_TRUE(near(closed->areas(2), std::max(size, 2.2), gamma_bound(8) * 3));
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(near(closed->factors.row(i).sum(), 1, gamma_bound(12)));
      for (int j = 0; j < 3; ++j) {
        EXPECT_TRUE(near(closed->areas(i) * closed->factors(i, j), closed->areas(j) * closed->factors(j, i),
                         gamma_bound(12) * closed->areas(2)));
      }
    }
    const std::vector<GreyPatch> plates{held(0.6, 500), held(0.3, 400)};
    std::vector<GreyPatch> in_space = plates, in_room = plates;
    in_space.push_back(held(1, 0));
    in_room.push_back(held(1, 400));
    const auto alone = exchange_heat(open, plates), space = exchange_heat(DenseFactors(closed->factors), in_space);
    const auto room = exchange_heat(DenseFactors(closed->factors), in_room);
    ASSERT_TRUE(alone.ok() && space.ok() && room.ok());
    for (int i = 0; i < 2; ++i) {
      EXPECT_TRUE(near(space->net_flux(i), alone->net_flux(i), space->net_flux_bound(i) + alone->net_flux_bound(i)));
    }
    EXPECT_TRUE(holds(room->net_flux(0) > 0 && room->net_flux(0) < space->net_flux(0)));
  }
  const Eigen::VectorXd area = Eigen::VectorXd::Constant(1, 3);
  const auto body = closed_by(1e6, DenseFactors(matrix(1, {0})), area);
  const auto exchange = exchange_heat(DenseFactors(body->factors), {held(0.7, 350), held(1, 290)});
  const double expected = 0.7 * kPrintedSigma * (std::pow(350, 4) - std::pow(290, 4));
  EXPECT_TRUE(near(exchange->net_flux(0), expected, exchange->net_flux_bound(0) + 4 * kSigmaDigits * expected));
}

// CLAIM      IU.6-9: what has no answer is refused by name: fluxes only, fluxes that no temperature emits, emissivities,
//            temperatures and sheets that are none, factors that are not.
// ORACLE     identity: data with one defect each.
// TOLERANCE  none.
TEST(Heat, RefusesWhatHasNoAnswer) {
  proves({"IU.6-9"}, Oracle::identity, "data with one defect each");
  const DenseFactors plates(matrix(2, {0, 1, 1, 0}));
  const auto refused = [](const DenseFactors& factors, const std::vector<GreyPatch>& patches, const std::string& words,
                          ErrorCode code = ErrorCode::invalid_input) {
    const auto exchange = exchange_heat(factors, patches);
    ASSERT_FALSE(exchange.ok()) << words;
    EXPECT_TRUE(holds(exchange.error().code == code)) << words;
    EXPECT_TRUE(holds(exchange.error().message.find(words) != std::string::npos)) << exchange.error().message;
  };
  const GreyPatch warm{0.5, NetFlux{10}}, fine = held(0.5, 300);
  refused(plates, {warm, warm}, "do not determine", ErrorCode::not_converged);
  refused(plates, {fine, {0.5, NetFlux{-1e9}}}, "patch 1: a net flux of -1e+09 W/m² draws more than arrives");
  refused(plates, {fine, held(0, 300)}, "patch 1: emissivity 0 is not in (0, 1]");
  refused(plates, {held(1.5, 300), fine}, "patch 0: emissivity 1.5");
  refused(plates, {held(std::nan(""), 300), fine}, "patch 0: emissivity nan");
  refused(plates, {fine, held(0.5, -1)}, "patch 1: temperature -1 K");
  refused(plates, {fine, held(0.5, std::nan(""))}, "patch 1: temperature nan");
  refused(plates, {fine, {0.5, NetFlux{std::nan("")}}}, "patch 1: net flux nan");
  refused(plates, {fine, {0.5, SheetWith{0}}}, "patch 1: the other side of its sheet");
  refused(plates, {fine, {0.5, SheetWith{7}}}, "patch 1: the other side of its sheet");
  refused(plates, {fine}, "F is 2 × 2 and there are 1 patches");
  refused(DenseFactors(matrix(2, {0, 1.5, 1, 0})), {fine, fine}, "F(0, 1) = 1.5");
  refused(DenseFactors(matrix(2, {0.7, 0.7, 1, 0})), {fine, fine}, "row 0 sums to 1.4");
  refused(plates, {fine, held(0.5, 1e80)}, "patch 1: temperature 1e+80 K: its emissive power overflows");
  EXPECT_TRUE(holds(!gebhart_factors(DenseFactors(matrix(2, {0.7, 0.7, 1, 0})), Eigen::Vector2d(1, 1)).ok()));
  // Insulated, and all that it sees is at 0 K: that is its temperature, however the sums round.
  const DenseFactors thirds(matrix(3, {0, 1. / 3, 2. / 3, 0.1, 0, 0.9, 0.3, 0.7, 0}));
  const auto cold = exchange_heat(thirds, {held(0.1, 0), held(0.3, 0), {0.7, NetFlux{0}}});
  ASSERT_TRUE(cold.ok()) << cold.error().message;
  EXPECT_TRUE(near(cold->temperature(2), 0, 0));
  EXPECT_TRUE(holds(!gebhart_factors(plates, Eigen::Vector2d(0.5, 0)).ok()));
  EXPECT_TRUE(holds(!closed_by(1, DenseFactors(matrix(2, {0.5, 1, 1, 0})), Eigen::Vector2d(1, 1)).ok()));
  EXPECT_TRUE(holds(!closed_by(1, plates, Eigen::Vector2d(1, 0)).ok()));
}

}  // namespace
}  // namespace etendue::validation
