// SPDX-License-Identifier: Apache-2.0
#pragma once

// The narrow door between the programs and the module libetendue_io.so, which alone links OpenImageIO: C types only, no
// exception passes, the caller owns all memory.

extern "C" {

/// A picture in memory: `channels` samples a pixel, row by row from the top.
struct EtendueSamples {
  int columns;
  int rows;
  int channels;
  const char* const* names;    ///< of the channels; null: R, G, B
  const float* linear;         ///< for .exr; null otherwise
  const unsigned char* bytes;  ///< for .png: sRGB-encoded; null otherwise
  int left, top;               ///< for .exr: where its upper left pixel lies in the whole picture
  int whole_columns, whole_rows;
};

/// Called once with the size of a picture; returns where to put columns · rows · channels floats, or null to give up.
using EtendueAllocate = float* (*)(void* context, int columns, int rows, int channels);
/// Called for each channel, in the order of a pixel's samples.
using EtendueChannel = void (*)(void* context, const char* name);
/// Called for each text attribute.
using EtendueAttribute = void (*)(void* context, const char* name, const char* text);
/// Called once with all bytes of a file; false if they cannot be kept.
using EtendueBytes = bool (*)(void* context, const unsigned char* bytes, unsigned long long count);

struct EtendueImageModule {
  int interface_version;  ///< kEtendueImageInterface, or the module belongs to another build
  /// Encodes in memory, in the format "openexr" or "png". `metadata` holds 2 · `pairs` texts: name, text, name, text …
  /// On failure returns false, the reason in `reason`.
  bool (*write)(const char* format, const EtendueSamples* samples, const char* const* metadata, int pairs,
                void* context, EtendueBytes keep, char* reason, int reason_size);
  /// Opens with the reader of `format` ("openexr" or "png") and no other. Bytes come back as value/255, still encoded.
  bool (*read)(const char* path, const char* format, void* context, EtendueAllocate allocate, EtendueChannel channel,
               EtendueAttribute attribute, char* reason, int reason_size);
};

/// The one name that the module exports.
const EtendueImageModule* etendue_image_module();
}

inline constexpr int kEtendueImageInterface = 4;
