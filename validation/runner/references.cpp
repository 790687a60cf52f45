// SPDX-License-Identifier: Apache-2.0
#include "runner/references.hpp"

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/table.hpp"
#include "etendue/core/version.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/text/fingerprint.hpp"

namespace etendue::validation {

namespace fs = std::filesystem;

namespace {

fs::path list_path(const fs::path& root) {
  return root / "scenes" / "references.json";
}

Result<nlohmann::ordered_json> read_list(const fs::path& root) {
  const fs::path path = list_path(root);
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{ErrorCode::input_output, "cannot read '" + path.string() + "'"};
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  auto list = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!list.is_object() || !list["references"].is_array())
    return Error{ErrorCode::invalid_input, path.string() + R"(: expected an object with an array "references")"};
  return list;
}

/// The words of a command; paths of the sources become those under `root`.
std::vector<std::string> words_of(const std::string& command, const fs::path& root) {
  std::istringstream stream(command);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word.rfind("scenes/", 0) == 0 ? (root / word).string() : word);
  }
  return words;
}

/// The working directory, for as long as this lives.
class Inside {
 public:
  explicit Inside(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~Inside() {
    std::error_code none;
    fs::current_path(before_, none);
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  fs::path before_;
};

class EmptyFolder {
 public:
  EmptyFolder() {
    std::string name = (fs::temp_directory_path() / "etendue-reference-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~EmptyFolder() {
    std::error_code none;
    if (!path_.empty()) fs::remove_all(path_, none);
  }
  EmptyFolder(const EmptyFolder&) = delete;
  EmptyFolder& operator=(const EmptyFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Result<std::string> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{ErrorCode::input_output, "cannot read '" + path.string() + "'"};
  return std::string{std::istreambuf_iterator<char>(file), {}};
}

/// Replaces one picture where it changed, and says so in its row.
Result<Done> update(nlohmann::ordered_json& row, const ReferencePicture& reference, const fs::path& root,
                    const std::string& reason, const std::string& day) {
  const EmptyFolder folder;
  const auto rendered = render_reference(reference, root, folder.path());
  if (!rendered) return rendered.error();
  const auto now = picture_fingerprint(*rendered);
  if (!now) return now.error();
  if (*now == reference.pixels && fs::exists(root / reference.picture)) {
    std::cout << "unchanged  " << reference.picture << "\n";
    return Done{};
  }
  const auto bytes = bytes_of(*rendered);
  if (!bytes) return bytes.error();
  const auto written = write_file(root / reference.picture, *bytes);
  if (!written) return written.error();
  row["pixels"] = *now;
  row["program"] = version();
  row["recorded"] = day;
  row["reason"] = reason;
  std::cout << "recorded   " << reference.picture << "\n";
  return Done{};
}

}  // namespace

fs::path references_root() {
  return ETENDUE_SOURCE_ROOT;
}

Result<std::vector<ReferencePicture>> read_references(const fs::path& root) {
  const auto list = read_list(root);
  if (!list) return list.error();
  std::vector<ReferencePicture> all;
  for (std::size_t i = 0; i < (*list)["references"].size(); ++i) {
    const auto& row = (*list)["references"][i];
    const auto text = [&](const char* key) {
      return row.is_object() && row.contains(key) && row[key].is_string() ? row[key].get<std::string>() : std::string();
    };
    ReferencePicture reference{text("picture"),  {},
                               text("made"),     row.is_object() && row.value("costly", false),
                               text("pixels"),   text("program"),
                               text("recorded"), text("reason")};
    if (row.is_object() && row.contains("commands") && row["commands"].is_array()) {
      for (const auto& command : row["commands"])
        reference.commands.push_back(command.is_string() ? command.get<std::string>() : std::string());
    }
    if (reference.picture.empty() || reference.made.empty() || reference.commands.empty()) {
      return Error{ErrorCode::invalid_input, list_path(root).string() + ": /references/" + std::to_string(i) +
                                                 R"(: expected "picture", "made" and "commands")"};
    }
    all.push_back(reference);
  }
  return all;
}

Result<fs::path> render_reference(const ReferencePicture& reference, const fs::path& root, const fs::path& folder) {
  const Inside inside(folder);
  for (const std::string& command : reference.commands) {
    auto words = words_of(command, root);
    words.emplace_back("--quiet");
    std::ostringstream out, err;
    const int code = cli::run(words, out, err);
    if (code != 0) {
      return Error{ErrorCode::check_failed,
                   "etendue " + command + ": ended with " + std::to_string(code) + ": " + err.str()};
    }
  }
  return folder / reference.made;
}

Result<std::string> picture_fingerprint(const fs::path& path) {
  const auto image = read_image(path);
  if (!image) return image.error();
  Fingerprint print;
  print.add(std::to_string(image->columns) + " x " + std::to_string(image->rows));
  std::string bytes;
  for (const auto& pixel : image->pixels) {
    for (const double channel : pixel) {
      // Of eight or sixteen bits, or an EXR's half or float: a float tells all of these apart.
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(channel));
      for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 255u));
    }
  }
  print.add(bytes);
  return print.hex();
}

Result<Done> update_references(const fs::path& root, const std::string& which, const std::string& reason,
                               const std::string& day) {
  const auto all = read_references(root);
  if (!all) return all.error();
  auto read = read_list(root);
  if (!read) return read.error();
  auto list = std::move(read).value();
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < all->size(); ++i) {
    const ReferencePicture& reference = (*all)[i];
    if (reference.picture.rfind(which, 0) != 0) continue;
    ++chosen;
    const auto updated = update(list["references"][i], reference, root, reason, day);
    if (!updated) return updated.error();
    // Written after each: what is recorded stays recorded when a later one fails.
    const auto written = write_file(list_path(root), list.dump(1) + "\n");
    if (!written) return written.error();
  }
  if (chosen > 0) return Done{};
  return Error{ErrorCode::usage, "--update-references: no reference picture begins with " + which};
}

}  // namespace etendue::validation
