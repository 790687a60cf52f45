// SPDX-License-Identifier: Apache-2.0
#include "runner/figures_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace etendue::validation {

namespace {

// A drawing is 480 by 300; the frame inside of it.
constexpr double kHeight = 300, kLeft = 62, kRight = 468, kTop = 12, kBottom = 252;

struct Range {
  double low, high;
};

/// Where the logarithm of `value` lies between those of the range's ends.
double placed(double value, const Range& range, double from, double to) {
  return from + (to - from) * (std::log10(value) - range.low) / (range.high - range.low);
}

Range decades(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double a = std::log10(*low), b = std::log10(*high), margin = 0.08 * (b - a) + 0.05;
  return {a - margin, b + margin};
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return "<line x1=\"" + short_number(x1) + "\" y1=\"" + short_number(y1) + "\" x2=\"" + short_number(x2) + "\" y2=\"" +
         short_number(y2) + "\" class=\"" + kind + "\"/>";
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + short_number(x) + "\" y=\"" + short_number(y) + "\" text-anchor=\"" + anchor + "\">" + text +
         "</text>";
}

std::string drawing(const std::string& name, const std::string& inner) {
  return "<svg class=\"curve\" viewBox=\"0 0 480 300\" role=\"img\" aria-label=\"" + name + "\">" + inner + "</svg>\n";
}

std::string axes(const Range& x, const Range& y) {
  std::string svg;
  const auto step = [](const Range& r) { return std::max(1.0, std::ceil((r.high - r.low) / 6)); };
  for (double decade = std::ceil(y.low); decade <= y.high; decade += step(y)) {
    const double at = placed(std::pow(10, decade), y, kBottom, kTop);
    svg += line(kLeft, at, kRight, at, "grid") + label(kLeft - 6, at + 4, "end", "10^" + short_number(decade));
  }
  for (double power = std::ceil(x.low / std::log10(2)); power * std::log10(2) <= x.high;
       power += step({x.low / std::log10(2), x.high / std::log10(2)})) {
    const double at = placed(std::exp2(power), x, kLeft, kRight);
    svg += line(at, kTop, at, kBottom, "grid") + label(at, kBottom + 18, "middle", "2^" + short_number(power));
  }
  return svg;
}

}  // namespace

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string residual_svg(const std::vector<double>& residuals) {
  const Range y = decades(residuals);
  const double each = (kRight - kLeft) / static_cast<double>(residuals.size());
  std::string svg, points;
  for (double decade = std::ceil(y.low); decade <= y.high; ++decade) {
    const double at = placed(std::pow(10, decade), y, kBottom, kTop);
    svg += line(kLeft, at, kRight, at, "grid") + label(kLeft - 6, at + 4, "end", "10^" + short_number(decade));
  }
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double x = kLeft + each * (static_cast<double>(i) + 0.5);
    points += short_number(x) + "," + short_number(placed(residuals[i], y, kBottom, kTop)) + " ";
    if (i % 4 == 0) svg += label(x, kBottom + 18, "middle", std::to_string(i + 1));
  }
  svg += "<polyline points=\"" + points + "\"/>" + label((kLeft + kRight) / 2, kHeight - 8, "middle", "step");
  return drawing("Largest residual after each step, as logarithms; the table below has the numbers", svg);
}

std::string curve_html(const Convergence& c) {
  const Range x = decades(c.sizes), y = decades(c.errors);
  std::string svg = axes(x, y);
  // The expected slope through the points' middle, in logarithms; and the line that fits them.
  double middle_x = 0, middle_y = 0;
  for (std::size_t i = 0; i < c.sizes.size(); ++i) {
    middle_x += std::log10(c.sizes[i]) / static_cast<double>(c.sizes.size());
    middle_y += std::log10(c.errors[i]) / static_cast<double>(c.sizes.size());
  }
  for (const auto& [slope, kind] : {std::pair(c.slope, "expected"), std::pair(fitted_slope(c), "fitted")}) {
    const auto at = [&, k = slope](double log) {
      return placed(std::pow(10, middle_y + k * (log - middle_x)), y, kBottom, kTop);
    };
    svg += line(kLeft, at(x.low), kRight, at(x.high), kind);
  }
  std::string rows;
  for (std::size_t i = 0; i < c.sizes.size(); ++i) {
    svg += "<circle cx=\"" + short_number(placed(c.sizes[i], x, kLeft, kRight)) + "\" cy=\"" +
           short_number(placed(c.errors[i], y, kBottom, kTop)) + "\" r=\"4\"/>";
    rows += "<tr><td class=\"number\">" + short_number(c.sizes[i]) + "</td><td class=\"number\">" +
            short_number(c.errors[i]) + "</td></tr>";
  }
  svg += label((kLeft + kRight) / 2, kHeight - 8, "middle", escaped(c.size_name));
  return drawing("Errors over sizes, both as logarithms; the table below has the numbers", svg) + "<p>Slope " +
         short_number(fitted_slope(c)) + " fitted (line); expected " + short_number(c.slope) + " ± " +
         short_number(c.tolerance) +
         " (dashed).</p><details><summary>Numbers</summary><table><thead><tr><th scope=\"col\">" +
         escaped(c.size_name) + "</th><th scope=\"col\">Error</th></tr></thead><tbody>" + rows +
         "</tbody></table></details>";
}

std::string curve_html(const ErrorHistogram& h) {
  const auto& counts = h.counts();
  const double most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  const double each = (kRight - kLeft) / static_cast<double>(counts.size());
  const double scale = most > 0 ? (kBottom - kTop) / std::log10(1 + most) : 0;
  std::string svg, rows;
  for (double tens = 1; tens <= most; tens *= 10) {
    const double at = kBottom - scale * std::log10(1 + tens);
    svg += line(kLeft, at, kRight, at, "grid") + label(kLeft - 6, at + 4, "end", short_number(tens));
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double height = scale * std::log10(1 + static_cast<double>(counts[i]));
    const double low = static_cast<double>(i) * h.width(), x = kLeft + static_cast<double>(i) * each;
    svg += "<rect x=\"" + short_number(x + 1) + "\" y=\"" + short_number(kBottom - height) + "\" width=\"" +
           short_number(each - 2) + "\" height=\"" + short_number(height) + "\"/>";
    if (i % 4 == 0) svg += label(x, kBottom + 18, "middle", short_number(low));
    if (counts[i] > 0)
      rows += "<tr><td class=\"number\">" + short_number(low) +
              (i + 1 < counts.size() ? " to " + short_number(low + h.width()) : " and more") +
              "</td><td class=\"number\">" + std::to_string(counts[i]) + "</td></tr>";
  }
  svg += label((kLeft + kRight) / 2, kHeight - 8, "middle", "error in " + escaped(h.unit()));
  return drawing("How often an error had how many units, counts as logarithms; the table below has the numbers", svg) +
         "<p>" + std::to_string(h.total()) + " errors, the worst " + short_number(h.worst()) + " " + escaped(h.unit()) +
         ".</p><details><summary>Numbers</summary><table><thead><tr><th scope=\"col\">" + escaped(h.unit()) +
         "</th><th scope=\"col\">Errors</th></tr></thead><tbody>" + rows + "</tbody></table></details>";
}

std::string curve_html(const WorstInput& w) {
  return "<p>Error/tolerance " + short_number(w.share) + " there. <code class=\"copy\">" + escaped(w.command) +
         "</code></p>";
}

}  // namespace etendue::validation
