// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/solution_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Json = nlohmann::json;
using Triples = std::vector<std::array<double, 3>>;

// Two objects, five elements, awkward numbers everywhere; emitters brighter than white.
struct Solved {
  Scene scene;
  ElementMesh mesh;
  VertexRadiosities vertices;
  std::vector<Rgb> radiosity, irradiance, emission;

  Solved() {
    scene.name = "awk\u00e9ward";
    scene.metres_per_unit = 0.3;
    scene.camera.eye = {1.0 / 3, -2, 0.7};
    Material grey, light;
    grey.rho = {0.1, 1.0 / 3, 0.7};
    light.emission = {9, 8, 7.0 / 3};
    scene.materials = {grey, light};
    const auto add = [&](const char* name, std::vector<Vec3> corners, std::size_t material, Subdivision parts) {
      scene.objects.push_back({name, Polygon::make(std::move(corners)).value(), material, parts});
    };
    add("a \"b\", c\n", {{0, 0, 0.1}, {1.0 / 3, 0, 0.1}, {1.0 / 3, 0.7, 0.1}, {0, 0.7, 0.1}}, 0, {{2, 2}, {2, 1}});
    add("tail\\", {{0, 0, 1}, {0, 1, 1.1}, {1, 0, 1.3}}, 1, {});
    mesh = mesh_elements(scene).value();
    for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
      const double x = static_cast<double>(k + 1);
      radiosity.emplace_back(x / 3, x / 7, x * 1e-17);
      irradiance.emplace_back(x / 11, 1e300 / x, 0);
      emission.push_back(scene.materials[mesh.face_of(mesh.elements[k]).material].emission);
      auto& corners = vertices.corners.emplace_back();
      for (std::size_t v = 0; v < mesh.elements[k].polygon.vertices().size(); ++v) {
        corners.emplace_back(x / 13, static_cast<double>(v) / 9, 10 * x);
      }
    }
  }
  SolvedSurfaces surfaces() const { return {scene, mesh, vertices, radiosity, irradiance, emission, 0.6}; }
};

template <class Range>
Triples triples(const Range& values) {
  Triples all;
  for (const auto& v : values) all.push_back({v(0), v(1), v(2)});
  return all;
}

Triples corner_points(const Solved& solved) {
  Triples all;
  for (const Element& e : solved.mesh.elements) {
    for (const auto& point : triples(e.polygon.vertices())) all.push_back(point);
  }
  return all;
}

Triples corner_shades(const Solved& solved) {
  Triples all;
  for (const auto& corners : solved.vertices.corners) {
    for (const auto& shade : triples(corners)) all.push_back(shade);
  }
  return all;
}

// RFC 4648, the slow way: six bits a character.
std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned held = 0, bits = 0;
  EXPECT_EQ(text.size() % 4, 0u);
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = digits.find(c);
    EXPECT_NE(digit, std::string::npos);
    held = held << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(held >> (bits -= 8) & 0xFFU);
  }
  return bytes;
}

// Words of a buffer on this machine, which is little-endian as the files are.
template <class Word>
std::vector<Word> words(const std::string& bytes) {
  std::vector<Word> all(bytes.size() / sizeof(Word));
  std::memcpy(all.data(), bytes.data(), all.size() * sizeof(Word));
  return all;
}

Triples in_threes(const std::vector<double>& flat) {
  Triples all;
  for (std::size_t k = 0; k + 2 < flat.size(); k += 3) all.push_back({flat[k], flat[k + 1], flat[k + 2]});
  return all;
}

// CLAIM      .csv has a header and a row an element: index, object, centroid, normal, area, B and H per channel, read
//            back to the same doubles; quotes in names are doubled, no name ends a line.
// ORACLE     exact: the numbers that were put in; fields counted from the right, where no name can be.
// TOLERANCE  none.
TEST(SolutionFile, CsvReadsBackToTheSameDoubles) {
  proves({}, Oracle::exact, "the numbers that were put in");
  const Solved solved;
  std::istringstream lines(solution_csv(solved.surfaces()));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "element,object,x,y,z,normal_x,normal_y,normal_z,area,radiosity_red,radiosity_green,radiosity_blue,"
            "irradiance_red,irradiance_green,irradiance_blue");
  std::size_t k = 0;
  for (; std::getline(lines, line); ++k) {
    ASSERT_LT(k, solved.mesh.elements.size());
    const std::string start = std::to_string(k) + (k < 4 ? ",\"a \"\"b\"\", c\\n\"," : ",\"tail\\\",");
    ASSERT_EQ(line.substr(0, start.size()), start);
    std::istringstream cells(line.substr(start.size()));
    std::vector<double> found, expected;
    for (std::string cell; std::getline(cells, cell, ',');) found.push_back(std::strtod(cell.c_str(), nullptr));
    const Polygon& polygon = solved.mesh.elements[k].polygon;
    const auto expect = [&](const auto& v) { expected.insert(expected.end(), {v(0), v(1), v(2)}); };
    expect(polygon.centroid());
    expect(polygon.normal());
    expected.push_back(polygon.area());
    expect(solved.radiosity[k]);
    expect(solved.irradiance[k]);
    EXPECT_TRUE(holds(found == expected)) << line;
  }
  EXPECT_EQ(k, 5u);
}

// CLAIM      .npy holds B as n × 3 doubles after a header of a multiple of 64 bytes.
// ORACLE     exact: the format's published layout, taken apart here.
// TOLERANCE  none.
TEST(SolutionFile, NpyHoldsTheRadiosities) {
  proves({}, Oracle::exact, "the numbers that were put in");
  const Solved solved;
  const std::string bytes = solution_npy(solved.surfaces());
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t begin = 10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ(begin % 64, 0u);
  EXPECT_NE(bytes.find("'descr': '<f8', 'fortran_order': False, 'shape': (5, 3)"), std::string::npos);
  EXPECT_TRUE(holds(in_threes(words<double>(bytes.substr(begin))) == triples(solved.radiosity)));
}

// The array of this name: its type as written, and its bytes, the length before them checked.
std::string vtu_array(const std::string& text, const std::string& type, const std::string& name, int components) {
  const std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                          std::to_string(components) + "\" format=\"binary\">\n";
  const std::size_t at = text.find(tag);
  EXPECT_NE(at, std::string::npos) << tag;
  if (at == std::string::npos) return {};
  const std::size_t begin = at + tag.size();
  const std::string framed = decoded(text.substr(begin, text.find('\n', begin) - begin));
  EXPECT_EQ(words<std::uint64_t>(framed.substr(0, 8)).at(0), framed.size() - 8) << name;
  return framed.substr(8);
}

// CLAIM      .vtu holds every corner, cell and value to the last bit, cells being polygons over their own corners.
// ORACLE     exact: the numbers that were put in, read by a decoder of its own.
// TOLERANCE  none.
TEST(SolutionFile, VtuHoldsEveryBit) {
  proves({}, Oracle::exact, "the numbers that were put in");
  const Solved solved;
  const std::string text = solution_vtu(solved.surfaces());
  EXPECT_NE(text.find("byte_order=\"LittleEndian\" header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(text.find("<Piece NumberOfPoints=\"19\" NumberOfCells=\"5\">"), std::string::npos);
  const auto three = [&](const char* name) { return in_threes(words<double>(vtu_array(text, "Float64", name, 3))); };
  const auto one = [&](const char* name) { return words<std::int64_t>(vtu_array(text, "Int64", name, 1)); };
  EXPECT_TRUE(holds(three("Points") == corner_points(solved)));
  EXPECT_TRUE(holds(three("vertex_radiosity") == corner_shades(solved)));
  EXPECT_TRUE(holds(three("radiosity") == triples(solved.radiosity)));
  EXPECT_TRUE(holds(three("irradiance") == triples(solved.irradiance)));
  EXPECT_TRUE(holds(three("emission") == triples(solved.emission)));
  Triples rho(4, {0.1, 1.0 / 3, 0.7});
  rho.push_back({0, 0, 0});
  EXPECT_TRUE(holds(three("reflectance") == rho));
  EXPECT_EQ(one("offsets"), (std::vector<std::int64_t>{4, 8, 12, 16, 19}));
  EXPECT_EQ(one("object"), (std::vector<std::int64_t>{0, 0, 0, 0, 1}));
  EXPECT_EQ(one("patch"), (std::vector<std::int64_t>{0, 1, 0, 1, 2}));
  EXPECT_EQ(vtu_array(text, "UInt8", "types", 1), std::string(5, '\7'));
  const auto connectivity = one("connectivity");
  ASSERT_EQ(connectivity.size(), 19u);
  for (std::size_t k = 0; k < connectivity.size(); ++k) EXPECT_EQ(connectivity[k], static_cast<std::int64_t>(k));
}

// The transfer function of IEC 61966-2-1.
double display(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// CLAIM      .obj has a line a corner, its place to the last bit and its colour as displays want it, and a face an
//            element; names begin their objects and cannot continue a line.
// ORACLE     exact: places; closed form: sRGB's transfer function of min(1, 0.6 B).
// TOLERANCE  colours: 8 roundings of values up to 1.055, from pow on.
TEST(SolutionFile, ObjHasPlacesAndColours) {
  proves({}, Oracle::closed_form, "the numbers that were put in, the transfer function");
  constexpr double kRoundings = 8 * 1.055 * 0x1p-53;
  const Solved solved;
  std::istringstream lines(solution_obj(solved.surfaces()));
  const Triples shades = corner_shades(solved);
  Triples places;
  std::size_t next = 0;
  std::vector<std::string> objects;
  std::vector<std::size_t> sides;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream rest(line.size() > 2 ? line.substr(2) : "");
    if (line.rfind("o ", 0) == 0) objects.push_back(line);
    if (line.rfind("v ", 0) == 0) {
      std::string cell;
      std::vector<double> numbers;
      while (rest >> cell) numbers.push_back(std::strtod(cell.c_str(), nullptr));
      ASSERT_EQ(numbers.size(), 6u);
      ASSERT_LT(places.size(), shades.size());
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_TRUE(near(numbers[3 + c], display(std::min(1.0, 0.6 * shades[places.size()][c])), kRoundings));
      }
      places.push_back({numbers[0], numbers[1], numbers[2]});
    }
    if (line.rfind("f ", 0) == 0) {
      sides.push_back(0);
      for (std::size_t index = 0; rest >> index; ++sides.back()) EXPECT_EQ(index, ++next);
      EXPECT_EQ(next, places.size()) << "corners stand before their face";
    }
  }
  EXPECT_TRUE(holds(places == corner_points(solved)));
  EXPECT_EQ(sides, (std::vector<std::size_t>{4, 4, 4, 4, 3}));
  EXPECT_EQ(objects, (std::vector<std::string>{"o a \"b\", c/n", "o tail/"}));
}

// The numbers of an accessor, every length and offset on the way checked.
template <class Word>
std::vector<Word> accessor(const Json& json, const std::string& buffer, const Json& index, int type,
                           std::size_t parts) {
  const Json& described = json["accessors"].at(index.get<std::size_t>());
  const Json& view = json["bufferViews"].at(described["bufferView"].get<std::size_t>());
  EXPECT_EQ(described["componentType"], type);
  EXPECT_EQ(described["type"], parts == 3 ? "VEC3" : "SCALAR");
  const auto offset = described["byteOffset"].get<std::size_t>(), start = view["byteOffset"].get<std::size_t>();
  const std::size_t bytes = described["count"].get<std::size_t>() * parts * sizeof(Word);
  EXPECT_EQ((offset + start) % sizeof(Word), 0u);
  EXPECT_LE(offset + bytes, view["byteLength"].get<std::size_t>());
  EXPECT_LE(start + view["byteLength"].get<std::size_t>(), buffer.size());
  return words<Word>(buffer.substr(start + offset, bytes));
}

// Both forms must hold the same; `buffer` is what the first buffer holds.
void expect_gltf(const Json& json, const std::string& buffer, const Solved& solved) {
  EXPECT_EQ(json["asset"]["version"], "2.0");
  EXPECT_EQ(json["asset"]["extras"]["exposure"], 0.6);
  EXPECT_EQ(json["extensionsUsed"], Json::array({"KHR_materials_unlit"}));
  EXPECT_EQ(json["materials"][0]["extensions"], (Json{{"KHR_materials_unlit", Json::object()}}));
  EXPECT_EQ(json["buffers"][0]["byteLength"], buffer.size());
  EXPECT_EQ(json["scenes"][0]["nodes"], Json::array({0}));
  EXPECT_EQ(json["nodes"][0]["children"], Json::array({1, 2, 3}));
  // Eye (1/3, −2, 0.7) units of 0.3 m, looking along y, z up, half angle 0.5, a square picture.
  const double stand[] = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0.3 / 3, -0.6, 0.21, 1};
  for (std::size_t k = 0; k < 16; ++k) {
    EXPECT_TRUE(near(json["nodes"][3]["matrix"].at(k).get<double>(), stand[k], 4 * 0x1p-53));
  }
  EXPECT_EQ(json["nodes"][3]["camera"], 0);
  EXPECT_TRUE(near(json["cameras"][0]["perspective"]["yfov"].get<double>(), 1, 8 * 0x1p-53));
  EXPECT_TRUE(near(json["cameras"][0]["perspective"]["aspectRatio"].get<double>(), 1, 4 * 0x1p-53));
  ASSERT_EQ(json["meshes"].size(), 2u);
  std::size_t k = 0;
  for (std::size_t object = 0; object < 2; ++object) {
    EXPECT_EQ(json["meshes"][object]["name"], solved.scene.objects[object].name);
    EXPECT_EQ(json["nodes"][object + 1]["mesh"], object);
    const Json& primitive = json["meshes"][object]["primitives"].at(0);
    const Json& attributes = primitive["attributes"];
    const auto places = accessor<float>(json, buffer, attributes["POSITION"], 5126, 3);
    const auto colours = accessor<float>(json, buffer, attributes["COLOR_0"], 5126, 3);
    const auto radiosities = accessor<float>(json, buffer, attributes["_RADIOSITY"], 5126, 3);
    const auto indices = accessor<std::uint32_t>(json, buffer, primitive["indices"], 5125, 1);
    ASSERT_EQ(colours.size(), places.size());
    ASSERT_EQ(radiosities.size(), places.size());
    // Elements one after another: centroid, corners; triangles (centroid, corner, next corner).
    std::size_t vertex = 0, index = 0;
    for (; k < solved.mesh.elements.size() && solved.mesh.face_of(solved.mesh.elements[k]).object == object; ++k) {
      const Polygon& polygon = solved.mesh.elements[k].polygon;
      const auto& shades = solved.vertices.corners[k];
      const std::size_t corners = shades.size(), centre = vertex;
      ASSERT_LE(3 * (vertex + corners + 1), places.size());
      ASSERT_LE(index + 3 * corners, indices.size());
      for (std::size_t v = 0; v <= corners; ++v, ++vertex) {
        for (std::size_t c = 0; c < 3; ++c) {
          const auto axis = static_cast<Eigen::Index>(c);
          double sum = 0;
          for (const Rgb& shade : shades) sum += shade(axis);
          const double value = v == 0 ? sum / static_cast<double>(corners) : shades[v - 1](axis);
          const double place = v == 0 ? polygon.centroid()(axis) : polygon.vertices()[v - 1](axis);
          const double rounding = v == 0 ? value * 0x1p-23 : 0;  // the mean, in another order, to single precision
          EXPECT_EQ(places[3 * vertex + c], static_cast<float>(place * 0.3));
          EXPECT_TRUE(near(radiosities[3 * vertex + c], static_cast<float>(value), rounding));
          EXPECT_TRUE(near(colours[3 * vertex + c], static_cast<float>(std::min(1.0, 0.6 * value)), rounding));
        }
      }
      for (std::size_t v = 0; v < corners; ++v) {
        EXPECT_EQ(indices[index++], centre);
        EXPECT_EQ(indices[index++], centre + 1 + v);
        EXPECT_EQ(indices[index++], centre + 1 + (v + 1 == corners ? 0 : v + 1));
      }
    }
    EXPECT_TRUE(holds(3 * vertex == places.size() && index == indices.size()));
    const Json& described = json["accessors"].at(attributes["POSITION"].get<std::size_t>());
    for (std::size_t c = 0; c < 3; ++c) {
      float low = places[c], high = places[c];
      for (std::size_t v = c; v < places.size(); v += 3) {
        low = std::min(low, places[v]);
        high = std::max(high, places[v]);
      }
      EXPECT_TRUE(holds(described["min"][c].get<float>() == low && described["max"][c].get<float>() == high));
    }
  }
  EXPECT_EQ(k, solved.mesh.elements.size());
}

// CLAIM      .gltf and .glb hold the same: places in metres, colours and radiosities in single precision, fans of
//            triangles that are seen from the front, offsets in range, min and max of positions as they are; a camera as
//            the scene's.
// ORACLE     exact: the numbers that were put in, rounded to single precision here; the published layout of both forms.
// TOLERANCE  none, but for means at centroids: one unit in the last place of single precision; of the camera, 4 to 8
//            roundings of numbers of at most 2.
TEST(SolutionFile, GltfHoldsPlacesAndLinearColours) {
  proves({}, Oracle::exact, "the numbers that were put in");
  const Solved solved;
  const Json json = Json::parse(solution_gltf(solved.surfaces()));
  const std::string uri = json["buffers"][0]["uri"], start = "data:application/octet-stream;base64,";
  ASSERT_EQ(uri.substr(0, start.size()), start);
  expect_gltf(json, decoded(uri.substr(start.size())), solved);

  const std::string bytes = solution_glb(solved.surfaces());
  ASSERT_EQ(bytes.size() % 4, 0u);
  const auto head = words<std::uint32_t>(bytes);
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(head[1], 2u);
  EXPECT_EQ(head[2], bytes.size());
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  const std::size_t text = head[3];
  ASSERT_EQ(text % 4, 0u);
  EXPECT_EQ(bytes.substr(20 + text + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(head[(20 + text) / 4] + 28 + text, bytes.size());
  expect_gltf(Json::parse(bytes.substr(20, text)), bytes.substr(28 + text), solved);
}

// CLAIM      The root node of a glTF turns the camera's "up" into y by a rotation, whichever axis it is nearest to.
// ORACLE     closed form: q a q* of the unit quaternion q, by Hamilton's products written out.
// TOLERANCE  8 roundings of products of at most 1.
TEST(SolutionFile, GltfStandsUpright) {
  proves({}, Oracle::closed_form, "a vector turned by a quaternion");
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Solved solved;
      solved.scene.camera.up = Vec3(0.2, 0.1, -0.3);
      solved.scene.camera.up(axis) = sign;
      const Json q = Json::parse(solution_gltf(solved.surfaces()))["nodes"][0]["rotation"];
      const double x = q[0], y = q[1], z = q[2], w = q[3];
      EXPECT_TRUE(near(x * x + y * y + z * z + w * w, 1, 8 * 0x1p-53));
      const double a[] = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
      EXPECT_TRUE(near((1 - 2 * (y * y + z * z)) * a[0] + 2 * (x * y - z * w) * a[1] + 2 * (x * z + y * w) * a[2], 0,
                       8 * 0x1p-53));
      EXPECT_TRUE(near(2 * (x * y + z * w) * a[0] + (1 - 2 * (x * x + z * z)) * a[1] + 2 * (y * z - x * w) * a[2], 1,
                       8 * 0x1p-53));
      EXPECT_TRUE(near(2 * (x * z - y * w) * a[0] + 2 * (y * z + x * w) * a[1] + (1 - 2 * (x * x + y * y)) * a[2], 0,
                       8 * 0x1p-53));
    }
  }
}

// CLAIM      Another ending, and a file that is named twice, are refused before anything is computed.
// ORACLE     exact: the words.
// TOLERANCE  none.
TEST(SolutionFile, RefusesOtherEndings) {
  proves({}, Oracle::exact, "the words");
  EXPECT_TRUE(holds(check_solution_paths({"a.csv", "a.npy", "a.vtu", "a.obj", "a.gltf", "a.glb"}).ok()));
  const auto message = [](const std::vector<std::filesystem::path>& paths) {
    const auto checked = check_solution_paths(paths);
    return checked ? "" : checked.error().message;
  };
  EXPECT_EQ(message({"a.csv", "a.vtk"}),
            "'a.vtk': found ending '.vtk', expected .csv, .npy, .vtu, .obj, .gltf or .glb; did you mean '.vtu'?");
  EXPECT_EQ(message({"a"}), "'a': found ending '', expected .csv, .npy, .vtu, .obj, .gltf or .glb");
  EXPECT_EQ(message({"a.csv", "./a.csv"}).find("'./a.csv' is named twice"), 0u) << message({"a.csv", "./a.csv"});
}

}  // namespace
}  // namespace etendue::validation
