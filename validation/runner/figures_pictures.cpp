// SPDX-License-Identifier: Apache-2.0
#include "runner/figures_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <tuple>

#include "etendue/io/byte_text.hpp"
#include "runner/figures_curves.hpp"
#include "support/flip.hpp"

namespace etendue::validation {

namespace {

using Pixels = std::vector<unsigned char>;
using Triple = std::array<double, 3>;

/// Pairs with the widest bounds that the page lists.
constexpr std::size_t kWorstPairs = 10;
/// Decades of form factors that the map shows.
constexpr double kDecades = 6;

unsigned char shown(double linear) {
  const double v = linear > 0 ? std::min(linear, 1.0) : 0;
  return static_cast<unsigned char>(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055) + 0.5);
}

std::string picture(const Pixels& pixels, int columns, int rows, const std::string& words) {
  return "<img class=\"still\" width=\"" + std::to_string(columns) + "\" height=\"" + std::to_string(rows) +
         "\" alt=\"" + escaped(words) + "\" src=\"" + picture_address(pixels, columns, rows) + "\">";
}

std::string fact(const std::string& name, const std::string& text) {
  return "<dt>" + name + "</dt><dd>" + text + "</dd>";
}

std::string cell(const std::string& text) {
  return "<td class=\"number\">" + text + "</td>";
}

std::string table(const std::vector<std::string>& heads, const std::string& rows) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + heads.front() + "\"><table><thead><tr>";
  for (const auto& head : heads) html += "<th scope=\"col\">" + head + "</th>";
  return html + "</tr></thead><tbody>" + rows + "</tbody></table></div>";
}

Triple minus(const Triple& a, const Triple& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Triple& a, const Triple& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Triple unit(const Triple& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Elements that show the eye their front and are before it as a whole, the farthest first, painted over one another.
std::string projected(const RadiosityField& f) {
  constexpr double kNear = 0.05, kFocal = 330;
  const Triple eye{f.eye[0], f.eye[1], f.eye[2]}, gaze{f.gaze[0], f.gaze[1], f.gaze[2]};
  const Triple x = unit(cross(gaze, {0, 0, 1})), y = cross(x, gaze);
  double mean = 0;
  for (const double b : f.radiosity) mean += b / static_cast<double>(f.radiosity.size());
  std::vector<std::pair<double, std::string>> faces;
  for (std::size_t k = 0; k < f.corners.size(); ++k) {
    const auto corner = [&](std::size_t c) {
      return minus({f.corners[k][3 * c], f.corners[k][3 * c + 1], f.corners[k][3 * c + 2]}, eye);
    };
    if (dot(cross(minus(corner(1), corner(0)), minus(corner(2), corner(0))), corner(0)) >= 0) continue;
    double depth = 0;
    std::string points;
    bool ahead = true;
    for (std::size_t c = 0; c < f.corners[k].size() / 3; ++c) {
      const Triple p = corner(c);
      const double z = dot(p, gaze);
      ahead = ahead && z > kNear;
      depth += z * 3 / static_cast<double>(f.corners[k].size());
      points += short_number(240 + kFocal * dot(p, x) / z) + "," + short_number(180 - kFocal * dot(p, y) / z) + " ";
    }
    if (!ahead) continue;
    std::array<char, 16> colour{};
    const auto channel = [&](std::size_t c) {
      return static_cast<unsigned>(shown(0.4 * f.radiosity[3 * k + c] / mean));
    };
    std::snprintf(colour.data(), colour.size(), "#%02x%02x%02x", channel(0), channel(1), channel(2));
    faces.emplace_back(depth, "<polygon points=\"" + points + "\" fill=\"" + colour.data() + "\"/>");
  }
  std::stable_sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string svg =
      "<svg class=\"still room\" viewBox=\"0 0 480 360\" role=\"img\" aria-label=\"The elements in their colours\">";
  for (const auto& [depth, face] : faces) svg += face;
  return svg + "</svg>";
}

std::string residual_rows(const std::vector<double>& residuals) {
  std::string rows;
  for (std::size_t i = 0; i < residuals.size(); ++i)
    rows += "<tr>" + cell(std::to_string(i + 1)) + cell(short_number(residuals[i])) + "</tr>";
  return rows;
}

}  // namespace

std::string picture_address(const Pixels& pixels, int columns, int rows) {
  const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows),
             line = (3 * width + 3) / 4 * 4;
  std::string file = "BM";
  const auto put = [&](std::size_t value, int bytes) {
    for (int k = 0; k < bytes; ++k) file += static_cast<char>(value >> (8 * k) & 0xFF);
  };
  for (const std::size_t value : {54 + line * height, std::size_t{0}, std::size_t{54}, std::size_t{40}, width, height})
    put(value, 4);
  put(1, 2);
  put(24, 2);
  for (int k = 0; k < 6; ++k) put(0, 4);
  for (std::size_t row = height; row-- > 0;) {
    for (std::size_t c = 0; c < width; ++c) {
      for (std::size_t k = 3; k-- > 0;) put(pixels[3 * (row * width + c) + k], 1);
    }
    for (std::size_t k = 3 * width; k < line; ++k) put(0, 1);
  }
  return "data:image/bmp;base64," + base64(file);
}

std::string picture_html(const FactorTable& t) {
  const std::size_t n = t.areas.size();
  const FactorDefects defects = defects_of(t);
  Pixels map;
  std::vector<std::tuple<double, std::size_t, std::size_t>> wide;
  for (std::size_t k = 0; k < n * n; ++k) {
    const double level = t.factors[k] > 0 ? std::clamp(1 + std::log10(t.factors[k]) / kDecades, 0.0, 1.0) : 0;
    map.insert(map.end(), 3, static_cast<unsigned char>(255 - 255 * level));
    wide.emplace_back(-t.bounds[k], k / n, k % n);
  }
  const std::size_t listed = std::min(kWorstPairs, wide.size());
  std::partial_sort(wide.begin(), wide.begin() + static_cast<std::ptrdiff_t>(listed), wide.end());
  std::string rows;
  for (std::size_t k = 0; k < listed; ++k) {
    const auto& [bound, i, j] = wide[k];
    rows += "<tr>" + cell(std::to_string(i)) + cell(std::to_string(j)) + cell(short_number(t.factors[i * n + j])) +
            cell(short_number(-bound)) + "</tr>";
  }
  return "<dl>" + fact("Elements", std::to_string(n) + ", of them " + std::to_string(t.covered.size()) + " covered") +
         fact("Rows miss 1 by", short_number(defects.closure) + " at most") +
         fact("Reciprocity is missed by", short_number(defects.reciprocity) + " m² at most") +
         fact("Widest bound", short_number(defects.widest)) + "</dl><div class=\"stage\">" +
         picture(map, static_cast<int>(n), static_cast<int>(n),
                 "Form factors, row by row; black is 1, white 1e-6 and less") +
         "</div><h4>Worst pairs: the widest bounds</h4>" + table({"From", "To", "Factor", "Bound"}, rows);
}

std::string picture_html(const RadiosityField& f) {
  constexpr std::array kChannels = {"red", "green", "blue"};
  std::string balance;
  for (std::size_t c = 0; c < f.balance.size(); ++c) {
    const Balance& b = f.balance[c];
    balance += "<tr><th scope=\"row\">" + std::string(kChannels[c % 3]) + "</th>" + cell(short_number(b.emitted)) +
               cell(short_number(b.absorbed)) + cell(short_number(b.escaped)) +
               cell(short_number(b.emitted - b.absorbed - b.escaped)) + cell(short_number(b.tolerance)) + "</tr>";
  }
  return "<div class=\"stage\">" + projected(f) + "</div><h4>Where the power goes</h4>" +
         table({"Channel", "Emitted [W]", "Absorbed [W]", "Escaped [W]", "Left over [W]", "Tolerance [W]"}, balance) +
         "<h4>Residual of Jacobi's steps, red</h4>" + residual_svg(f.residuals) +
         "<details><summary>Numbers</summary>" +
         table({"Step", "Largest residual [W/m²]"}, residual_rows(f.residuals)) + "</details>";
}

std::string picture_html(const ImagePair& p) {
  const ImageErrors e = errors_of(p);
  Pixels reference, ours;
  for (std::size_t k = 0; k < p.reference.size(); ++k) {
    reference.push_back(shown(p.reference[k]));
    ours.push_back(shown(p.ours[k]));
  }
  double flip_mean = 0;
  const auto flipped = flip(p.reference, p.ours, p.columns, p.rows);
  for (const float f : flipped) flip_mean += static_cast<double>(f) / static_cast<double>(flipped.size());
  return "<dl>" +
         fact("Difference", "mean " + short_number(e.mean) + ", median " + short_number(e.median) + ", 95 % below " +
                                short_number(e.p95) + ", 99 % below " + short_number(e.p99) + ", largest " +
                                short_number(e.worst)) +
         fact("Worst pixel", "column " + std::to_string(e.column) + ", row " + std::to_string(e.row)) +
         fact("Tolerance", short_number(p.tolerance)) +
         fact("Not numbers", std::to_string(e.nan) + " NaN, " + std::to_string(e.infinite) + " infinite") +
         fact("ꟻLIP", short_number(flip_mean) +
                          " in the mean: what a person sees who flips between the two, 0 nothing, 1 all") +
         "</dl><div class=\"stage pair\"><figure>" + picture(reference, p.columns, p.rows, "What it should be") +
         "<figcaption>Reference</figcaption></figure><figure>" + picture(ours, p.columns, p.rows, "What was rendered") +
         "<figcaption>Ours</figcaption></figure></div>";
}

}  // namespace etendue::validation
