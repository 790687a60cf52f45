// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "etendue/io/byte_text.hpp"
#include "runner/figures.hpp"
#include "support/flip.hpp"

namespace etendue::validation {

namespace {

using Json = nlohmann::ordered_json;

/// The bytes of numbers as a script reads them; every machine that builds this is little-endian.
template <class Number>
std::string packed(const std::vector<Number>& numbers) {
  return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

std::vector<float> rounded(const std::vector<double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Of a plane polygon: half the length of the sum of its corners' cross products.
double area_of(const std::vector<double>& corners) {
  double sum[3] = {0, 0, 0};
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const std::size_t next = (k + 3) % corners.size();
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
      sum[c] += corners[k + d] * corners[next + e] - corners[k + e] * corners[next + d];
    }
  }
  return std::hypot(sum[0], sum[1], sum[2]) / 2;
}

Json from(const Convergence& c) {
  return {{"kind", "convergence"},      {"title", c.title},
          {"size_name", c.size_name},   {"sizes", c.sizes},
          {"errors", c.errors},         {"expected", c.slope},
          {"tolerance", c.tolerance},   {"fitted", number(fitted_slope(c))},
          {"misfit", number(misfit(c))}};
}

Json from(const ErrorHistogram& h) {
  return {{"kind", "histogram"},  {"title", h.title()}, {"unit", h.unit()},  {"width", h.width()},
          {"counts", h.counts()}, {"total", h.total()}, {"worst", h.worst()}};
}

Json from(const WorstInput& w) {
  return {{"kind", "worst"}, {"title", w.title}, {"command", w.command}, {"share", number(w.share)}};
}

Json from(const FactorTable& t) {
  const FactorDefects defects = defects_of(t);
  return {{"kind", "factors"},
          {"title", t.title},
          {"covered", t.covered},
          {"closure", number(defects.closure)},
          {"reciprocity", number(defects.reciprocity)},
          {"widest", number(defects.widest)},
          {"areas", t.areas},
          {"f64_factors", packed(t.factors)},
          {"f64_bounds", packed(t.bounds)}};
}

Json from(const RadiosityField& f) {
  Json balance = Json::array();
  double power = 0;
  for (const Balance& b : f.balance) {
    balance.push_back({{"emitted", number(b.emitted)},
                       {"absorbed", number(b.absorbed)},
                       {"escaped", number(b.escaped)},
                       {"tolerance", number(b.tolerance)}});
    power += b.emitted;
  }
  std::vector<double> corners;
  std::vector<std::size_t> sizes;
  for (const auto& element : f.corners) {
    corners.insert(corners.end(), element.begin(), element.end());
    sizes.push_back(element.size() / 3);
  }
  double brightest = 0, sum = 0, area = 0;
  for (const auto& element : f.corners) area += area_of(element);
  for (const double b : f.radiosity) {
    brightest = std::max(brightest, b);
    sum += b;
  }
  return {{"kind", "radiosity"},
          {"title", f.title},
          {"residuals", f.residuals},
          {"contraction", f.contraction},
          {"balance", balance},
          {"emitted", number(power)},
          {"brightest", number(brightest)},
          {"sum", number(sum)},
          {"area", number(area)},
          {"reduction", f.residuals.back() / f.residuals.front()},
          {"eye", f.eye},
          {"gaze", f.gaze},
          {"sizes", sizes},
          {"f64_corners", packed(corners)},
          {"f64_radiosity", packed(f.radiosity)}};
}

Json from(const ImagePair& p) {
  const ImageErrors e = errors_of(p);
  std::vector<double> difference(p.reference.size());
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] = p.ours[k] - p.reference[k];
  const auto flipped = flip(p.reference, p.ours, p.columns, p.rows);
  double brightness = 0;
  for (const float v : rounded(p.reference))
    brightness += static_cast<double>(v) / static_cast<double>(p.reference.size());
  const double share = e.worst == 0 ? 0 : e.worst / p.tolerance;
  double flip_mean = 0, flip_worst = 0;
  for (const float f : flipped) {
    flip_mean += static_cast<double>(f) / static_cast<double>(flipped.size());
    flip_worst = std::max(flip_worst, static_cast<double>(f));
  }
  return {{"kind", "images"},
          {"title", p.title},
          {"columns", p.columns},
          {"rows", p.rows},
          {"tolerance", p.tolerance},
          {"share", number(share)},
          {"brightness", number(brightness)},
          {"mean", number(e.mean)},
          {"median", number(e.median)},
          {"p95", number(e.p95)},
          {"p99", number(e.p99)},
          {"worst", number(e.worst)},
          {"worst_column", e.column},
          {"worst_row", e.row},
          {"nan", e.nan},
          {"infinite", e.infinite},
          {"flip_mean", flip_mean},
          {"flip_worst", flip_worst},
          {"f32_reference", packed(rounded(p.reference))},
          {"f32_difference", packed(rounded(difference))},
          {"f32_flip", packed(flipped)}};
}

}  // namespace

std::string figures_json(const std::vector<Exhibit>& exhibits) {
  Json all = Json::array();
  for (const Exhibit& shown : exhibits) {
    Json json{{"test", shown.test}};
    json.update(std::visit([](const auto& figure) { return from(figure); }, shown.figure));
    all.push_back(json);
  }
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace etendue::validation
