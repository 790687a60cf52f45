// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <etendue/io/image_file.hpp>
#include <etendue/io/scene_reader.hpp>
#include <etendue/raytracing/render.hpp>

int main(int, char** words) {  // a scene, and the picture to make of it
  const auto file = etendue::read_scene(words[1]);
  const auto scene = etendue::make_accelerator(file.value().scene, etendue::AcceleratorKind::bounding_volumes);
  const auto picture = etendue::render(*scene, etendue::RenderOptions{}, etendue::Execution{});
  const auto written = etendue::write_image(words[2], picture.value().image);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written ? 0 : 1;
}
