// SPDX-License-Identifier: Apache-2.0
#include <fstream>

#include "cli/saved_solution.hpp"
#include "etendue/core/result.hpp"
#include "etendue/io/camera_file.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/io/number_table.hpp"
#include "etendue/io/row_file.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/io/sensor_file.hpp"
#include "etendue/io/surface_file.hpp"
#include "fuzz/target.hpp"
#include "support/temporary_folder.hpp"

// Whatever a file holds, its reader returns a value or says why not, naming the file.
namespace etendue::fuzz {

namespace {

std::filesystem::path written(const char* name, Bytes input) {
  static const validation::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / name;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
  return path;
}

template <class Value>
void judge(const Result<Value>& result, const std::filesystem::path& path) {
  if (result.ok()) return;
  const std::string& message = result.error().message;
  expect(message.find(path.filename().string()) != std::string::npos, "the message names the file");
  expect(message.find('\0') == std::string::npos, "the message is text");
}

template <class Read>
void read_as(const char* name, Bytes input, Read read) {
  const auto path = written(name, input);
  judge(read(path), path);
}

Result<std::vector<Sensor>> sensors_in_metres(const std::filesystem::path& path) {
  return read_sensors(path, 1);
}
Result<std::vector<NamedCamera>> cameras_in_metres(const std::filesystem::path& path) {
  return read_cameras(path, 1);
}
Result<FormFactorMatrix> three_rows(const std::filesystem::path& path) {
  return read_rows(path, {{"scene", "0"}}, 3);
}
Result<Image> small_image(const std::filesystem::path& path) {
  return read_image(path, 1 << 16);
}

}  // namespace

const std::vector<Target>& reader_targets() {
  static const std::vector<Target> all{
      {"scene", [](Bytes input) { read_as("input.json", input, read_scene); }},
      {"vs3", [](Bytes input) { read_as("input.vs3", input, read_surfaces); }},
      {"obj", [](Bytes input) { read_as("input.obj", input, read_surfaces); }},
      {"stl", [](Bytes input) { read_as("input.stl", input, read_surfaces); }},
      {"factors-csv", [](Bytes input) { read_as("input.csv", input, read_factors); }},
      {"factors-npy", [](Bytes input) { read_as("input.npy", input, read_factors); }},
      {"factors-mtx", [](Bytes input) { read_as("input.mtx", input, read_factors); }},
      {"sensors", [](Bytes input) { read_as("sensors.csv", input, sensors_in_metres); }},
      {"cameras", [](Bytes input) { read_as("cameras.json", input, cameras_in_metres); }},
      {"solution", [](Bytes input) { read_as("solution.json", input, cli::read_saved_solution); }},
      {"rows", [](Bytes input) { read_as("input.resume", input, three_rows); }},
      {"png", [](Bytes input) { read_as("input.png", input, small_image); }},
      {"exr", [](Bytes input) { read_as("input.exr", input, small_image); }}};
  return all;
}

}  // namespace etendue::fuzz
