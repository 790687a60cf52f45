// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "etendue/assembly/surface_model.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// What the tiles of a checkpoint were computed from.
struct CheckpointKey {
  std::string settings;               ///< one line: method, tolerances, version
  std::vector<std::string> names;     ///< of elements, then of the faces that may stand between them
  std::vector<std::uint64_t> hashes;  ///< of their vertices, to the last bit
};
[[nodiscard]] CheckpointKey checkpoint_key(const SurfaceModel& model, const std::string& settings);

enum class CheckpointStart {
  fresh,   ///< there must be no such file yet
  resume,  ///< go on with it, or begin it where there is none
};

/// A matrix that lies in a file while it grows: what is done survives whatever ends the program. Every tile carries a
/// checksum, written after its cells; on resuming a tile whose checksum does not hold is computed anew, so a torn write
/// costs time, never digits. The kernel pages it out where memory is short. Space is reserved at the start.
///
/// Errors    invalid_input: not a checkpoint, or one of other surfaces or settings; the message names the first surface
///           that differs. usage: there is a file already and `fresh` is asked for. input_output: no space, no
///           permission, in use by another run
[[nodiscard]] Result<ExchangeMatrix> open_checkpoint(const std::filesystem::path& path, const CheckpointKey& key,
                                                     std::vector<double> areas, CheckpointStart start);

}  // namespace etendue
