// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"

namespace etendue::validation {

/// A picture that is kept beside its scene, and where it is from (scenes/references.json).
///
/// The program gives the same bits for the same input, whatever the threads, the processor and the compiler. So a picture is compared
/// with none to spare: what differs by one step of one channel is another picture.
struct ReferencePicture {
  std::string picture;                ///< its path from the root of the sources
  std::vector<std::string> commands;  ///< of etendue, run one after the other in an empty folder; paths from the root
  std::string made;                   ///< the name that the last command gives the picture in that folder
  bool costly = false;                ///< more than about two seconds of a processor: only the long run renders it
  std::string pixels;                 ///< fingerprint of size and pixels
  std::string program;                ///< the version that made it
  std::string recorded;               ///< the day
  std::string reason;                 ///< why it was recorded
};

/// Root of the sources that this program was built from.
[[nodiscard]] std::filesystem::path references_root();

/// The rows of scenes/references.json under `root`.
/// Errors    input_output: it cannot be read; invalid_input: what is wrong, with its JSON pointer
[[nodiscard]] Result<std::vector<ReferencePicture>> read_references(const std::filesystem::path& root);

/// Renders the picture anew into `folder`; returns its path.
/// Errors    check_failed: a command ended otherwise than with 0, with what it said
[[nodiscard]] Result<std::filesystem::path> render_reference(const ReferencePicture& reference,
                                                             const std::filesystem::path& root,
                                                             const std::filesystem::path& folder);

/// Fingerprint (16 digits) of what a picture shows: its size and every pixel, not how the file packs them.
[[nodiscard]] Result<std::string> picture_fingerprint(const std::filesystem::path& path);

/// Renders every picture again whose path begins with `which` (all: empty), replaces those that changed, and records version, day
/// and reason for them. Says on standard output which these are.
[[nodiscard]] Result<Done> update_references(const std::filesystem::path& root, const std::string& which,
                                             const std::string& reason, const std::string& day);

}  // namespace etendue::validation
