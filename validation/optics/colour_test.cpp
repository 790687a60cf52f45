// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/colour.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/optics/dispersion.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

const std::vector<double> kEqualEnergy(kTableLength, 1);

// CLAIM      IU.2.9b: the observer's table is the CIE's: its columns have the published sums, and it is linear in between.
// ORACLE     table: CIE 15:2004, T.4, the sums printed below it and some rows.
// TOLERANCE  sums of 81 numbers of six decimals: 81 roundings of at most 22; rows exact.
TEST(Observer, HasThePublishedSums) {
  proves({"IU.2.9b"}, Oracle::table, "the sums of x̄, ȳ, z̄ in CIE 15:2004, table T.4");
  const Xyz sums = tristimulus(kEqualEnergy) / kTableStep;
  const double published[3] = {21.371524, 21.371327, 21.371540};
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(near(sums[k], published[k], 83 * u * 22));
  EXPECT_TRUE(holds((observer(555) == Xyz(0.512050, 1, 0.005750)).all()));
  EXPECT_TRUE(holds((observer(380) == Xyz(0.001368, 0.000039, 0.006450)).all()));
  EXPECT_TRUE(holds((observer(780) == Xyz(0.000042, 0.000015, 0)).all()));
  EXPECT_TRUE(near(observer(557.5)[1], 0.9975, 4 * u));
  EXPECT_TRUE(holds((observer(379.9) == 0).all() && (observer(780.1) == 0).all()));
  EXPECT_TRUE(refuses([] { (void)tristimulus(std::vector<double>(80, 1)); }));
}

// CLAIM      IU.2.9b: equal energy at all wavelengths has X = Y = Z; daylight D65 has the chromaticity (0.31272, 0.32903).
// ORACLE     table: the CIE's white points (CIE 15:2004, table T.3).
// TOLERANCE  equal energy: 1e-5, as far as the table's own sums agree; D65: a unit of the last printed digit, for the ends that
//            the table of 380 to 780 nm leaves out.
TEST(Observer, SeesThePublishedWhites) {
  proves({"IU.2.9b"}, Oracle::table, "white points E and D65 of CIE 15:2004");
  const Xyz equal = tristimulus(kEqualEnergy);
  EXPECT_TRUE(near(equal[0] / equal[1], 1, 1e-5));
  EXPECT_TRUE(near(equal[2] / equal[1], 1, 1e-5));
  const Eigen::Array2d day = chromaticity(tristimulus(daylight_d65()));
  EXPECT_TRUE(near(day[0], 0.31272, 1e-5));
  EXPECT_TRUE(near(day[1], 0.32903, 1e-5));
}

// CLAIM      IU.2.9b: the table of daylight D65 is the standard's, which is defined each 10 nm and interpolated linearly between.
// ORACLE     identity: each value at 5 nm beside a ten is the mean of its neighbours; a wrong digit anywhere, but in one of the ends
//            alone, breaks it.
// TOLERANCE  the rounding of three values to six digits: a unit of the last one of the largest.
TEST(Observer, KnowsDaylightAsItIsInterpolated) {
  proves({"IU.2.9b"}, Oracle::identity, "linear interpolation between tens of nanometres");
  const std::vector<double>& table = daylight_d65();
  ASSERT_EQ(table.size(), 81U);  // 380 to 780 nm
  for (std::size_t i = 1; i + 1 < table.size(); i += 2) {
    const double largest = std::max({table[i - 1], table[i], table[i + 1]});
    const double unit = largest >= 100 ? 1e-3 : 1e-4;
    EXPECT_TRUE(near(table[i], (table[i - 1] + table[i + 1]) / 2, 1.001 * unit)) << 380 + 5 * i << " nm";
  }
}

// CLAIM      IU.2.9b: XYZ goes to the monitor's RGB: white D65 to (1, 1, 1), each primary to itself; the way back is the
//            standard's matrix.
// ORACLE     table: ITU-R BT.709-6's chromaticities; the matrix printed in IEC 61966-2-1.
// TOLERANCE  16 u for sums of three products of numbers up to 3.3; the printed matrix has four decimals.
TEST(Srgb, HasTheStandardsPrimariesAndWhite) {
  proves({"IU.2.9b"}, Oracle::table, "primaries and white of BT.709, matrix of IEC 61966-2-1");
  const auto xyz = [](double x, double y) { return Xyz(x / y, 1, (1 - x - y) / y); };
  EXPECT_TRUE(within((linear_srgb(xyz(0.3127, 0.3290)) - 1).abs().maxCoeff(), 16 * u));
  const double primary[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
  for (int k = 0; k < 3; ++k) {
    const LinearSrgb seen = linear_srgb(xyz(primary[k][0], primary[k][1]));
    for (int other = 0; other < 3; ++other) {
      const double share = std::abs(seen[other] / seen[k]);
      EXPECT_TRUE(other == k || within(share, 16 * u));
    }
  }
  const double printed[3][3] = {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
  for (int k = 0; k < 3; ++k) {
    LinearSrgb one = LinearSrgb::Zero();
    one[k] = 1;
    const Xyz back = xyz_of(one);
    for (int row = 0; row < 3; ++row) EXPECT_TRUE(near(back[row], printed[row][k], 5e-5));
    EXPECT_TRUE(within((linear_srgb(back) - one).abs().maxCoeff(), 16 * u));
  }
}

// CLAIM      The visible light in parts: weights sum to 1 in each channel, so that white stays white; the parts' borders lie
//            between their wavelengths; two halves of a part weigh as much as the part; violet to red.
// ORACLE     identity: sums, and the relation between finer and coarser parts.
// TOLERANCE  4 N u, the header's; wavelengths 1e-9 nm, some thousand roundings of 780.
TEST(WavelengthSamples, DivideWhiteLight) {
  proves({"IU.2.9b"}, Oracle::identity, "parts sum to white; halves sum to their part");
  constexpr double kWavelength = 1e-9;
  for (const int count : {1, 2, 3, 7, 16, 64, 401}) {
    LinearSrgb sum = LinearSrgb::Zero();
    const auto begins = wavelength_samples(count, 0), samples = wavelength_samples(count),
               ends = wavelength_samples(count, 1), halves = wavelength_samples(2 * count);
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      sum += samples[i].weight;
      EXPECT_TRUE(holds(begins[i].wavelength < samples[i].wavelength && samples[i].wavelength < ends[i].wavelength));
      const double border = i == 0 ? 380 : ends[i - 1].wavelength;
      EXPECT_TRUE(near(begins[i].wavelength, border, kWavelength));
      EXPECT_TRUE(
          within((halves[2 * i].weight + halves[2 * i + 1].weight - samples[i].weight).abs().maxCoeff(), 16 * u));
    }
    EXPECT_TRUE(within((sum - 1).abs().maxCoeff(), 4 * count * u));
    EXPECT_TRUE(near(ends.back().wavelength, 780, kWavelength));
  }
  const auto four = wavelength_samples(4);
  EXPECT_TRUE(holds(four[0].weight[2] > four[0].weight[0] && four[0].weight[2] > four[0].weight[1]));
  EXPECT_TRUE(holds(four[3].weight[0] > four[3].weight[1] && four[3].weight[0] > four[3].weight[2]));
  EXPECT_TRUE(refuses([] { (void)wavelength_samples(0); }));
  EXPECT_TRUE(refuses([] { (void)wavelength_samples(3, 1.5); }));
}

// CLAIM      Parts are of equal ∫ (x̄ + ȳ + z̄) dλ, and a wavelength at offset 0.5 halves its part's.
// ORACLE     closed form: the trapezoid sums of the published table, in steps of 1/100 nm.
// TOLERANCE  an interval of 0.01 nm holds at most 0.02 of a total of 320.
TEST(WavelengthSamples, AreOfEqualWeight) {
  proves({}, Oracle::closed_form, "the table integrated in small steps");
  constexpr double kStep = 0.01;
  constexpr int kParts = 5;
  const auto below = [&](double wavelength) {
    double sum = 0;
    for (double at = 380 + kStep / 2; at < wavelength; at += kStep) sum += observer(at).sum() * kStep;
    return sum;
  };
  const double all = below(780);
  const auto samples = wavelength_samples(kParts);
  for (int i = 0; i < kParts; ++i) {
    EXPECT_TRUE(near(below(samples[static_cast<std::size_t>(i)].wavelength) / all, (i + 0.5) / kParts, 1e-4));
  }
}

}  // namespace
}  // namespace etendue::validation
