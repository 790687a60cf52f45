// SPDX-License-Identifier: Apache-2.0
// The tables: CSV and NumPy.
#include "etendue/io/byte_text.hpp"
#include "etendue/io/solution_file.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

/// A field as RFC 4180 has it: quotes in it doubled.
std::string quoted_field(const std::string& name) {
  std::string text = "\"";
  for (const char c : printable(name)) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

template <class Three>
void append_three(std::string& line, const Three& values) {
  for (Eigen::Index c = 0; c < 3; ++c) line += ',' + shortest(values(c));
}

}  // namespace

std::string solution_csv(const SolvedSurfaces& solved) {
  std::string text =
      "element,object,x,y,z,normal_x,normal_y,normal_z,area,radiosity_red,radiosity_green,radiosity_blue,"
      "irradiance_red,irradiance_green,irradiance_blue\n";
  for (std::size_t k = 0; k < solved.mesh.elements.size(); ++k) {
    const Element& element = solved.mesh.elements[k];
    text += std::to_string(k) + ',' + quoted_field(solved.scene.objects[solved.mesh.face_of(element).object].name);
    append_three(text, element.polygon.centroid());
    append_three(text, element.polygon.normal());
    text += ',' + shortest(element.polygon.area());
    append_three(text, solved.radiosity[k]);
    append_three(text, solved.irradiance[k]);
    text += '\n';
  }
  return text;
}

std::string solution_npy(const SolvedSurfaces& solved) {
  std::string bytes = npy_header(solved.radiosity.size(), 3);
  for (const Rgb& radiosity : solved.radiosity) {
    for (Eigen::Index c = 0; c < 3; ++c) append_little(bytes, radiosity(c));
  }
  return bytes;
}

}  // namespace etendue
