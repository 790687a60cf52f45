// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "etendue/image/image.hpp"

// From what is computed to what a display shows: values without an upper end to values in [0, 1].
namespace etendue {

/// Luminance of linear RGB with the primaries and the white of ITU-R BT.709, which are those of sRGB, in the unit of the
/// channels: so weighted, white (1, 1, 1) has the luminance 1.
///
///     L = 0.2126 R + 0.7152 G + 0.0722 B
///
/// Source    Recommendation ITU-R BT.709-6, item 3.2
[[nodiscard]] double luminance(const Eigen::Array3d& rgb);

/// The geometric mean of the luminances of a picture: exp(mean of ln L) over the pixels with L > 0.
///
/// Returns   nothing where all pixels are black. Reinhard and others add a small δ to every L instead, so that black pixels
///           count, too: then the mean depends on the unit of the picture. Without, it is multiplied by f where the picture is
[[nodiscard]] std::optional<double> log_average_luminance(const Image& image);

enum class ToneOperator {
  linear,    ///< every value times the exposure
  key,       ///< linear, so that the log-average luminance becomes the key
  reinhard,  ///< the same, then luminances compressed to below one
};

/// The key of an ordinary scene: the reflectance of a grey that looks half as bright as white.
inline constexpr double kMiddleGrey = 0.18;

struct ToneMapping {
  ToneOperator tone = ToneOperator::linear;
  double exposure = 1;
  double key = kMiddleGrey;                                ///< a
  double white = std::numeric_limits<double>::infinity();  ///< L_white: the least scaled luminance that becomes white
};

struct ToneMapped {
  Image picture;
  double scale = 1;  ///< s: what values were multiplied by, before the compression
};

/// The picture as a display is to show it; what is above one then is cut by the file (image_file.hpp).
///
///     linear     s = exposure;                          c' = s c
///     key        s = exposure · a / L_avg;              c' = s c
///     reinhard   s as by key, L = s · luminance(c);     c' = s c (1 + L / L_white²) / (1 + L)
///
/// Symbols   c a channel of a pixel; a key; L_avg log_average_luminance(). Channels keep their ratios: only the luminance
///           is compressed, to below 1 without a white point. A saturated colour may have a channel above 1 all the same
/// Domain    exposure, key, white > 0
/// Returns   by key and by Reinhard the same picture for f · image as for image, up to rounding: the unit and the strength of
///           the light have no part in it; a black picture stays black (s = exposure)
/// Source    Reinhard and others 2002, equations 1 to 4, doi 10.1145/566654.566575
[[nodiscard]] ToneMapped tone_mapped(const Image& image, const ToneMapping& mapping);

}  // namespace etendue
