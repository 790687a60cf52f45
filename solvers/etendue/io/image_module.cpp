// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/image_module.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace etendue {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "libetendue_io.so";

std::vector<fs::path> places() {
  if (const char* named = std::getenv("ETENDUE_IO")) return {fs::path(named)};
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
  return all;
}

Error missing(const std::string& what) {
  return {ErrorCode::input_output, "cannot handle images: " + what};
}

Result<const EtendueImageModule*> open(const fs::path& file) {
  // Never closed: OpenImageIO keeps threads and thread-local data of its own.
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) return missing(::dlerror());
  using Entry = const EtendueImageModule* (*)();
  const auto entry = reinterpret_cast<Entry>(::dlsym(handle, "etendue_image_module"));
  if (!entry) return missing("'" + file.string() + "' is not the image module of etendue");
  const EtendueImageModule* module = entry();
  if (module->interface_version != kEtendueImageInterface) {
    return missing("'" + file.string() + "' has interface " + std::to_string(module->interface_version) +
                   ", expected " + std::to_string(kEtendueImageInterface));
  }
  return module;
}

Result<const EtendueImageModule*> find() {
  std::string looked;
  for (const fs::path& place : places()) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) return open(place);
    looked += (looked.empty() ? "'" : ", '") + place.string() + "'";
  }
  return missing(std::string("the module ") + kFile + " is not at " + looked);
}

}  // namespace

Result<const EtendueImageModule*> image_module() {
  static const Result<const EtendueImageModule*> module = find();
  return module;
}

}  // namespace etendue
