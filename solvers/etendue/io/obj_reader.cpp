// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/obj_reader.hpp"

#include <cmath>
#include <map>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/surface_builder.hpp"

namespace etendue {

namespace {

using Words = std::vector<std::string_view>;

struct ObjFace {
  std::size_t line = 0;
  std::string group;
  std::vector<long> corners;  ///< positions among all vertices, from 1
};

class Parser {
 public:
  Parser(SurfaceModel& model, ReadErrors& errors) : model_(model), errors_(errors), builder_(model, errors) {}

  void run(std::string_view text) {
    const auto lines = lines_of(text);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      line_ = k + 1;
      std::string joined(lines[k].substr(0, lines[k].find('#')));
      while (!joined.empty() && joined.back() == '\\' && k + 1 < lines.size()) {
        joined.back() = ' ';
        ++k;
        joined += lines[k].substr(0, lines[k].find('#'));
      }
      const Words words = words_of(joined, " \t");
      if (!words.empty()) record(words);
    }
    line_ = 0;
    if (faces_.empty()) complain("found no face, expected records f");
    std::map<std::string, std::size_t> sizes, counted;
    for (const ObjFace& face : faces_) ++sizes[face.group];
    for (const ObjFace& face : faces_) {
      const std::size_t position = ++counted[face.group];
      add(face, sizes[face.group] > 1 ? face.group + "[" + std::to_string(position) + "]" : face.group);
    }
    builder_.finish();
    if (lines_and_points_ > 0) {
      model_.notes.push_back(std::to_string(lines_and_points_) +
                             " records l and p left out: lines and points have no area");
    }
  }

 private:
  void complain(const std::string& message) { errors_.add(line_, message); }

  void record(const Words& words) {
    static const std::vector<std::string_view> unused{"vt", "vn", "vp", "s", "mtllib", "usemtl", "mg"};
    const std::string_view kind = words[0];
    if (kind == "v") return vertex(words);
    if (kind == "f") return face(words);
    if (kind == "o" || kind == "g") {
      group_ = words.size() > 1 ? shown(words[1]) : "face";
      return;
    }
    if (kind == "l" || kind == "p") {
      ++lines_and_points_;
      return;
    }
    for (const std::string_view known : unused) {
      if (kind == known) return;
    }
    complain("found unknown record '" + shown(kind) + "', expected v, f, o, g, vt, vn, vp, s, mtllib, usemtl, l or p");
  }

  void vertex(const Words& words) {
    Vec3 point = Vec3::Constant(std::nan(""));
    if (words.size() < 4) {
      complain("vertex " + std::to_string(vertices_.size() + 1) + ": found " + std::to_string(words.size() - 1) +
               " coordinates, expected x y z");
    }
    for (std::size_t axis = 0; axis < 3 && words.size() >= 4; ++axis) {
      const auto value = parse_number(words[axis + 1]);
      if (value && std::abs(*value) <= kFarthestCoordinate) {
        point[static_cast<Eigen::Index>(axis)] = *value;
      } else {
        complain("vertex " + std::to_string(vertices_.size() + 1) + ": found '" + shown(words[axis + 1]) +
                 "', expected a finite number no larger than 1e50");
      }
    }
    vertices_.push_back(point);
  }

  void face(const Words& words) {
    ObjFace face{line_, group_, {}};
    const std::string called = "face " + std::to_string(faces_.size() + 1);
    if (words.size() < 4)
      complain(called + ": found " + std::to_string(words.size() - 1) + " corners, expected 3 or more");
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto given = parse_integer(words[k].substr(0, words[k].find('/')));
      const long count = static_cast<long>(vertices_.size());
      const long position = given && *given < 0 && *given >= -count ? count + 1 + *given : given.value_or(0);
      if (position < 1 || position > count) {
        complain(called + ", corner " + std::to_string(k) + ": found '" + shown(words[k]) +
                 "', expected a vertex in [1, " + std::to_string(count) + "] or counted back from -1");
        continue;
      }
      face.corners.push_back(position);
    }
    if (face.corners.size() + 1 != words.size()) face.corners.clear();
    faces_.push_back(std::move(face));
  }

  void add(const ObjFace& face, const std::string& name) {
    std::vector<Vec3> corners;
    for (const long position : face.corners) {
      corners.push_back(vertices_[static_cast<std::size_t>(position) - 1]);
      if (!corners.back().allFinite()) return;  // reported where it stands
    }
    if (corners.size() < 3) return;  // reported too
    const auto polygon = builder_.polygon(std::move(corners), face.line, "surface '" + name + "'");
    if (!polygon) return;
    const std::vector<Polygon> parts = convex_parts(*polygon);
    double area = 0;
    ComposedRow row{name, {}, polygon->area(), 1};
    for (const Polygon& part : parts) {
      area += part.area();
      row.terms.push_back({builder_.element(part, builder_.face(part, face.line, name)), 1});
    }
    constexpr double kRounding = 1e-9;  // of the areas' sum: what is lost is more than digits
    if (!(std::abs(area - polygon->area()) <= kRounding * polygon->area())) {
      errors_.add(face.line,
                  "surface '" + name + "': found a concave outline that cannot be cut into triangles; cut it");
    }
    model_.rows.push_back(std::move(row));
  }

  SurfaceModel& model_;
  ReadErrors& errors_;
  SurfaceBuilder builder_;
  std::size_t line_ = 0;
  std::string group_ = "face";
  std::vector<Vec3> vertices_;
  std::vector<ObjFace> faces_;
  std::size_t lines_and_points_ = 0;
};

}  // namespace

Result<SurfaceModel> read_obj(const std::filesystem::path& path) {
  return built_from(
      path, [](std::string_view bytes, SurfaceModel& model, ReadErrors& errors) { Parser(model, errors).run(bytes); });
}

}  // namespace etendue
