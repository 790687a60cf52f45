// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>

#include "etendue/io/scene_node.hpp"
#include "etendue/text/fingerprint.hpp"

namespace etendue {

/// Images of more texels are refused: with their smaller copies they take 512 MiB.
inline constexpr long long kMostTexels = 1LL << 24;

/// The images that a scene names, each read once.
class TextureFiles {
 public:
  /// Of the files that are read, their bytes and lengths go into `fingerprint`.
  explicit TextureFiles(Fingerprint& fingerprint) : fingerprint_(fingerprint) {}

  /// Names are relative to the folder of the scene file that has them.
  void look_in(const std::filesystem::path& folder) { folder_ = folder; }

  /// The image that this node names. Reported: no such file, one that is no image, too many texels, values outside [0, 1].
  [[nodiscard]] std::shared_ptr<const TexturePyramid> read(const SceneNode& name);

  /// Those that were read, in their order.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  Fingerprint& fingerprint_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  std::map<std::filesystem::path, std::shared_ptr<const TexturePyramid>> known_;  ///< null: reported already
};

/// What "seed" says; 0 unless given.
[[nodiscard]] std::uint64_t read_seed(const SceneNode& node);

/// The texture of a "pattern" of type "image" or "squares". What is wrong is reported, and left at its default.
/// `scale` leads from lengths of the file to those of the scene.
[[nodiscard]] std::optional<MaterialTexture> read_texture(const SceneNode& node, const std::string& type, double scale,
                                                          TextureFiles& files);

}  // namespace etendue
