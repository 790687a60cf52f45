// SPDX-License-Identifier: Apache-2.0
#include "runner/wire.hpp"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>
#include <variant>

#include "etendue/core/contract.hpp"

namespace etendue::validation {

// The library finds these by the namespace of their types.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Evidence, test, claims, kind, oracle, worst_share, comparisons, seeds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TestRun, suite, name, outcome, failures, seconds, evidence)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Convergence, title, size_name, sizes, errors, slope, tolerance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WorstInput, title, command, share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FactorTable, title, areas, factors, bounds, covered)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Balance, emitted, absorbed, escaped, tolerance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RadiosityField, title, corners, radiosity, residuals, contraction, balance, eye,
                                   gaze)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ImagePair, title, columns, rows, reference, ours, tolerance)

namespace {

using Json = nlohmann::json;

Json packed(const ErrorHistogram& h) {
  return {h.title(), h.unit(), h.width(), h.worst(), h.counts()};
}

ErrorHistogram unpacked(const Json& h) {
  return {h[0].get<std::string>(), h[1].get<std::string>(), h[2].get<double>(), h[3].get<double>(),
          h[4].get<std::vector<std::uint64_t>>()};
}

Json packed(const Exhibit& exhibit) {
  const Json figure = std::visit(
      [](const auto& f) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(f)>, ErrorHistogram>)
          return packed(f);
        else
          return f;
      },
      exhibit.figure);
  return {exhibit.test, exhibit.figure.index(), figure};
}

template <std::size_t kKind = 0>
Figure figure_of_kind(std::size_t kind, const Json& figure) {
  if constexpr (kKind < std::variant_size_v<Figure>) {
    if (kind != kKind) return figure_of_kind<kKind + 1>(kind, figure);
    using Kind = std::variant_alternative_t<kKind, Figure>;
    if constexpr (std::is_same_v<Kind, ErrorHistogram>)
      return unpacked(figure);
    else
      return figure.get<Kind>();
  }
  throw ContractViolation("from_wire: a kind of figure");
}

}  // namespace

std::string to_wire(const WorkDone& work) {
  Json tests = Json::array();
  for (const NumberedRun& test : work.tests) {
    Json exhibits = Json::array();
    for (const Exhibit& exhibit : test.exhibits) exhibits.push_back(packed(exhibit));
    tests.push_back({test.index, test.run, exhibits});
  }
  std::string text;
  Json::to_cbor({work.gtest_ok, tests}, text);  // binary: NaN stays, and so do bytes that are not UTF-8
  return text;
}

WorkDone from_wire(const std::string& text) {
  const Json all = Json::from_cbor(text);
  WorkDone work;
  work.gtest_ok = all[0].get<bool>();
  for (const Json& test : all[1]) {
    NumberedRun run{test[0].get<std::size_t>(), test[1].get<TestRun>(), {}};
    for (const Json& exhibit : test[2]) {
      run.exhibits.push_back(
          {exhibit[0].get<std::string>(), figure_of_kind(exhibit[1].get<std::size_t>(), exhibit[2])});
    }
    work.tests.push_back(std::move(run));
  }
  return work;
}

}  // namespace etendue::validation
