// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <set>

#include "form_factor/catalogue/configurations.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 4711;

/// Where a part of the sphere, or of the groove between two plates, vanishes at the domain's end, so does the factor, and
/// with it the bound's share: the entry's `care` says so.
bool vanishes(const std::string& id) {
  return id == "element-sphere-cut" || id == "parallel-rectangles" || id == "element-rectangle" ||
         id == "shifted-plates" || id == "perpendicular-rectangles";
}

/// All lengths at the ends of their ratio, angles and counts at theirs, or in between.
std::vector<double> extreme(const catalogue::Entry& entry, CounterRandom& random) {
  std::vector<double> values;
  const double wide = std::sqrt(entry.widest_ratio);
  for (const auto& p : entry.parameters) {
    const int third = static_cast<int>(3 * random.unit());
    const double log_uniform = random.scale(1 / wide, wide);
    const double size = third == 0 ? 1 / wide : third == 1 ? wide * (1 - 0x1p-40) : log_uniform;
    switch (p.quantity) {
      case catalogue::Quantity::length:
        values.push_back(size);
        break;
      case catalogue::Quantity::offset:
        values.push_back(random.unit() < 0.2 ? 0 : size);
        break;
      case catalogue::Quantity::position:
        values.push_back((random.unit() < 0.5 ? -1 : 1) * size);
        break;
      case catalogue::Quantity::angle:
        values.push_back(third == 0   ? p.least
                         : third == 1 ? p.greatest
                                      : p.least + (p.greatest - p.least) * random.unit());
        break;
      case catalogue::Quantity::count:
        values.push_back(third == 0   ? p.least
                         : third == 1 ? p.greatest
                                      : std::floor(random.scale(p.least, p.greatest)));
        break;
    }
  }
  return values;
}

// CLAIM      IU.6-3: the bound stays below kCatalogueError of the factor to the ends of every entry's domain, and the
//            factor within [0, 1].
// ORACLE     identity: the documented contract.
// TOLERANCE  kCatalogueError of the value.
TEST(Catalogue, KeepsItsBoundToTheEndsOfTheDomain) {
  proves({"IU.6-3"}, Oracle::identity, "the bound of every entry at up to 200 parameters, ends of the domain included");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  for (const auto& entry : catalogue::entries()) {
    const bool slow = entry.accuracy == catalogue::Accuracy::measured;
    const int wanted = slow ? 20 : 200;
    int taken = 0;
    for (int trial = 0; trial < 40 * wanted && taken < wanted; ++trial) {
      const auto values = extreme(entry, random);
      if (catalogue::complaint(entry, values)) continue;
      const auto factor = catalogue::form_factor(entry, values);
      ASSERT_TRUE(factor.ok());
      ++taken;
      EXPECT_TRUE(holds(factor->value >= 0 && factor->value <= 1)) << described(entry, values);
      if (!vanishes(entry.id)) {
        EXPECT_TRUE(within(factor->bound, catalogue::kCatalogueError * factor->value)) << described(entry, values);
      }
    }
    EXPECT_GE(taken, entry.parameters.size() > 6 ? 2 : wanted / 8) << entry.id << ": the domain was hardly met";
  }
}

// CLAIM      IU.6-3: scaling all lengths by a power of two changes no bit.
// ORACLE     metamorphic: the factor is a ratio of like quantities.
// TOLERANCE  none: bitwise equal.
TEST(Catalogue, HasTheSameBitsAtEveryPowerOfTwo) {
  proves({"IU.6-3"}, Oracle::metamorphic, "F(2^k lengths) = F(lengths) bitwise for every entry");
  CounterRandom random(kSeed + 1);
  std::uint64_t mismatches = 0, decisions = 0;
  for (const auto& entry : catalogue::entries()) {
    const auto values = random_parameters(entry, random, 9, 0.05);
    const auto plain = catalogue::form_factor(entry, values);
    for (const double unit : {0x1p-300, 0x1p-20, 0x1p300}) {
      std::vector<double> scaled = values;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const auto quantity = entry.parameters[i].quantity;
        if (quantity != catalogue::Quantity::angle && quantity != catalogue::Quantity::count) scaled[i] *= unit;
      }
      const auto other = catalogue::form_factor(entry, scaled);
      ASSERT_TRUE(other.ok()) << entry.id << ": " << other.error().message;
      mismatches += other->value != plain->value || other->bound != plain->bound ? 1u : 0u;
      ++decisions;
    }
  }
  EXPECT_TRUE(all_agree(mismatches, decisions));
}

// CLAIM      IU.6-3: what is outside an entry's domain is refused, and the message names parameter, finding and rule.
// ORACLE     identity: the documented contract.
// TOLERANCE  none.
TEST(Catalogue, RefusesWhatIsOutsideItsDomain) {
  proves({"IU.6-3"}, Oracle::identity,
         "NaN, infinity, zero, negative, too long, too unequal, every angle past its ends");
  CounterRandom random(kSeed + 2);
  constexpr double kInfinite = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t wrong = 0, decided = 0;
  for (const auto& entry : catalogue::entries()) {
    const auto good = random_parameters(entry, random, 4, 0.1);
    for (std::size_t i = 0; i < good.size(); ++i) {
      const auto& p = entry.parameters[i];
      std::vector<double> bad{kNan, kInfinite, -kInfinite, 1e101};
      if (p.quantity == catalogue::Quantity::length) bad.insert(bad.end(), {0, -1, 1e-101});
      if (p.quantity == catalogue::Quantity::offset) bad.insert(bad.end(), {-1, 1e-101});
      if (p.quantity == catalogue::Quantity::angle) bad.insert(bad.end(), {p.least - 0.001, p.greatest + 0.001});
      if (p.quantity == catalogue::Quantity::count) bad.insert(bad.end(), {p.least - 1, p.least + 0.5, p.greatest + 1});
      for (const double value : bad) {
        std::vector<double> values = good;
        values[i] = value;
        const auto refused = catalogue::form_factor(entry, values);
        const bool named = !refused.ok() && refused.error().code == ErrorCode::invalid_input &&
                           refused.error().message.find(std::string(entry.id) + ": " + p.symbol + " = ") == 0 &&
                           refused.error().message.find("expected ") != std::string::npos;
        wrong += named ? 0u : 1u;
        ++decided;
        if (!named) ADD_FAILURE() << entry.id << " " << p.symbol << " = " << value;
      }
    }
    for (const auto& condition : entry.conditions) {
      bool names_a_parameter = false;
      for (const auto& p : entry.parameters)
        names_a_parameter = names_a_parameter || std::string(p.symbol) == condition.names;
      wrong += names_a_parameter ? 0u : 1u;
      ++decided;
    }
  }
  const auto message = [](const char* id, std::vector<double> values) {
    const auto refused = catalogue::form_factor(*catalogue::find(id), values);
    return refused.ok() ? std::string("accepted") : refused.error().message;
  };
  EXPECT_EQ(message("element-sphere-cut", {-2, 5, 1}).find("element-sphere-cut: h = -2"), 0u) << "below the horizon";
  EXPECT_EQ(message("strip-long-cylinder", {1, 2, 1}), "accepted") << "the cylinder touches the horizon";
  EXPECT_EQ(message("strip-long-cylinder", {0.5, 2, 1}).find("strip-long-cylinder: a = 0.5"), 0u);
  EXPECT_EQ(message("C-11", {1, 1, 1e-7}), "C-11: c = 1e-07 (distance): expected at least a/1e+06, where a = 1");
  EXPECT_EQ(message("element-sphere", {1, 2}),
            "element-sphere: h = 1 (distance of the centre): expected h >= r, the element outside the sphere");
  EXPECT_EQ(message("B-13", {1e7, 1, 1}),
            "B-13: a = 1e+07 (distance of the element from the axis): expected at most 1e+06 times h, which is 1");
  EXPECT_EQ(message("element-sphere-cut", {-0.5, 2, 1}), "accepted");
  EXPECT_NE(message("element-sphere-cut", {-1.5, 3, 1}).find("expected h > -r"), std::string::npos);
  EXPECT_EQ(message("strip-long-cylinder", {1, 0.5, 1}), "accepted");
  EXPECT_NE(message("strip-long-cylinder", {0.9, 0.5, 1}).find("expected a >= r"), std::string::npos);
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      The catalogue holds 90 configurations, as README says, each with its own id and title and a drawing.
// ORACLE     exact: counted.
// TOLERANCE  none.
TEST(Catalogue, HoldsNinetyConfigurations) {
  proves({}, Oracle::exact, "ids, titles, texts and drawings counted");
  std::set<std::string> ids, titles, pictures;
  for (const auto& entry : catalogue::entries()) {
    ids.insert(entry.id);
    titles.insert(entry.title);
    const std::string svg = catalogue::svg(entry);
    const std::string drawn_part = svg.substr(svg.find("</title>"));
    pictures.insert(drawn_part);
    EXPECT_TRUE(holds(drawn_part.find("nan") == std::string::npos && drawn_part.find("inf") == std::string::npos))
        << entry.id;
    // each letter of the parameter list stands in the picture
    for (const auto& p : entry.parameters) {
      const bool drawn = svg.find(">" + std::string(p.symbol) + "<") != std::string::npos ||
                         svg.find(">-" + std::string(p.symbol) + "<") != std::string::npos ||
                         svg.find(">" + std::string(p.symbol) + " = ") != std::string::npos;
      EXPECT_TRUE(holds(drawn)) << entry.id << " does not show " << p.symbol;
    }
    EXPECT_TRUE(holds(*entry.formula && *entry.source && *entry.care && !entry.parameters.empty())) << entry.id;
  }
  constexpr std::size_t kAsReadmeSays = 90;
  EXPECT_EQ(ids.size(), kAsReadmeSays);
  EXPECT_EQ(ids.size(), catalogue::entries().size());
  EXPECT_EQ(titles.size(), ids.size());
}

}  // namespace
}  // namespace etendue::validation
