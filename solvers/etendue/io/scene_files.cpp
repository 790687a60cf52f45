// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/scene_files.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/length_unit.hpp"
#include "etendue/text/fingerprint.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

/// The same file under whatever name.
fs::path identity(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path.lexically_normal() : canonical;
}

class Loader {
 public:
  explicit Loader(SceneErrors& errors) : errors_(errors) {}

  LoadedFiles finish() {
    loaded_.fingerprint = fingerprint_;
    return std::move(loaded_);
  }

  /// The file, and before it what it includes. Fails only when this very file cannot be read.
  Result<Done> load(const fs::path& path) {
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    fingerprint_.add(*bytes);
    // The length too: moving text from one file to the next changes the fingerprint.
    for (int shift = 0; shift < 64; shift += 8) {
      const auto byte = static_cast<char>((static_cast<std::uint64_t>(bytes->size()) >> shift) & 0xFF);
      fingerprint_.add({&byte, 1});
    }
    known_.push_back(identity(path));
    open_.push_back(identity(path));

    LoadedFile file;
    file.index = count_++;
    file.name = path.string();
    file.document = parse_json(*bytes);
    for (const JsonProblem& problem : file.document.problems) errors_.add(file.index, file.name, problem);
    if (file.document.complete) {
      const SceneNode top(file.document.root, file.index, file.name, errors_);
      file.sound = read_outline(top, path, file);
    } else {
      loaded_.complete = false;
    }
    open_.pop_back();
    loaded_.files.push_back(std::move(file));
    return Done{};
  }

 private:
  bool read_outline(const SceneNode& top, const fs::path& path, LoadedFile& file) {
    if (!top.is(keys_of("scene"))) return false;
    if (const auto schema = top.member("$schema")) (void)schema->text();
    if (const auto format = top.member("format")) (void)format->choice({"etendue-scene"});  // reported there
    if (const auto version = top.member("version")) (void)version->integer(1, 1);
    if (const auto node = top.member("unit")) {
      if (const auto metres = read_unit(*node)) file.metres_per_unit = *metres;
    }
    if (const auto include = top.member("include")) read_includes(*include, path);
    return true;
  }

  void read_includes(const SceneNode& include, const fs::path& path) {
    for (const SceneNode& node : include.items(1, std::numeric_limits<std::size_t>::max(), "file names")) {
      const auto name = node.text();
      if (!name) continue;
      const fs::path file = (path.parent_path() / *name).lexically_normal();
      if (std::find(open_.begin(), open_.end(), identity(file)) != open_.end()) {
        node.complain("found " + quoted_path(file) +
                      ", which is being read already, expected includes without a cycle");
        continue;
      }
      if (std::find(known_.begin(), known_.end(), identity(file)) != known_.end()) continue;  // read once
      if (open_.size() >= kDeepestInclude) {
        node.complain("found includes nested deeper than " + std::to_string(kDeepestInclude) + ", expected less");
        continue;
      }
      if (const auto done = load(file); !done) {
        node.expected("a readable file: " + done.error().message);
        loaded_.complete = false;
      }
    }
  }

  static constexpr std::size_t kDeepestInclude = 32;

  SceneErrors& errors_;
  LoadedFiles loaded_;
  Fingerprint fingerprint_;
  std::size_t count_ = 0;
  std::vector<fs::path> known_;  ///< all files so far
  std::vector<fs::path> open_;   ///< those whose includes are being read
};

}  // namespace

std::optional<double> read_unit(const SceneNode& node) {
  const auto name = node.choice(length_unit_names());
  return name ? metres_of(*name) : std::nullopt;
}

Result<LoadedFiles> load_scene_files(const fs::path& path, SceneErrors& errors) {
  Loader loader(errors);
  if (auto done = loader.load(path); !done) return done.error();
  return loader.finish();
}

}  // namespace etendue
