// SPDX-License-Identifier: Apache-2.0
// ParaView: VTK's XML form of an unstructured grid.
#include "etendue/io/byte_text.hpp"
#include "etendue/io/solution_file.hpp"

namespace etendue {

namespace {

constexpr char kPolygonCell = 7;  ///< VTK_POLYGON

/// An array in line: of the 64-bit length and the bytes together, base64.
std::string data_array(const std::string& name, const char* type, int components, const std::string& bytes) {
  std::string framed;
  append_little(framed, std::uint64_t{bytes.size()});
  framed += bytes;
  return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"binary\">\n" + base64(framed) + "\n</DataArray>\n";
}

/// `three(k)` of each element.
template <class Three>
std::string cell_triples(const std::string& name, std::size_t elements, const Three& three) {
  std::string bytes;
  for (std::size_t k = 0; k < elements; ++k) {
    const Rgb values = three(k);
    for (Eigen::Index c = 0; c < 3; ++c) append_little(bytes, values(c));
  }
  return data_array(name, "Float64", 3, bytes);
}

template <class Count>
std::string cell_counts(const std::string& name, std::size_t elements, const Count& count) {
  std::string bytes;
  for (std::size_t k = 0; k < elements; ++k) append_little(bytes, std::uint64_t{count(k)});
  return data_array(name, "Int64", 1, bytes);
}

std::string cell_data(const SolvedSurfaces& solved) {
  const auto& elements = solved.mesh.elements;
  const auto face = [&](std::size_t k) -> const Face& { return solved.mesh.face_of(elements[k]); };
  const std::size_t n = elements.size();
  return "<CellData Scalars=\"radiosity\">\n" +
         cell_triples("radiosity", n, [&](std::size_t k) { return solved.radiosity[k]; }) +
         cell_triples("irradiance", n, [&](std::size_t k) { return solved.irradiance[k]; }) +
         cell_triples("reflectance", n, [&](std::size_t k) { return solved.scene.materials[face(k).material].rho; }) +
         cell_triples("emission", n, [&](std::size_t k) { return solved.emission[k]; }) +
         cell_counts("patch", n, [&](std::size_t k) { return elements[k].patch; }) +
         cell_counts("object", n, [&](std::size_t k) { return face(k).object; }) + "</CellData>\n";
}

}  // namespace

std::string solution_vtu(const SolvedSurfaces& solved) {
  const auto& elements = solved.mesh.elements;
  std::string corners, shades, connectivity, offsets;
  std::uint64_t points = 0;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const auto& vertices = elements[k].polygon.vertices();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      for (Eigen::Index c = 0; c < 3; ++c) append_little(corners, vertices[v](c));
      for (Eigen::Index c = 0; c < 3; ++c) append_little(shades, solved.vertices.corners[k][v](c));
      append_little(connectivity, points++);
    }
    append_little(offsets, points);
  }
  return "<?xml version=\"1.0\"?>\n<!-- radiosity, irradiance, emission: red, green, blue [W/m2]; lengths in scene "
         "units -->\n"
         "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
         "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
         std::to_string(points) + "\" NumberOfCells=\"" + std::to_string(elements.size()) + "\">\n<Points>\n" +
         data_array("Points", "Float64", 3, corners) + "</Points>\n<Cells>\n" +
         data_array("connectivity", "Int64", 1, connectivity) + data_array("offsets", "Int64", 1, offsets) +
         data_array("types", "UInt8", 1, std::string(elements.size(), kPolygonCell)) + "</Cells>\n" +
         "<PointData Scalars=\"vertex_radiosity\">\n" + data_array("vertex_radiosity", "Float64", 3, shades) +
         "</PointData>\n" + cell_data(solved) + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace etendue
