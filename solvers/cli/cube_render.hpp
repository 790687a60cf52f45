// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <string>

#include "etendue/reflectance/mapping.hpp"
#include "render_files.hpp"

// `etendue render --cube` and `--hide`.
namespace etendue::cli {

/// Takes what --hide names out of the scene: the object, or the objects of the group.
///
/// Errors    usage: there is none of that name; the nearest is suggested
[[nodiscard]] Result<Done> hide(const std::string& name, Scene& scene);

/// The requests for the six images, in the order of kCubeFaces: each with a file name of its own, NAME.right.exr (face_name()).
[[nodiscard]] std::array<RenderRequest, 6> cube_requests(const RenderRequest& request);

/// Renders six images, by `picture`, which renders, writes and reports one; as JSON, in an array. Ends with the first that fails.
int render_cube(const RenderRequest& request, SceneFile file, std::ostream& out,
                const std::function<int(const RenderRequest&, const SceneFile&)>& picture);

}  // namespace etendue::cli
