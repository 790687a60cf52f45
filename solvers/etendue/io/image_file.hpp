// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/image/image.hpp"
#include "etendue/io/atomic_file.hpp"

namespace etendue {

/// Name and text of what a picture says about itself: version, scene hash, settings.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

/// One number more a pixel, besides red, green and blue, row by row.
struct ImageChannel {
  std::string name;
  std::vector<float> values;
};

/// Where a picture lies in a larger one, of which it is a part.
struct ImagePlace {
  int left, top;                  ///< column and row of its upper left pixel
  int whole_columns, whole_rows;  ///< size of the larger one
};

/// 2^28 pixels: 6 GiB of doubles. What a corrupt header claims is refused before it is allocated.
inline constexpr long long kMostImagePixels = 1LL << 28;

/// Writes a picture, complete or not at all (write_file()).
///
///     .exr   linear, 32-bit float, ZIP-compressed; each value rounded to the nearest float; metadata as attributes
///     .png   8-bit, sRGB-encoded: round(255 · srgb_encode(v)), v cut to [0, 1]; metadata as text chunks
///
/// Errors    usage: another extension. invalid_input: an empty image, a pixel that is NaN or infinite (named by column
///           and row) or too large for float. input_output: "cannot write 'path': reason", also when the module that
///           holds OpenImageIO (etendue_io) is missing.
[[nodiscard]] Result<Done> write_image(const std::filesystem::path& path, const Image& image,
                                       const ImageMetadata& metadata = {});

/// The bytes that write_image() would write to this path, of which only the extension matters: for files that are to
/// appear together (write_files()). An .exr can hold `further` channels, and says by its data window where in a larger
/// picture it lies.
///
/// Domain    each channel has as many values as the image has pixels, all finite; none for .png
[[nodiscard]] Result<NewFile> encode_image(const std::filesystem::path& path, const Image& image,
                                           const ImageMetadata& metadata = {},
                                           const std::vector<ImageChannel>& further = {},
                                           const std::optional<ImagePlace>& place = {});

/// Refuses an extension other than .exr and .png, and where the module that holds OpenImageIO is missing: to be asked
/// before a long computation, as check_writable() is.
[[nodiscard]] Result<Done> check_image_path(const std::filesystem::path& path);

/// Reads what write_image() wrote, or any other RGB (or grey, or RGBA without its alpha) .exr or .png; a PNG's values
/// are decoded to linear. The content must be of the kind that the extension says.
/// Errors    usage, input_output; invalid_input: more than `most_pixels`, whose memory is not asked for
[[nodiscard]] Result<Image> read_image(const std::filesystem::path& path, long long most_pixels = kMostImagePixels);

/// The channels of a picture after red, green and blue (or grey, or before, as the file has them), in the file's order.
[[nodiscard]] Result<std::vector<ImageChannel>> read_image_channels(const std::filesystem::path& path);

/// The metadata of a picture: its text attributes, in the file's order.
[[nodiscard]] Result<ImageMetadata> read_image_metadata(const std::filesystem::path& path);

/// sRGB transfer function (IEC 61966-2-1): linear light in [0, 1] to display value in [0, 1], and back.
[[nodiscard]] double srgb_encode(double linear);
[[nodiscard]] double srgb_decode(double encoded);

}  // namespace etendue
