// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/image_file.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <optional>

#include "etendue/core/contract.hpp"
#include "etendue/io/image_module.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

/// Of a pixel: colours, and what a renderer tells besides.
constexpr int kMostChannels = 64;

enum class Format { exr, png };

constexpr const char* reader_name(Format format) {
  return format == Format::exr ? "openexr" : "png";
}

std::optional<Format> format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& letter : extension) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  if (extension == ".exr") return Format::exr;
  if (extension == ".png") return Format::png;
  return std::nullopt;
}

Error failure(const char* verb, const fs::path& path, const std::string& reason) {
  return {ErrorCode::input_output, std::string("cannot ") + verb + " " + quoted_path(path) + ": " + printable(reason)};
}

Error unknown_format(const fs::path& path) {
  return {ErrorCode::usage, "image " + quoted_path(path) + ": found extension " + quoted_path(path.extension()) +
                                ", expected .exr or .png"};
}

Error unfit(const fs::path& path, const std::string& what) {
  return {ErrorCode::invalid_input, "image " + quoted_path(path) + ": " + what};
}

/// The first pixel that no format can hold, if any: a NaN in a picture is a defect upstream, not a colour.
std::optional<std::string> find_unfit_pixel(const Image& image) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const Eigen::Array3d& pixel = image.at(column, row);
      for (int channel = 0; channel < 3; ++channel) {
        if (std::abs(pixel[channel]) <= kLargest) continue;
        return "pixel (column " + std::to_string(column) + ", row " + std::to_string(row) + ") channel " +
               std::to_string(channel) + ": found " + std::to_string(pixel[channel]) + ", expected a finite float";
      }
    }
  }
  return std::nullopt;
}

/// Nearest of 256 levels; values outside [0, 1] take the nearest end (a display shows no more).
unsigned char display_byte(double linear) {
  const double level = srgb_encode(std::fmin(std::fmax(linear, 0), 1)) * 255;
  return static_cast<unsigned char>(std::lround(level));
}

std::vector<float> linear_samples(const Image& image, const std::vector<ImageChannel>& further) {
  std::vector<float> samples;
  samples.reserve(image.pixels.size() * (3 + further.size()));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) samples.push_back(static_cast<float>(image.pixels[i][channel]));
    for (const ImageChannel& channel : further) samples.push_back(channel.values[i]);
  }
  return samples;
}

std::vector<unsigned char> display_samples(const Image& image) {
  std::vector<unsigned char> samples;
  samples.reserve(image.pixels.size() * 3);
  for (const auto& pixel : image.pixels) {
    for (int channel = 0; channel < 3; ++channel) samples.push_back(display_byte(pixel[channel]));
  }
  return samples;
}

/// What the module hands back.
struct Picture {
  int columns = 0, rows = 0, channels = 0;
  std::vector<float> samples;
  std::vector<std::string> names;
  ImageMetadata metadata;
  long long most_pixels = kMostImagePixels;
};

float* allocate(void* context, int columns, int rows, int channels) {
  const long long pixels = static_cast<long long>(columns) * rows;
  auto& picture = *static_cast<Picture*>(context);
  picture.columns = columns;
  picture.rows = rows;
  picture.channels = channels;
  if (columns < 1 || rows < 1 || channels < 1 || channels > kMostChannels || pixels > picture.most_pixels) {
    return nullptr;
  }
  try {
    picture.samples.resize(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(channels));
  } catch (const std::bad_alloc&) {  // must not cross the C interface
    return nullptr;
  }
  return picture.samples.data();
}

void keep_name(void* context, const char* name) {
  static_cast<Picture*>(context)->names.emplace_back(name);
}

void keep_attribute(void* context, const char* name, const char* text) {
  static_cast<Picture*>(context)->metadata.emplace_back(name, text);
}

bool keep_bytes(void* context, const unsigned char* bytes, unsigned long long count) {
  try {
    static_cast<std::string*>(context)->assign(reinterpret_cast<const char*>(bytes), count);
  } catch (const std::bad_alloc&) {  // must not cross the C interface
    return false;
  }
  return true;
}

Result<Picture> read_picture(const fs::path& path, long long most_pixels = kMostImagePixels) {
  const auto format = format_of(path);
  if (!format) return unknown_format(path);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return failure("read", path, error ? error.message() : "No such file or directory");
  if (!fs::is_regular_file(status)) {
    return failure("read", path, fs::is_directory(status) ? "is a directory" : "not a regular file");
  }
  auto module = image_module();
  if (!module) return module.error();
  Picture picture;
  picture.most_pixels = most_pixels;
  std::array<char, 400> reason{};
  const bool read = (*module)->read(path.c_str(), reader_name(*format), &picture, allocate, keep_name, keep_attribute,
                                    reason.data(), static_cast<int>(reason.size()));
  const bool too_large = static_cast<long long>(picture.columns) * picture.rows > most_pixels;
  if (too_large && most_pixels < kMostImagePixels) {
    return unfit(path, "found " + std::to_string(picture.columns) + " × " + std::to_string(picture.rows) +
                           " pixels, expected at most " + std::to_string(most_pixels));
  }
  if (!read) return failure("read", path, reason.data());
  return picture;
}

}  // namespace

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Result<Done> check_image_path(const fs::path& path) {
  if (!format_of(path)) return unknown_format(path);
  if (const auto module = image_module(); !module) return module.error();
  return Done{};
}

Result<Done> write_image(const fs::path& path, const Image& image, const ImageMetadata& metadata) {
  const auto file = encode_image(path, image, metadata);
  if (!file) return file.error();
  return write_files({*file});
}

Result<NewFile> encode_image(const fs::path& path, const Image& image, const ImageMetadata& metadata,
                             const std::vector<ImageChannel>& further, const std::optional<ImagePlace>& place) {
  if (auto fit = check_image_path(path); !fit) return fit.error();
  if (image.columns < 1 || image.rows < 1) return unfit(path, "has no pixels");
  if (const auto pixel = find_unfit_pixel(image)) return unfit(path, *pixel);
  auto module = image_module();
  if (!module) return module.error();

  const Format format = *format_of(path);
  std::vector<const char*> names{"R", "G", "B"};
  for (const ImageChannel& channel : further) {
    require(format == Format::exr && channel.values.size() == image.pixels.size(),
            "encode_image: further channels go to .exr and have a value a pixel");
    names.push_back(channel.name.c_str());
  }
  std::vector<float> linear;
  std::vector<unsigned char> bytes;
  const ImagePlace at = place.value_or(ImagePlace{0, 0, image.columns, image.rows});
  EtendueSamples samples{
      image.columns,    image.rows,   static_cast<int>(names.size()), nullptr, nullptr, nullptr, at.left, at.top,
      at.whole_columns, at.whole_rows};
  if (format == Format::exr) {
    linear = linear_samples(image, further);
    samples.linear = linear.data();
    samples.names = names.data();
  } else {
    bytes = display_samples(image);
    samples.bytes = bytes.data();
  }
  std::vector<const char*> texts;
  for (const auto& [name, text] : metadata) {
    texts.push_back(name.c_str());
    texts.push_back(text.c_str());
  }
  NewFile file{path, {}};
  std::array<char, 400> reason{};
  const bool encoded = (*module)->write(reader_name(format), &samples, texts.data(), static_cast<int>(metadata.size()),
                                        &file.bytes, keep_bytes, reason.data(), static_cast<int>(reason.size()));
  if (!encoded) return failure("write", path, reason.data());
  return file;
}

Result<Image> read_image(const fs::path& path, long long most_pixels) {
  auto picture = read_picture(path, most_pixels);
  if (!picture) return picture.error();
  const auto channels = static_cast<std::size_t>(picture->channels);
  const bool coloured = channels >= 3;  // otherwise grey, perhaps with alpha
  const bool encoded = format_of(path) == Format::png;
  Image image(picture->columns, picture->rows);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double sample = picture->samples[i * channels + (coloured ? channel : 0)];
      image.pixels[i][static_cast<Eigen::Index>(channel)] = encoded ? srgb_decode(sample) : sample;
    }
  }
  return image;
}

Result<std::vector<ImageChannel>> read_image_channels(const fs::path& path) {
  auto picture = read_picture(path);
  if (!picture) return picture.error();
  std::vector<ImageChannel> channels;
  for (std::size_t channel = 3; channel < picture->names.size(); ++channel) {
    channels.push_back({picture->names[channel], {}});
    for (std::size_t i = channel; i < picture->samples.size(); i += picture->names.size())
      channels.back().values.push_back(picture->samples[i]);
  }
  return channels;
}

Result<ImageMetadata> read_image_metadata(const fs::path& path) {
  auto picture = read_picture(path);
  if (!picture) return picture.error();
  return picture->metadata;
}

}  // namespace etendue
