// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/texture_reader.hpp"

#include "etendue/geometry/meeting.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

constexpr long kMostSquares = 1L << 20;  // along an edge: finer than any picture
constexpr long kLargestSeed = 1L << 53;  // up to there numbers of a file are whole
constexpr ValueRange kTiles{-1e6, 1e6};
/// Sine of the angle that two directions of a few digits leave.
constexpr double kLeastSine = 1e-6;

/// The first texel that is no share of light, if any.
std::optional<std::string> find_unfit_texel(const Image& image) {
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      for (const double value : image.at(column, row)) {
        if (value >= 0 && value <= 1) continue;
        return "found a value of " + shortest(value) + " in column " + std::to_string(column) + ", row " +
               std::to_string(row) + " of the image, expected values in [0, 1]: colours that k_d is multiplied by";
      }
    }
  }
  return std::nullopt;
}

Vec3 point(const SceneNode& node, const char* key, double scale) {
  const auto member = node.member(key);
  return member ? Vec3(scale * member->vector().value_or(Vec3::Zero())) : Vec3(Vec3::Zero());
}

double length(const SceneNode& node, const char* key, double scale) {
  const auto member = node.member(key);
  return scale * (member ? member->number(kPositive).value_or(1) : 1);
}

/// "pole" and, turned across it, "equator".
PatternFrame read_frame(const SceneNode& node) {
  PatternFrame frame;
  const auto pole = node.member("pole"), equator = node.member("equator");
  if (pole) frame.pole = pole->direction().value_or(frame.pole);
  frame.equator = tangent_frame(frame.pole).u;
  const auto towards = equator ? equator->direction() : std::nullopt;
  if (!towards) return frame;
  const Vec3 across = *towards - frame.pole.dot(*towards) * frame.pole;
  if (across.norm() > kLeastSine) {
    const Vec3 rough =
        across.normalized();  // once more: of a short rest the first projection leaves a part along the pole
    frame.equator = (rough - frame.pole.dot(rough) * frame.pole).normalized();
  } else {
    equator->complain("found \"equator\" along \"pole\", expected a direction across it");
  }
  return frame;
}

std::optional<LaidPattern> read_mapping(const SceneNode& node, double scale) {
  const auto type = node.kind(mapping_types());
  std::vector<std::string> names;
  for (const std::string& each : mapping_types()) names.push_back(each + "_mapping");
  if (!node.is(type ? keys_of(*type + "_mapping") : keys_of_any(names))) return std::nullopt;
  const Vec3 origin = point(node, "origin", scale), centre = point(node, "centre", scale);
  const PatternFrame frame = read_frame(node);
  const double width = length(node, "width", scale), height = length(node, "height", scale);
  const auto size = node.member("size");
  const Vec3 edges = scale * (size ? size->vector(kPositive).value_or(Vec3::Ones()) : Vec3::Ones());
  if (!type || *type == "parameters") return std::nullopt;
  if (*type == "plane") return LaidOnPlane{origin, frame, width, node.member("height") ? height : width};
  if (*type == "cylinder") return LaidOnCylinder{origin, frame, height};
  if (*type == "sphere") return LaidOnSphere{centre, frame};
  return LaidOnBox{centre, frame, edges};
}

Wraps read_wraps(const SceneNode& node) {
  const auto word = node.choice({"repeat", "clamp", "mirror"});
  const Wrap wrap = !word || *word == "repeat" ? Wrap::repeat : *word == "clamp" ? Wrap::clamp : Wrap::mirror;
  return {wrap, wrap};
}

int whole(const SceneNode& node, const char* key, int otherwise) {
  const auto member = node.member(key);
  const auto value = member ? member->integer(1, kMostSquares) : std::nullopt;
  return value ? static_cast<int>(*value) : otherwise;
}

}  // namespace

std::uint64_t read_seed(const SceneNode& node) {
  const auto member = node.member("seed");
  return static_cast<std::uint64_t>(member ? member->integer(0, kLargestSeed).value_or(0) : 0);
}

std::shared_ptr<const TexturePyramid> TextureFiles::read(const SceneNode& name) {
  const auto text = name.text();
  if (!text) return nullptr;
  const fs::path path = (folder_ / *text).lexically_normal();
  if (const auto found = known_.find(path); found != known_.end()) return found->second;
  auto& image = known_[path];
  const auto bytes = read_file(path);
  if (!bytes) {
    name.cannot_be_read(bytes.error().message);
    return nullptr;
  }
  const auto picture = read_image(path, kMostTexels);
  if (!picture) {
    const bool file_is_wrong = picture.error().code == ErrorCode::input_output;
    file_is_wrong ? name.cannot_be_read(picture.error().message)
                  : name.expected("an image: " + picture.error().message);
    return nullptr;
  }
  if (const auto unfit = find_unfit_texel(*picture)) {
    name.complain(*unfit);
    return nullptr;
  }
  fingerprint_.add(*bytes).add(std::to_string(bytes->size()));
  files_.push_back(path);
  image = std::make_shared<const TexturePyramid>(picture->columns, picture->rows, picture->pixels);
  return image;
}

std::optional<MaterialTexture> read_texture(const SceneNode& node, const std::string& type, double scale,
                                            TextureFiles& files) {
  MaterialTexture texture;
  if (const auto mapping = node.member("mapping")) texture.laid = read_mapping(*mapping, scale);
  if (const auto tiles = node.member("tiles")) {
    const auto counts = tiles->items(2, 2, "numbers");
    for (std::size_t i = 0; i < counts.size() && i < 2; ++i) texture.tiles[i] = counts[i].number(kTiles).value_or(1);
  }
  if (type == "squares") {
    texture.colours = ColourSquares{whole(node, "columns", ColourSquares{}.columns),
                                    whole(node, "rows", ColourSquares{}.rows), read_seed(node)};
    return texture;
  }
  TextureImage image;
  const auto wrap = node.member("wrap"), file = node.member("file");
  if (wrap) image.wraps = read_wraps(*wrap);
  if (file) image.pyramid = files.read(*file);
  if (!image.pyramid) return std::nullopt;
  texture.colours = image;
  return texture;
}

}  // namespace etendue
