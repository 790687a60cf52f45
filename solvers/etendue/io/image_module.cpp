// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/image_module.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "libetendue_io.so";

/// The environment variable; one that is set but empty counts as not set.
const char* named_by_user() {
  const char* const named = std::getenv("ETENDUE_IO");
  return named && *named ? named : nullptr;
}

std::vector<fs::path> places() {
  if (const char* named = named_by_user()) return {fs::path(named)};
  std::vector<fs::path> all;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path folder = program.parent_path();
    all.push_back(folder / kFile);
    all.push_back(folder.parent_path() / "lib" / "etendue" / kFile);
    all.push_back(folder.parent_path() / ETENDUE_LIBRARY_FOLDER / "etendue" / kFile);
  }
  all.push_back(fs::path(ETENDUE_LIBRARY_PATH) / "etendue" / kFile);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Error missing(const std::string& what) {
  return {ErrorCode::input_output, "cannot handle images: " + what};
}

Result<const EtendueImageModule*> open(const fs::path& file) {
  // Never closed: OpenImageIO keeps threads and thread-local data of its own.
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) return missing(printable(::dlerror()));
  using Entry = const EtendueImageModule* (*)();
  const auto entry = reinterpret_cast<Entry>(::dlsym(handle, "etendue_image_module"));
  if (!entry) return missing(quoted_path(file) + " is not the image module of etendue");
  const EtendueImageModule* module = entry();
  if (module->interface_version != kEtendueImageInterface) {
    return missing(quoted_path(file) + " has interface " + std::to_string(module->interface_version) + ", expected " +
                   std::to_string(kEtendueImageInterface));
  }
  return module;
}

Result<const EtendueImageModule*> find() {
  std::string looked;
  for (const fs::path& place : places()) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) return open(place);
    looked += (looked.empty() ? "" : ", ") + quoted_path(place);
  }
  // A program of others, linked with etendue::solvers, knows the module's folder by its run path.
  if (!named_by_user() && ::dlopen(kFile, RTLD_NOW | RTLD_LOCAL)) return open(kFile);
  return missing(std::string("the module ") + kFile + " is not at " + looked +
                 (named_by_user() ? " (as $ETENDUE_IO says)" : ", nor on the run path; $ETENDUE_IO may name it"));
}

}  // namespace

Result<const EtendueImageModule*> image_module() {
  static const Result<const EtendueImageModule*> module = find();
  return module;
}

}  // namespace etendue
