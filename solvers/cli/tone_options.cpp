// SPDX-License-Identifier: Apache-2.0
#include "tone_options.hpp"

#include <cmath>

#include "etendue/image/exposure.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue::cli {

namespace {

constexpr double kLeastKey = 1e-6, kMostKey = 1e6;

}  // namespace

void add_tone(Options& options, ToneOptions& tone, const std::string& exposure_default) {
  options.real("--exposure", "F", "multiply the PNG's values by F (default: " + exposure_default + ")", tone.exposure,
               kLeastExposure, kMostExposure);
  options.choice("--tone", {"linear", "key", "reinhard"},
                 "how the PNG shows the picture. linear: times the exposure (default). key: times what brings its\n"
                 "log-average luminance to the key. reinhard: the same, then L/(1 + L), which cuts no highlight",
                 tone.tone);
  options.real("--key", "A", "log-average luminance by --tone key and reinhard (default: 0.18, middle grey)", tone.key,
               kLeastKey, kMostKey);
  options.real("--white", "W",
               "reinhard: the scaled luminance that becomes white; what is above is cut (default: none)", tone.white,
               kLeastKey, kMostExposure);
}

std::optional<std::string> contradiction(const ToneOptions& tone) {
  if (tone.key > 0 && tone.is_linear()) return "--key is for --tone key and --tone reinhard";
  if (tone.white > 0 && tone.tone != "reinhard") return "--white is for --tone reinhard";
  return std::nullopt;
}

ToneMapping mapping(const ToneOptions& tone, double exposure) {
  ToneMapping mapping;
  mapping.tone = tone.is_linear()     ? ToneOperator::linear
                 : tone.tone == "key" ? ToneOperator::key
                                      : ToneOperator::reinhard;
  mapping.exposure = tone.exposure > 0 ? tone.exposure : tone.is_linear() ? exposure : 1;
  if (tone.key > 0) mapping.key = tone.key;
  if (tone.white > 0) mapping.white = tone.white;
  return mapping;
}

std::string tone_text(const ToneMapping& mapping) {
  if (mapping.tone == ToneOperator::linear) return "linear";
  std::string text = (mapping.tone == ToneOperator::key ? "key " : "reinhard, key ") + shortest(mapping.key);
  if (std::isfinite(mapping.white)) text += ", white " + shortest(mapping.white);
  return text;
}

void add_facts(ImageMetadata& facts, const ToneMapping& mapping, double scale) {
  facts.emplace_back("etendue:exposure", shortest(scale));
  facts.emplace_back("etendue:tone", tone_text(mapping));
}

}  // namespace etendue::cli
