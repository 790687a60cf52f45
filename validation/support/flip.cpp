// SPDX-License-Identifier: Apache-2.0
#include "support/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "etendue/core/contract.hpp"

namespace etendue::validation {

namespace {

using Triple = std::array<double, 3>;
constexpr double kPi = std::numbers::pi;

// Exponents and knee of the colour difference, exponent of the features', width of a feature in degrees: the paper's §4.
constexpr double kColourPower = 0.7, kKnee = 0.4, kKneeValue = 0.95, kFeaturePower = 0.5, kFeatureWidth = 0.082;

// XYZ of linear sRGB: from the primaries and D65 of IEC 61966-2-1, as fractions.
constexpr double kToXyz[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                 {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                 {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

Triple times(const double (&matrix)[3][3], const Triple& v) {
  Triple product{};
  for (std::size_t i = 0; i < 3; ++i) product[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  return product;
}

/// X/X_n, Y/Y_n, Z/Z_n.
Triple relative_xyz(const Triple& rgb) {
  const Triple white = times(kToXyz, {1, 1, 1});
  Triple xyz = times(kToXyz, rgb);
  for (std::size_t i = 0; i < 3; ++i) xyz[i] /= white[i];
  return xyz;
}

/// By Cramer's rule.
Triple rgb_of_relative(const Triple& relative) {
  const Triple white = times(kToXyz, {1, 1, 1});
  const auto& m = kToXyz;
  const auto determinant = [](const Triple& a, const Triple& b, const Triple& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
  };
  const Triple r{m[0][0], m[1][0], m[2][0]}, g{m[0][1], m[1][1], m[2][1]}, b{m[0][2], m[1][2], m[2][2]};
  const Triple v{relative[0] * white[0], relative[1] * white[1], relative[2] * white[2]};
  const double d = determinant(r, g, b);
  return {determinant(v, g, b) / d, determinant(r, v, b) / d, determinant(r, g, v) / d};
}

double lab_curve(double t) {
  constexpr double kDelta = 6.0 / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
}

double redistributed(double distance) {
  const double most = std::pow(hunt_adjusted_distance(lab_of_linear(0, 1, 0), lab_of_linear(0, 0, 1)), kColourPower);
  const double knee = kKnee * most, power = std::pow(distance, kColourPower);
  if (power < knee) return kKneeValue / knee * power;
  return std::min(1.0, kKneeValue + (power - knee) / (most - knee) * (1 - kKneeValue));
}

/// Square weights, (2 radius + 1) on a side.
struct Kernel {
  int radius;
  std::vector<double> weights;
};

template <class Weight>
Kernel kernel(int radius, Weight&& weight) {
  Kernel made{radius, {}};
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) made.weights.push_back(weight(x, y));
  }
  return made;
}

/// Positive weights are made to sum to 1, negative ones to −1.
Kernel normalised(Kernel raw) {
  double positive = 0, negative = 0;
  for (const double w : raw.weights) (w > 0 ? positive : negative) += w;
  for (double& w : raw.weights) w /= w > 0 ? positive : -negative;
  return raw;
}

struct Sensitivity {
  double a1, b1, a2, b2;
};
// Of Y, Cx, Cz: the paper's table 1.
constexpr Sensitivity kSensitivities[3] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

Kernel contrast_kernel(const Sensitivity& s, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixels_per_degree));
  return normalised(kernel(radius, [&](int x, int y) {
    const double square = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
    return s.a1 * std::sqrt(kPi / s.b1) * std::exp(-kPi * kPi * square / s.b1) +
           s.a2 * std::sqrt(kPi / s.b2) * std::exp(-kPi * kPi * square / s.b2);
  }));
}

/// First and second derivative of a Gaussian along x: what answers to edges and to points.
struct FeatureKernels {
  Kernel edge, point;
};
FeatureKernels feature_kernels(double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gauss = [&](int x, int y) { return std::exp(-(x * x + y * y) / (2 * sigma * sigma)); };
  return {normalised(kernel(radius, [&](int x, int y) { return -x * gauss(x, y); })),
          normalised(kernel(radius, [&](int x, int y) { return (x * x / (sigma * sigma) - 1) * gauss(x, y); }))};
}

/// One channel of a picture; beyond its border the border's pixels go on.
struct Plane {
  int columns, rows;
  std::vector<double> values;

  double at(int column, int row) const {
    const int c = std::clamp(column, 0, columns - 1), r = std::clamp(row, 0, rows - 1);
    return values[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
  }
};

enum class Along { rows, columns };

double weighted(const Plane& plane, const Kernel& weights, int column, int row, Along along) {
  double sum = 0;
  const double* w = weights.weights.data();
  for (int y = -weights.radius; y <= weights.radius; ++y) {
    for (int x = -weights.radius; x <= weights.radius; ++x, ++w)
      sum += *w * (along == Along::rows ? plane.at(column + x, row + y) : plane.at(column + y, row + x));
  }
  return sum;
}

/// Y, Cx, Cz: CIELAB without its cube roots.
std::array<Plane, 3> opponent_planes(const std::vector<double>& rgb, int columns, int rows) {
  std::array<Plane, 3> planes;
  for (Plane& plane : planes) plane = {columns, rows, {}};
  for (std::size_t k = 0; k < rgb.size(); k += 3) {
    Triple shown{};
    for (std::size_t c = 0; c < 3; ++c) shown[c] = rgb[k + c] > 0 ? std::min(rgb[k + c], 1.0) : 0;
    const Triple xyz = relative_xyz(shown);
    planes[0].values.push_back(116 * xyz[1] - 16);
    planes[1].values.push_back(500 * (xyz[0] - xyz[1]));
    planes[2].values.push_back(200 * (xyz[1] - xyz[2]));
  }
  return planes;
}

Lab seen_colour(const std::array<Plane, 3>& planes, const std::array<Kernel, 3>& kernels, int column, int row) {
  Triple c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = weighted(planes[i], kernels[i], column, row, Along::rows);
  const double y = (c[0] + 16) / 116;
  Triple rgb = rgb_of_relative({y + c[1] / 500, y, y - c[2] / 200});
  for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
  return lab_of_linear(rgb[0], rgb[1], rgb[2]);
}

struct Features {
  double edge, point;
};
Features features_at(const Plane& luminance, const FeatureKernels& kernels, int column, int row) {
  const auto length = [&](const Kernel& k) {
    return std::hypot(weighted(luminance, k, column, row, Along::rows),
                      weighted(luminance, k, column, row, Along::columns));
  };
  return {length(kernels.edge), length(kernels.point)};
}

Plane luminance_of(const Plane& y) {
  Plane luminance = y;
  for (double& value : luminance.values) value = (value + 16) / 116;
  return luminance;
}

}  // namespace

Lab lab_of_linear(double red, double green, double blue) {
  const Triple xyz = relative_xyz({red, green, blue});
  const double x = lab_curve(xyz[0]), y = lab_curve(xyz[1]), z = lab_curve(xyz[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double hunt_adjusted_distance(const Lab& one, const Lab& other) {
  const double a = 0.01 * (one.l * one.a - other.l * other.a), b = 0.01 * (one.l * one.b - other.l * other.b);
  return std::abs(one.l - other.l) + std::hypot(a, b);
}

double flip_of_colours(const Lab& one, const Lab& other) {
  return redistributed(hunt_adjusted_distance(one, other));
}

std::vector<float> flip(const std::vector<double>& reference, const std::vector<double>& test, int columns, int rows,
                        double pixels_per_degree) {
  const auto values = 3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  require(reference.size() == values && test.size() == values, "flip: both pictures have 3 · columns · rows values");
  std::array<Kernel, 3> contrast;
  for (std::size_t i = 0; i < 3; ++i) contrast[i] = contrast_kernel(kSensitivities[i], pixels_per_degree);
  const FeatureKernels features = feature_kernels(pixels_per_degree);
  const auto one = opponent_planes(reference, columns, rows), other = opponent_planes(test, columns, rows);
  const Plane one_light = luminance_of(one[0]), other_light = luminance_of(other[0]);
  std::vector<float> map;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double colour =
          flip_of_colours(seen_colour(one, contrast, column, row), seen_colour(other, contrast, column, row));
      const Features f = features_at(one_light, features, column, row),
                     g = features_at(other_light, features, column, row);
      const double feature = std::max(std::abs(f.edge - g.edge), std::abs(f.point - g.point));
      const double share = std::min(1.0, std::pow(feature / std::numbers::sqrt2, kFeaturePower));
      map.push_back(static_cast<float>(colour == 0 ? 0 : std::pow(colour, 1 - share)));
    }
  }
  return map;
}

}  // namespace etendue::validation
