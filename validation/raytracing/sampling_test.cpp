// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/sampling.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

using Rgb = Eigen::Array3d;
using Point = std::pair<double, double>;

struct Sampled {
  Image image;
  std::vector<PixelWork> work;  ///< row by row
  std::map<Point, int> looks;   ///< how often each place was looked at
};

/// All rows in both steps, light(x, y) being what there is to see, and depth(x, y) how deep a tree that takes.
template <class Light, class Depth = int (*)(double, double)>
Sampled sampled(
    const Sampling& sampling, int columns, int rows, Light light, const PixelFilter& filter = {},
    Depth depth = [](double, double) { return 0; }) {
  const RowSampler sampler(sampling, filter, {0, columns}, columns);
  Sampled result{Image(columns, rows), {}, {}};
  const Look look = [&](double x, double y, const SampleKey&) {
    ++result.looks[{x, y}];
    return Glimpse{light(x, y), depth(x, y)};
  };
  std::vector<SampledRow> all;
  for (int row = 0; row < rows; ++row)
    all.push_back(sampler.begins(row) ? sampler.begin(row, look) : sampler.fresh(row));
  const auto row_at = [&](int row) -> const SampledRow* {
    return row >= 0 && row < rows && sampler.begins(row) ? &all[static_cast<std::size_t>(row)] : nullptr;
  };
  for (int row = 0; row < rows; ++row)
    sampler.complete(all[static_cast<std::size_t>(row)], row_at(row - 1), row_at(row + 1), look);
  for (int row = 0; row < rows; ++row) {
    std::vector<const FilterRow*> near;
    for (int r = std::max(0, row - filter.reach()); r <= std::min(rows - 1, row + filter.reach()); ++r)
      near.push_back(&all[static_cast<std::size_t>(r)].light);
    for (int column = 0; column < columns; ++column) {
      result.image.at(column, row) = FilterRow::resolve(near, column, row);
      result.work.push_back(all[static_cast<std::size_t>(row)].work[static_cast<std::size_t>(column)]);
    }
  }
  return result;
}

Sampling by(SamplingScheme scheme, int n, std::uint64_t seed = 0) {
  Sampling sampling;
  sampling.scheme = scheme;
  sampling.samples_per_side = n;
  sampling.seed = seed;
  return sampling;
}

Rgb grey(double value) {
  return Rgb::Constant(value);
}

std::size_t looks(const Sampled& picture) {
  std::size_t count = 0;
  for (const auto& [place, times] : picture.looks) count += static_cast<std::size_t>(times);
  return count;
}

// CLAIM      IU.5.8, mended: what has no frequency of half the sampling rate or more is told apart; at exactly twice the frequency a sine
//            may vanish in every sample (E17), and 7 Hz sampled at 10 Hz, below the rate, shows as 3 Hz (E18). One sample in
//            the centre of each pixel is such a sampling.
// ORACLE     identity: sin(π i) = 0; cos(2π 7 (i + ½)/10) = −cos(2π 3 (i + ½)/10).
// TOLERANCE  the argument 2π 7 · 30 errs by three roundings of its size, the cosine by one, the mean by four.
TEST(Sampling, AliasesWhatIsFasterThanHalfTheRate) {
  proves({"IU.5.8", "E17", "E18"}, Oracle::identity, "sin(πi) = 0; 7 = 10 − 3");
  constexpr double kTurn = 2 * std::numbers::pi, kTolerance = 3 * kTurn * 7 * 3 * kUnitRoundoff + 8 * kUnitRoundoff;
  const auto wave = [&](int n, auto light) {
    return sampled(by(SamplingScheme::uniform, n), 30, 1,
                   [&](double x, double) { return grey(0.5 + 0.5 * light(x / 10)); })
        .image;
  };
  const Image critical = wave(1, [&](double t) { return std::sin(kTurn * 5 * (t - 0.05)); });
  const Image seven = wave(1, [&](double t) { return std::cos(kTurn * 7 * t); });
  const Image three = wave(1, [&](double t) { return -std::cos(kTurn * 3 * t); });
  const Image slow = wave(1, [&](double t) { return std::sin(kTurn * 4 * (t - 0.05)); });
  double slow_range = 0, difference = 0;
  for (int i = 0; i < 30; ++i) {
    EXPECT_TRUE(near(critical.at(i, 0)[0], 0.5, kTolerance));
    EXPECT_TRUE(near(seven.at(i, 0)[0], three.at(i, 0)[0], kTolerance));
    slow_range = std::max(slow_range, std::abs(slow.at(i, 0)[0] - 0.5));
  }
  EXPECT_GT(slow_range, 0.4);  // 4 Hz, below half the rate, is seen
  // Sampled at 40 Hz, which is more than 2 · 7, both differ: the alias is gone.
  const Image fast = wave(4, [&](double t) { return std::cos(kTurn * 7 * t); });
  const Image other = wave(4, [&](double t) { return -std::cos(kTurn * 3 * t); });
  for (int i = 0; i < 30; ++i) difference = std::max(difference, std::abs(fast.at(i, 0)[0] - other.at(i, 0)[0]));
  EXPECT_TRUE(apart(difference, 0, 0.1));
}

// CLAIM      IU.5.8.1: jitter replaces an alias by noise: of a wave of 97 cycles on 100 pixels, uniform samples show 3 cycles at full
//            strength, jittered ones show sin(πf)/(πf) of them, f being the cycles a pixel, and noise. The mean over a pixel keeps its place.
// ORACLE     statistics: the expectation over the jitter of cos(2πf(i + u)); 400 rows, seed 1.
// TOLERANCE  uniform: roundings of an argument of 2π 97. Jittered: five standard deviations, each of 40,000 samples having a
//            variance of at most 1 and the projection doubling the mean of values of which half counts: 5 · √(2/40000).
TEST(Sampling, JitterReplacesAliasesByNoise) {
  proves({"IU.5.8.1"}, Oracle::statistics, "Fourier coefficient of 40,000 jittered samples");
  uses_seed(1);
  constexpr int kColumns = 100, kRows = 400, kCycles = 97;
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto strength = [&](const Sampling& sampling, int cycles, double& scatter) {
    const Image image = sampled(sampling, kColumns, kRows, [&](double x, double) {
                          return grey(std::cos(kTurn * kCycles * x / kColumns));
                        }).image;
    double sum = 0;
    scatter = 0;
    for (int row = 0; row < kRows; ++row) {
      for (int i = 0; i < kColumns; ++i) {
        sum += 2 * image.at(i, row)[0] * std::cos(kTurn * cycles * (i + 0.5) / kColumns);
        scatter = std::max(scatter, std::abs(image.at(i, row)[0] - image.at(i, 0)[0]));
      }
    }
    return sum / (kColumns * kRows);
  };
  double scatter = 0;
  EXPECT_TRUE(near(strength(by(SamplingScheme::uniform, 1), 3, scatter), -1, 1e3 * kTurn * kCycles * kUnitRoundoff));
  EXPECT_EQ(scatter, 0);
  constexpr double kPerPixel = static_cast<double>(kCycles) / kColumns;
  const double expected = std::sin(std::numbers::pi * kPerPixel) / (std::numbers::pi * kPerPixel);
  EXPECT_TRUE(near(strength(by(SamplingScheme::jittered, 1, 1), 3, scatter), -expected, 5 * std::sqrt(2.0 / 40000)));
  EXPECT_GT(scatter, 1);  // the noise
}

// CLAIM      IU.f52, IU.f53: along an edge of slope 1/16, one uniform sample a pixel errs by a staircase, whose errors go together from pixel to
//            pixel; one jittered sample by noise, whose errors do not: no trace of the aliasing is left.
// ORACLE     closed form: the staircase's error is a sawtooth of 16 pixels, ((k + ½)/16 − ½); of neighbours its correlation is that of the
//            sawtooth with itself, moved by one.
// TOLERANCE  uniform: roundings of 4,096 products. Jittered: 5/√4096, the deviation of a sum of independent errors.
TEST(Sampling, TurnsAStaircaseIntoNoise) {
  proves({"IU.f52", "IU.f53", "IU.5.8.1"}, Oracle::closed_form, "correlation of a sawtooth; of noise");
  uses_seed(8);
  constexpr int kColumns = 512, kRows = 9, kEdge = 4;
  // Rows kEdge to kEdge + 1 are cut by edges of the slope 1/16, a new one every 16 columns.
  const auto depth = [](double x) { return kEdge + (x - 16 * std::floor(x / 16)) / 16; };
  const auto correlation = [&](SamplingScheme scheme) {
    double products = 0, squares = 0;
    for (std::uint64_t seed = 8; seed < 16; ++seed) {
      const Image image = sampled(by(scheme, 1, seed), kColumns, kRows, [&](double x, double y) {
                            return grey(y < depth(x) ? 1 : 0);
                          }).image;
      const auto error = [&](int column) { return image.at(column, kEdge)[0] - (column % 16 + 0.5) / 16; };
      for (int column = 0; column + 1 < kColumns; ++column) {
        products += error(column) * error(column + 1);
        squares += error(column) * error(column);
      }
    }
    return products / squares;
  };
  double products = 0, squares = 0;
  const auto tooth = [](int k) { return (k % 16 + 0.5) / 16 > 0.5 ? 1 - (k % 16 + 0.5) / 16 : -(k % 16 + 0.5) / 16; };
  for (int k = 0; k + 1 < kColumns; ++k) {
    products += tooth(k) * tooth(k + 1);
    squares += tooth(k) * tooth(k);
  }
  EXPECT_TRUE(near(correlation(SamplingScheme::uniform), products / squares, 4096 * 8 * kUnitRoundoff));
  EXPECT_GT(products / squares, 0.5);
  EXPECT_TRUE(near(correlation(SamplingScheme::jittered), 0, 5 / std::sqrt(4096.0)));
}

// CLAIM      IU.5.8.1: of N × N jittered samples one lies in each of N × N equal parts; another seed puts them elsewhere, the same seed not.
// ORACLE     identity: the parts, counted.
// TOLERANCE  none.
TEST(Sampling, JittersWithinEqualParts) {
  proves({"IU.5.8.1"}, Oracle::identity, "one sample in each part");
  const auto nothing = [](double, double) { return grey(1); };
  const Sampled first = sampled(by(SamplingScheme::jittered, 4, 5), 6, 5, nothing);
  const Sampled again = sampled(by(SamplingScheme::jittered, 4, 5), 6, 5, nothing);
  const Sampled other = sampled(by(SamplingScheme::jittered, 4, 6), 6, 5, nothing);
  std::map<std::pair<int, int>, int> in_part;
  for (const auto& [place, times] : first.looks)
    in_part[{static_cast<int>(std::floor(place.first * 4)), static_cast<int>(std::floor(place.second * 4))}] += times;
  std::uint64_t wrong = 0;
  for (const auto& [part, count] : in_part) wrong += count != 1 ? 1u : 0u;
  EXPECT_TRUE(all_agree(wrong + (in_part.size() != 24 * 20 ? 1 : 0), 24 * 20));
  EXPECT_TRUE(holds(first.looks == again.looks));
  std::size_t shared = 0;
  for (const auto& [place, times] : first.looks) shared += other.looks.count(place);
  EXPECT_EQ(shared, 0u);
}

/// The edge of figure 47 as we draw it: the object lies below the line from (0, 7/5) to (3, 1/5), in pixels, y downwards.
bool inside_edge(double x, double y) {
  return 5 * y + 2 * x > 7;  // exact at places in quarters; in sixths the two sides differ by a sixth at least
}

// CLAIM      IU.f47: of six pixels that an edge crosses, sampled in the centres of nine sub-pixels each, a pixel has the share of its
//            samples that see the object: five levels of grey where one sample knows two.
// ORACLE     exact: the half-plane 5 y + 2 x > 7 at (i + (2a+1)/6, j + (2b+1)/6), in integers: 5 (6j+2b+1) + 2 (6i+2a+1) > 42.
// TOLERANCE  nine roundings.
TEST(Sampling, GradesTheEdgeOfFigure47) {
  proves({"IU.f47", "IU.5.8.1"}, Oracle::exact, "nine samples a pixel, counted in integers");
  const auto edge = [](double x, double y) { return grey(inside_edge(x, y) ? 1 : 0); };
  const Image nine = sampled(by(SamplingScheme::uniform, 3), 3, 2, edge).image;
  const Image one = sampled(by(SamplingScheme::uniform, 1), 3, 2, edge).image;
  std::set<int> levels, levels_of_one;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i) {
      int count = 0;
      for (int b = 0; b < 3; ++b) {
        for (int a = 0; a < 3; ++a) count += 5 * (6 * j + 2 * b + 1) + 2 * (6 * i + 2 * a + 1) > 7 * 6 ? 1 : 0;
      }
      EXPECT_TRUE(near(nine.at(i, j)[0], count / 9.0, 9 * kUnitRoundoff)) << i << " " << j;
      levels.insert(count);
      levels_of_one.insert(one.at(i, j)[0] > 0.5 ? 1 : 0);
    }
  }
  EXPECT_EQ(levels.size(), 5u);
  EXPECT_EQ(levels_of_one.size(), 2u);
}

/// The places that corner sampling must look at, in quarters of a pixel, by plain recursion over sets.
struct Quartering {
  std::set<std::pair<int, int>> places;
  void cell(int x, int y, int size) {
    bool seen[2] = {false, false};
    for (const int dy : {0, size}) {
      for (const int dx : {0, size}) {
        places.insert({x + dx, y + dy});
        seen[5 * (y + dy) + 2 * (x + dx) > 7 * 4 ? 1 : 0] = true;
      }
    }
    if (size == 1 || !(seen[0] && seen[1])) return;
    for (const int dy : {0, size / 2}) {
      for (const int dx : {0, size / 2}) cell(x + dx, y + dy, size / 2);
    }
  }
};

/// The samples over the pixels and the object of figure 47.
std::string drawing(const Sampled& picture) {
  std::ostringstream svg;
  svg << "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
      << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-0.1 -0.1 3.2 2.2\" width=\"640\">\n"
      << "<rect x=\"-0.1\" y=\"-0.1\" width=\"3.2\" height=\"2.2\" fill=\"white\"/>\n"
      << "<path d=\"M0 1.4L3 0.2V2H0Z\" fill=\"#ccc\"/>\n"
      << "<path d=\"M0 0H3V2H0ZM1 0V2M2 0V2M0 1H3\" fill=\"none\" stroke=\"black\" stroke-width=\"0.01\"/>\n";
  for (const auto& [place, times] : picture.looks)
    svg << "<circle cx=\"" << place.first << "\" cy=\"" << place.second << "\" r=\"0.03\"/>\n";
  svg << "</svg>\n";
  return svg.str();
}

// CLAIM      IU.f48, IU.5.8.2: 3 × 2 pixels with three levels are 117 rays where all corners differ; along the edge of figure 47 only
//            those that it needs, each once, shared between levels, pixels and rows, whichever row comes first.
// ORACLE     exact: (3·4 + 1)(2·4 + 1) = 117; the places of a recursion over sets, in integers.
// TOLERANCE  none.
TEST(Sampling, QuartersPixelsWhereCornersDiffer) {
  proves({"IU.f48", "IU.5.8.2"}, Oracle::exact, "sets of corners in integers");
  const auto edge = [](double x, double y) { return grey(inside_edge(x, y) ? 1 : 0.1); };
  Sampling everywhere = by(SamplingScheme::adaptive, 4);
  everywhere.threshold = Rgb::Zero();
  // Any two corners of a cell differ: by its place in the picture.
  const auto all_differ = [](double x, double y) { return grey(1 + x + 8 * y); };
  const Sampled full = sampled(everywhere, 3, 2, all_differ);
  EXPECT_TRUE(holds(looks(full) == 117));
  EXPECT_TRUE(holds(full.looks.size() == 117));
  const Sampled adaptive = sampled(by(SamplingScheme::adaptive, 4), 3, 2, edge);
  Quartering expected;
  for (const int y : {0, 4}) {
    for (const int x : {0, 4, 8}) expected.cell(x, y, 4);
  }
  EXPECT_TRUE(holds(looks(adaptive) == expected.places.size())) << looks(adaptive);
  std::uint64_t wrong = 0;
  for (const auto& [x, y] : expected.places) wrong += adaptive.looks.count({x / 4.0, y / 4.0}) == 1 ? 0u : 1u;
  EXPECT_TRUE(all_agree(wrong, expected.places.size()));
  EXPECT_TRUE(holds(looks(adaptive) == 62));
  EXPECT_TRUE(holds(read_text(source_root() / "docs" / "figure-48.svg") == drawing(adaptive))) << drawing(adaptive);
}

// CLAIM      IU.5.8.2: a pixel's value is the mean of its parts, each the mean of its four corners, weighed by area.
// ORACLE     exact: an edge at x = 5/8 of the one pixel: at level 3 the parts from ½ to ¾ see half of it; parts before are 1, beyond 0.
// TOLERANCE  none: dyadic.
TEST(Sampling, WeighsPartsByTheirArea) {
  proves({"IU.5.8.2"}, Oracle::exact, "areas in quarters");
  const Image image =
      sampled(by(SamplingScheme::adaptive, 4), 1, 1, [](double x, double) { return grey(x < 0.625); }).image;
  EXPECT_TRUE(near(image.at(0, 0)[0], 0.5 + 0.25 / 2, 0));
}

// CLAIM      IU.5.8.2: each channel has its own threshold, 0.25, 0.20, 0.40, to be exceeded; four black corners have no contrast, where the
//            printed formula is 0/0 (G10).
// ORACLE     closed form: (a − b)/(a + b).
// TOLERANCE  two roundings of the contrast; decisions none.
TEST(Sampling, ComparesEachChannelWithItsThreshold) {
  proves({"IU.5.8.2", "G10"}, Oracle::closed_form, "(I_max − I_min)/(I_max + I_min)");
  ColourRange range, black;
  for (const double share : {0.3, 1.0, 0.5}) range.add(Rgb(share, 0.2 + share, 0));
  EXPECT_TRUE(near(range.contrast()[0], 0.7 / 1.3, 2 * kUnitRoundoff));
  EXPECT_TRUE(near(range.contrast()[1], 0.7 / 1.7, 4 * kUnitRoundoff));
  EXPECT_EQ(range.contrast()[2], 0);
  for (int corner = 0; corner < 4; ++corner) black.add(Rgb::Zero());
  EXPECT_TRUE((black.contrast() == 0).all());
  const volatile double darkness = 0;
  EXPECT_TRUE(apart((darkness - darkness) / (darkness + darkness), 0, 0));
  // (1 + c) beside (1 − c) has the contrast c.
  const auto rays = [&](const Rgb& contrast) {
    const Sampled picture = sampled(by(SamplingScheme::adaptive, 2), 1, 1,
                                    [&](double x, double) { return Rgb(1 + (x < 0.25 ? 1 : -1) * contrast); });
    return looks(picture);
  };
  for (int channel = 0; channel < 3; ++channel) {
    for (const double by_how_much : {-0.01, 0.01}) {
      Rgb contrast = Rgb::Zero();
      contrast[channel] = kContrastThresholds[channel] + by_how_much;
      EXPECT_TRUE(holds(rays(contrast) == (by_how_much > 0 ? 9u : 4u))) << channel;
    }
  }
  EXPECT_TRUE(holds(rays(Rgb::Zero()) == 4));
}

// CLAIM      IU.f49, IU.f50, "adaptive, 16 jittered samples": a pixel has one sample where it and its neighbours look alike, else one in each
//            of 16 parts; the first sample is one of the 16, so none is wasted.
// ORACLE     exact: which pixels are within one of the edge; looks counted.
// TOLERANCE  none.
TEST(Sampling, TakesAllJitteredSamplesWhereNeighboursDiffer) {
  proves({"IU.5.8.2"}, Oracle::exact, "pixels within one of an edge");
  const Sampled picture = sampled(by(SamplingScheme::adaptive_jittered, 4, 3), 12, 5,
                                  [](double x, double) { return grey(x < 6 ? 1 : 0.25); });
  std::uint64_t wrong = 0;
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 12; ++column) {
      const int expected = column == 5 || column == 6 ? 16 : 1;
      if (picture.work[static_cast<std::size_t>(12 * row + column)].samples != expected) ++wrong;
      if (picture.image.at(column, row)[0] != (column < 6 ? 1 : 0.25)) ++wrong;
    }
  }
  EXPECT_TRUE(all_agree(wrong, 60));
  EXPECT_TRUE(holds(looks(picture) == 5 * (2 * 16 + 10)));
  EXPECT_TRUE(holds(picture.looks.size() == looks(picture)));
  std::map<std::pair<int, int>, int> in_part;
  for (const auto& [place, times] : picture.looks) {
    if (place.first >= 5 && place.first < 7)
      in_part[{static_cast<int>(place.first * 4), static_cast<int>(place.second * 4)}] += times;
  }
  EXPECT_TRUE(holds(in_part.size() == 5 * 32));
}

// CLAIM      Sampling that cannot be meant is refused with what is wrong.
// ORACLE     table: one case a rule.
// TOLERANCE  none.
TEST(Sampling, RefusesWhatCannotBeMeant) {
  proves({}, Oracle::table, "one case a rule");
  EXPECT_TRUE(holds(fault(by(SamplingScheme::jittered, 0)).has_value()));
  EXPECT_TRUE(holds(fault(by(SamplingScheme::jittered, 65)).has_value()));
  EXPECT_TRUE(holds(fault(by(SamplingScheme::adaptive, 3)).has_value()));
  EXPECT_TRUE(holds(fault(by(SamplingScheme::adaptive, 32)).has_value()));
  EXPECT_TRUE(holds(!fault(by(SamplingScheme::adaptive, 16)).has_value()));
  EXPECT_TRUE(holds(!fault(by(SamplingScheme::adaptive_jittered, 3)).has_value()));
  Sampling negative;
  negative.threshold[1] = -0.1;
  EXPECT_TRUE(holds(fault(negative).has_value()));
}

// CLAIM      Contrast must exceed the threshold: where all looks alike and it is 0, a pixel keeps its one sample.
// ORACLE     exact: looks counted.
// TOLERANCE  none.
TEST(Sampling, TakesNoMoreWhereContrastEqualsTheThreshold) {
  proves({"IU.5.8.2"}, Oracle::exact, "one look a pixel of an even picture");
  Sampling sampling = by(SamplingScheme::adaptive_jittered, 4);
  sampling.threshold.setZero();
  EXPECT_TRUE(holds(looks(sampled(sampling, 5, 3, [](double, double) { return grey(0.5); })) == 15));
}

// CLAIM      The depth that is told of a pixel is the greatest among its samples, in every scheme.
// ORACLE     exact: a tree of depth 3 in one corner of each pixel, 1 elsewhere.
// TOLERANCE  none.
TEST(Sampling, TellsTheDeepestTreeOfAPixel) {
  proves({}, Oracle::exact, "depths by place");
  const auto corner = [](double x, double y) { return x - std::floor(x) < 0.25 && y - std::floor(y) < 0.25; };
  std::uint64_t wrong = 0;
  for (const SamplingScheme scheme : {SamplingScheme::uniform, SamplingScheme::jittered, SamplingScheme::adaptive}) {
    const Sampled picture = sampled(
        by(scheme, 4), 6, 3, [&](double x, double y) { return grey(corner(x, y) ? 1 : 0); }, {},
        [&](double x, double y) { return corner(x, y) ? 3 : 1; });
    for (const PixelWork& work : picture.work) wrong += work.tree_depth == 3 ? 0u : 1u;
  }
  EXPECT_TRUE(all_agree(wrong, 54));
}

}  // namespace
}  // namespace etendue::validation
