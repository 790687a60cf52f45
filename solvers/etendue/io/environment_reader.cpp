// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/environment_reader.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/reflectance/cube_names.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

std::string size_text(const Image& image) {
  return std::to_string(image.columns) + " × " + std::to_string(image.rows) + " pixels";
}

/// The first colour that is no light.
std::string fault(const Image& image) {
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      for (const double value : image.at(column, row)) {
        if (std::isfinite(value) && value >= 0) continue;
        return "has a value of " + shortest(value) + " in column " + std::to_string(column) + ", row " +
               std::to_string(row) + ", expected light: finite, not negative";
      }
    }
  }
  return {};
}

}  // namespace

Result<Done> EnvironmentFiles::add_face(const fs::path& stem, CubeFace face, CubeImages& images) {
  const std::string name = stem.string() + "." + face_name(face);
  std::error_code absent;
  const fs::path path = fs::exists(name + ".exr", absent) ? name + ".exr" : name + ".png";
  const auto bytes = read_file(path);
  if (!bytes) return Error{ErrorCode::input_output, bytes.error().message + " (nor is there an .exr of that name)"};
  const auto image = read_image(path);
  if (!image) return image.error();
  const auto unfit = [](const std::string& what) { return Error{ErrorCode::invalid_input, what}; };
  const std::string quoted = quoted_path(path);
  if (image->columns != image->rows || image->columns > kLargestCubeImage) {
    return unfit(quoted + " has " + size_text(*image) + ", expected a square of at most " +
                 std::to_string(kLargestCubeImage));
  }
  if (face != kCubeFaces.front() && image->columns != images.size)
    return unfit(quoted + " has " + size_text(*image) + ", expected " + std::to_string(images.size) +
                 " each way, as the first");
  if (const std::string wrong = fault(*image); !wrong.empty()) return unfit(quoted + " " + wrong);
  fingerprint_.add(*bytes).add(std::to_string(bytes->size()));
  files_.push_back(path);
  images.size = image->columns;
  images.pixels[static_cast<std::size_t>(face)] = image->pixels;
  return Done{};
}

std::shared_ptr<const CubeMap> EnvironmentFiles::read(const SceneNode& prefix) {
  const auto text = prefix.text();
  if (!text) return nullptr;
  const fs::path stem = (folder_ / *text).lexically_normal();
  if (const auto found = known_.find(stem); found != known_.end()) return found->second;
  auto& map = known_[stem];
  CubeImages images;
  for (const CubeFace face : kCubeFaces) {
    const auto added = add_face(stem, face, images);
    if (added) continue;
    const std::string message =
        "found \"" + printable(*text) +
        "\", expected the name of six images, to which .right, .left, .back, .front, .top, .bottom "
        "and .exr or .png are added: " +
        added.error().message;
    added.error().code == ErrorCode::input_output ? prefix.cannot_be_read(message) : prefix.complain(message);
    return nullptr;
  }
  map = std::make_shared<const CubeMap>(images);
  return map;
}

}  // namespace etendue
