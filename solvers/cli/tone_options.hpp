// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "etendue/image/tone_mapping.hpp"
#include "etendue/io/image_file.hpp"
#include "options.hpp"

// --exposure, --tone, --key and --white: how every command that makes pictures shows them. EXR files stay as computed.
namespace etendue::cli {

/// As typed; 0, which no option takes, where it was not.
struct ToneOptions {
  std::string tone = "linear";
  double exposure = 0, key = 0, white = 0;

  bool is_linear() const { return tone == "linear"; }
};

/// @param exposure_default what --help calls the exposure of a linear picture where none is given
void add_tone(Options& options, ToneOptions& tone, const std::string& exposure_default);

/// What parsing cannot see: --key or --white without the tone that takes it.
[[nodiscard]] std::optional<std::string> contradiction(const ToneOptions& tone);

/// What to do to a picture. @param exposure of a linear one where none is given
[[nodiscard]] ToneMapping mapping(const ToneOptions& tone, double exposure);

/// "linear", "key 0.18", "reinhard, key 0.18, white 4": what a picture says about itself.
[[nodiscard]] std::string tone_text(const ToneMapping& mapping);

/// Adds to a picture's facts what it is multiplied by ("etendue:exposure") and its tone.
void add_facts(ImageMetadata& facts, const ToneMapping& mapping, double scale);

}  // namespace etendue::cli
