// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/openimageio_module.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <string>

namespace {

bool fail(char* reason, int size, const std::string& text) {
  const std::string first_line = text.substr(0, text.find('\n'));
  std::snprintf(reason, static_cast<std::size_t>(size), "%s", first_line.c_str());
  return false;
}

/// What the writer or reader says of itself, or a sentence when it says nothing.
template <class File>
std::string complaint(const File& file, const char* otherwise) {
  const std::string text = file->geterror();
  return text.empty() ? otherwise : text;
}

bool write(const char* format, const EtendueSamples* samples, const char* const* metadata, int pairs, void* context,
           EtendueBytes keep, char* reason, int size) try {
  auto file = OIIO::ImageOutput::create(format);
  if (!file) return fail(reason, size, "no writer for " + std::string(format) + ": " + OIIO::geterror());
  const OIIO::TypeDesc type = samples->bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
  OIIO::ImageSpec spec(samples->columns, samples->rows, samples->channels, type);
  spec.attribute("oiio:ColorSpace", samples->bytes ? "sRGB" : "Linear");
  if (!samples->bytes) {
    spec.attribute("compression", "zip");
    spec.x = samples->left, spec.y = samples->top;
    spec.full_width = samples->whole_columns, spec.full_height = samples->whole_rows;
  }
  if (samples->names) spec.channelnames.assign(samples->names, samples->names + samples->channels);
  for (int i = 0; i < pairs; ++i) spec.attribute(metadata[2 * i], metadata[2 * i + 1]);
  OIIO::Filesystem::IOVecOutput bytes;
  if (!file->set_ioproxy(&bytes)) return fail(reason, size, "the writer for " + std::string(format) + " wants a file");
  if (!file->open("picture", spec)) return fail(reason, size, complaint(file, "cannot be encoded"));
  const void* data = samples->bytes ? static_cast<const void*>(samples->bytes) : samples->linear;
  if (!file->write_image(type, data)) return fail(reason, size, complaint(file, "the pixels were not written"));
  if (!file->close()) return fail(reason, size, complaint(file, "the file could not be completed"));
  if (!keep(context, bytes.buffer().data(), bytes.buffer().size())) return fail(reason, size, "out of memory");
  return true;
} catch (const std::exception& failure) {
  return fail(reason, size, failure.what());
}

/// libpng, asked by OpenImageIO, prints what it complains of besides returning it. Its words go nowhere while one of
/// these lives: in glibc `stderr` is a variable, and what other threads write by std::cerr is not touched.
class QuietStderr {
 public:
  QuietStderr() : lock_(mutex()), before_(stderr) {
    static std::FILE* const nowhere = std::fopen("/dev/null", "we");  // never closed: another thread may hold it
    if (nowhere) stderr = nowhere;
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
  ~QuietStderr() { stderr = before_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> lock_;
  std::FILE* before_;
};

bool read(const char* path, const char* format, void* context, EtendueAllocate allocate, EtendueChannel channel,
          EtendueAttribute attribute, char* reason, int size) try {
  const QuietStderr quiet;
  auto file = OIIO::ImageInput::create(format);
  if (!file) return fail(reason, size, "no reader for " + std::string(format) + ": " + OIIO::geterror());
  OIIO::ImageSpec spec;
  if (!file->open(path, spec)) return fail(reason, size, complaint(file, "cannot be decoded"));
  for (const auto& extra : spec.extra_attribs) {
    if (extra.type() == OIIO::TypeString) attribute(context, extra.name().c_str(), extra.get_string().c_str());
  }
  for (const auto& name : spec.channelnames) channel(context, name.c_str());
  float* pixels = allocate(context, spec.width, spec.height, spec.nchannels);
  if (!pixels) return fail(reason, size, "more pixels than can be held");
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels)) {
    return fail(reason, size, complaint(file, "the pixels were not read"));
  }
  return true;
} catch (const std::exception& failure) {
  return fail(reason, size, failure.what());
}

constexpr EtendueImageModule kModule{kEtendueImageInterface, write, read};

}  // namespace

extern "C" __attribute__((visibility("default"))) const EtendueImageModule* etendue_image_module() {
  return &kModule;
}
