// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/io/scene_node.hpp"
#include "etendue/text/fingerprint.hpp"

namespace etendue {

/// Images of surroundings have this many pixels along an edge at most: six take 3 GiB then.
inline constexpr int kLargestCubeImage = 4096;

/// The surroundings that materials mirror: six images each, as `etendue render --cube` writes them, each read once.
class EnvironmentFiles {
 public:
  /// Of the files that are read, their bytes and lengths go into `fingerprint`.
  explicit EnvironmentFiles(Fingerprint& fingerprint) : fingerprint_(fingerprint) {}

  /// Names are relative to the folder of the scene file that has them.
  void look_in(const std::filesystem::path& folder) { folder_ = folder; }

  /// PREFIX.right.exr, .left, .back, .front, .top and .bottom, or, where there is no such .exr, .png. Reported: a missing file, one
  /// that is no image, images that are not square, of several sizes or too large, values that are negative or not finite.
  [[nodiscard]] std::shared_ptr<const CubeMap> read(const SceneNode& prefix);

  /// Those that were read, in their order.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  /// Adds the image of a face, or says what is wrong with it.
  [[nodiscard]] Result<Done> add_face(const std::filesystem::path& stem, CubeFace face, CubeImages& images);

  Fingerprint& fingerprint_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  std::map<std::filesystem::path, std::shared_ptr<const CubeMap>> known_;  ///< null: reported already
};

}  // namespace etendue
