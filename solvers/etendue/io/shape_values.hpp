// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "etendue/io/placement.hpp"
#include "etendue/io/scene_node.hpp"

// What the readers of shapes share; their users want shape_reader.hpp.
namespace etendue {

/// What a placed length or coordinate must still be.
[[nodiscard]] bool usable(const Vec3& v);
[[nodiscard]] bool usable(double length);

/// Reports that a transform made something unusable.
void complain_out_of_range(const SceneNode& node);

/// Values of mandatory members; a missing one was reported by SceneNode::is().
[[nodiscard]] std::optional<Vec3> vector_of(const SceneNode& node, const char* key,
                                            const ValueRange& interval = kAnyNumber);
[[nodiscard]] std::optional<Vec3> direction_of(const SceneNode& node, const char* key);
[[nodiscard]] std::optional<double> length_of(const SceneNode& node, const char* key,
                                              const ValueRange& interval = kPositive);

/// Is the scale the same along all axes? Reports where a round shape would become oval.
[[nodiscard]] bool stays_round(const SceneNode& node, const std::string& type, const Placement& placement);

/// The box of "low" and "high", or of "centre" and "size", in the world; `type` is what has it ("box").
[[nodiscard]] std::optional<Box> read_placed_box(const SceneNode& node, const std::string& type,
                                                 const Placement& placement);

}  // namespace etendue
