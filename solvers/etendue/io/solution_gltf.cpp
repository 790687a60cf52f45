// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, as JSON (.gltf) and as one binary file (.glb).
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "etendue/core/version.hpp"
#include "etendue/io/byte_text.hpp"
#include "etendue/io/solution_file.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

namespace {

using Json = nlohmann::ordered_json;

// The format's names for what numbers are.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr std::size_t kTripleBytes = 3 * sizeof(float), kIndexBytes = sizeof(std::uint32_t);

/// Nothing nearer to the eye than this share of the scene's diagonal is drawn by the camera.
constexpr double kNearest = 0x1p-10;

enum View { kPositions, kColours, kRadiosities, kIndices, kViews };

/// The numbers of all objects, and the JSON that describes them.
struct Document {
  std::string views[kViews];
  Json accessors = Json::array(), meshes = Json::array();
};

/// Triangles of one object.
struct Part {
  std::size_t first[kViews] = {};  ///< where its numbers begin in each view [bytes]
  std::uint32_t vertices = 0;
  float low[3] = {}, high[3] = {};
};

void add_vertex(Document& document, Part& part, const SolvedSurfaces& solved, const Vec3& at, const Rgb& radiosity) {
  for (Eigen::Index c = 0; c < 3; ++c) {
    const auto x = static_cast<float>(at(c) * solved.scene.metres_per_unit);
    append_little(document.views[kPositions], x);
    part.low[c] = part.vertices == 0 ? x : std::min(part.low[c], x);
    part.high[c] = part.vertices == 0 ? x : std::max(part.high[c], x);
    append_little(document.views[kColours], static_cast<float>(std::clamp(solved.exposure * radiosity(c), 0.0, 1.0)));
    append_little(document.views[kRadiosities], static_cast<float>(radiosity(c)));
  }
  ++part.vertices;
}

/// A fan around the centroid, whose value is the mean of the corners.
void add_element(Document& document, Part& part, const SolvedSurfaces& solved, std::size_t k) {
  const Polygon& polygon = solved.mesh.elements[k].polygon;
  const std::vector<Rgb>& shades = solved.vertices.corners[k];
  const auto corners = static_cast<std::uint32_t>(shades.size());
  Rgb mean = Rgb::Zero();
  for (const Rgb& shade : shades) mean += shade / static_cast<double>(corners);
  const std::uint32_t centre = part.vertices;
  add_vertex(document, part, solved, polygon.centroid(), mean);
  for (std::size_t v = 0; v < shades.size(); ++v) {
    add_vertex(document, part, solved, polygon.vertices()[v], shades[v]);
  }
  for (std::uint32_t v = 0; v < corners; ++v) {
    for (const std::uint32_t index : {centre, centre + 1 + v, centre + 1 + (v + 1) % corners}) {
      append_little(document.views[kIndices], index);
    }
  }
}

/// Describes what was added since the part began.
void close_part(Document& document, const Part& part, const std::string& name) {
  const std::size_t first = document.accessors.size();
  for (int view = 0; view < kViews; ++view) {
    const bool indices = view == kIndices;
    const std::size_t bytes = document.views[view].size() - part.first[view];
    Json accessor{{"bufferView", view},
                  {"byteOffset", part.first[view]},
                  {"componentType", indices ? kUnsignedInt : kFloat},
                  {"count", bytes / (indices ? kIndexBytes : kTripleBytes)},
                  {"type", indices ? "SCALAR" : "VEC3"}};
    if (view == kPositions) {
      accessor["min"] = {part.low[0], part.low[1], part.low[2]};
      accessor["max"] = {part.high[0], part.high[1], part.high[2]};
    }
    document.accessors.push_back(std::move(accessor));
  }
  const Json primitive{
      {"attributes",
       {{"POSITION", first + kPositions}, {"COLOR_0", first + kColours}, {"_RADIOSITY", first + kRadiosities}}},
      {"indices", first + kIndices},
      {"material", 0}};
  Json mesh{{"name", name}};
  mesh["primitives"][0] = primitive;
  document.meshes.push_back(std::move(mesh));
}

Document described(const SolvedSurfaces& solved) {
  Document document;
  const auto& elements = solved.mesh.elements;
  const auto object_of = [&](std::size_t k) { return solved.mesh.face_of(elements[k]).object; };
  for (std::size_t k = 0; k < elements.size();) {
    const std::size_t object = object_of(k);
    Part part;
    for (int view = 0; view < kViews; ++view) part.first[view] = document.views[view].size();
    for (; k < elements.size() && object_of(k) == object; ++k) add_element(document, part, solved, k);
    close_part(document, part, solved.scene.objects[object].name);
  }
  return document;
}

/// The quaternion (x, y, z, w) that turns the axis nearest to `up` into y.
Json upright(const Vec3& up) {
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  const double sign = up(axis) < 0 ? -1 : 1, half = std::sqrt(0.5);
  if (axis == 0) return {0, 0, sign * half, half};
  if (axis == 2) return {-sign * half, 0, 0, half};
  return sign > 0 ? Json{0, 0, 0, 1} : Json{1, 0, 0, 0};
}

Json nodes(const SolvedSurfaces& solved, std::size_t meshes, const Result<CameraFrame>& frame) {
  Json all = Json::array();
  all.push_back({{"name", solved.scene.name}, {"rotation", upright(solved.scene.camera.up)}});
  for (std::size_t m = 0; m < meshes; ++m) all[m + 1]["mesh"] = m;
  if (frame) {
    const Vec3 columns[] = {frame->right, frame->up, -frame->forward, frame->eye * solved.scene.metres_per_unit};
    Json matrix = Json::array();
    for (int j = 0; j < 4; ++j) {
      for (Eigen::Index c = 0; c < 3; ++c) matrix.push_back(columns[j](c));
      matrix.push_back(j == 3 ? 1 : 0);
    }
    all.push_back({{"name", "camera"}, {"camera", 0}, {"matrix", matrix}});
  }
  for (std::size_t child = 1; child < all.size(); ++child) all[0]["children"].push_back(child);
  return all;
}

Json camera(const SolvedSurfaces& solved, const CameraFrame& frame) {
  return {{"type", "perspective"},
          {"perspective",
           {{"aspectRatio", frame.tan_horizontal / frame.tan_vertical},
            {"yfov", 2 * std::atan(frame.tan_vertical)},
            {"znear", kNearest * diagonal(solved.mesh) * solved.scene.metres_per_unit}}}};
}

/// All but the buffer's address; its bytes are those of the views, one after another.
Json json_of(const SolvedSurfaces& solved, const Document& document) {
  Json json;
  json["asset"] = {{"version", "2.0"},
                   {"generator", std::string("etendue ") + version()},
                   {"extras",
                    {{"exposure", solved.exposure},
                     {"COLOR_0", "radiosity [W/m2] times exposure, cut at 1, linear"},
                     {"_RADIOSITY", "radiosity [W/m2], linear"}}}};
  json["extensionsUsed"] = Json::array({"KHR_materials_unlit"});
  const auto frame = camera_frame(solved.scene.camera);
  json["scene"] = 0;
  json["scenes"][0]["nodes"][0] = 0;
  json["nodes"] = nodes(solved, document.meshes.size(), frame);
  if (frame) json["cameras"][0] = camera(solved, *frame);
  if (document.meshes.empty()) return json;  // the format has no empty arrays
  const Json rough{{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
  json["materials"][0] = {{"name", "radiosity"},
                          {"pbrMetallicRoughness", rough},
                          {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
  json["meshes"] = document.meshes;
  json["accessors"] = document.accessors;
  std::size_t offset = 0;
  for (int view = 0; view < kViews; ++view) {
    const std::size_t length = document.views[view].size();
    json["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", offset},
                                   {"byteLength", length},
                                   {"target", view == kIndices ? kElementArrayBuffer : kArrayBuffer}});
    offset += length;
  }
  json["buffers"][0]["byteLength"] = offset;
  return json;
}

std::string bytes_of(const Document& document) {
  std::string bytes;
  for (const std::string& view : document.views) bytes += view;
  return bytes;
}

/// Length, kind and content, filled up to a multiple of four bytes.
std::string chunk(std::uint32_t kind, std::string content, char filling) {
  content.append((4 - content.size() % 4) % 4, filling);
  std::string bytes;
  append_little(bytes, static_cast<std::uint32_t>(content.size()));
  append_little(bytes, kind);
  return bytes + content;
}

}  // namespace

std::string solution_gltf(const SolvedSurfaces& solved) {
  const Document document = described(solved);
  Json json = json_of(solved, document);
  if (!document.meshes.empty()) {
    json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes_of(document));
  }
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

std::string solution_glb(const SolvedSurfaces& solved) {
  constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const Document document = described(solved);
  std::string chunks = chunk(kJson, json_of(solved, document).dump(-1, ' ', true, Json::error_handler_t::replace), ' ');
  if (!document.meshes.empty()) chunks += chunk(kBinary, bytes_of(document), '\0');
  std::string bytes;
  constexpr std::size_t kHeader = 12;
  append_little(bytes, kMagic);
  append_little(bytes, kVersion);
  append_little(bytes, static_cast<std::uint32_t>(kHeader + chunks.size()));
  return bytes + chunks;
}

}  // namespace etendue
