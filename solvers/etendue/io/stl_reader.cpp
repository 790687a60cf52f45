// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/stl_reader.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/byte_text.hpp"
#include "etendue/io/surface_builder.hpp"

namespace etendue {

namespace {

constexpr std::size_t kHeader = 84;    // bytes: a comment of 80, the count
constexpr std::size_t kTriangle = 50;  // normal, three vertices, two bytes of attributes

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  return read_little<std::uint32_t>(bytes.substr(offset));
}

double real_at(std::string_view bytes, std::size_t offset) {
  return static_cast<double>(std::bit_cast<float>(word_at(bytes, offset)));
}

class Reader {
 public:
  Reader(SurfaceModel& model, ReadErrors& errors) : model_(model), errors_(errors), builder_(model, errors) {}

  void run(std::string_view bytes) {
    const bool says_solid = bytes.substr(0, 5) == "solid";
    const std::size_t count = bytes.size() >= kHeader ? word_at(bytes, kHeader - 4) : 0;
    if (bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * count) {
      binary(bytes, count);
    } else if (says_solid) {
      ascii(bytes);
    } else if (bytes.size() < kHeader) {
      errors_.add(
          0, "found " + std::to_string(bytes.size()) + " bytes that do not begin with 'solid', expected an STL file");
    } else {
      errors_.add(0, "found " + std::to_string(bytes.size()) + " bytes, expected " +
                         std::to_string(kHeader + kTriangle * count) + " for the " + std::to_string(count) +
                         " triangles that bytes 81 to 84 announce: cut short, or no STL file");
    }
    if (errors_.count() == 0 && triangles_ == 0) errors_.add(0, "found no triangle, expected some");
    builder_.finish();
    if (turned_ > 0) {
      model_.notes.push_back(std::to_string(turned_) +
                             " triangles have a normal against the order of their vertices: the order counts");
    }
  }

 private:
  void triangle(const Vec3 (&corners)[3], const Vec3& normal, std::size_t line) {
    const std::string name = "triangle " + std::to_string(++triangles_);
    for (const Vec3& corner : corners) {
      if (corner.allFinite() && corner.cwiseAbs().maxCoeff() <= kFarthestCoordinate) continue;
      errors_.add(line, name + ": found a coordinate that is no finite number, expected none larger than 1e50");
      return;
    }
    const auto polygon = builder_.polygon({corners[0], corners[1], corners[2]}, line, name);
    if (!polygon) return;
    if (normal.allFinite() && polygon->normal().dot(normal) < 0) ++turned_;
    model_.rows.push_back(
        {name, {{builder_.element(*polygon, builder_.face(*polygon, line, name)), 1}}, polygon->area(), 1});
  }

  void binary(std::string_view bytes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t begin = kHeader + k * kTriangle;
      Vec3 vectors[4];
      for (std::size_t n = 0; n < 12; ++n) {
        vectors[n / 3][static_cast<Eigen::Index>(n % 3)] = real_at(bytes, begin + 4 * n);
      }
      triangle({vectors[1], vectors[2], vectors[3]}, vectors[0], begin + 1);
    }
  }

  void ascii(std::string_view text) {
    const auto lines = lines_of(text);
    bool ended = false;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const auto words = words_of(lines[k], " \t");
      if (words.empty()) continue;
      line_ = k + 1;
      if (words[0] == "solid") {
        model_.name = words.size() > 1 ? shown(words[1]) : model_.name;
        ended = false;
      } else if (words[0] == "endsolid") {
        ended = true;
        if (state_ != State::outside) expected("endfacet");
        state_ = State::outside;
      } else {
        record(words);
      }
    }
    line_ = lines.size();
    if (!ended) complain("found the end of the file, expected endsolid: cut short?");
  }

  enum class State { outside, facet, loop, closed };

  void complain(const std::string& message) { errors_.add(line_, message); }
  void expected(const std::string& what) {
    complain("triangle " + std::to_string(triangles_ + 1) + ": found something else, expected " + what);
  }

  void record(const std::vector<std::string_view>& words) {
    const std::string_view kind = words[0];
    if (kind == "facet") {
      if (state_ != State::outside) expected("endfacet");
      normal_ = numbers(words, 2, "facet normal");
      corners_.clear();
      begin_ = line_;
      state_ = State::facet;
    } else if (kind == "outer") {
      if (state_ != State::facet) expected("facet normal before outer loop");
      state_ = State::loop;
    } else if (kind == "vertex") {
      if (state_ != State::loop) expected("outer loop before vertex");
      corners_.push_back(numbers(words, 1, "vertex"));
    } else if (kind == "endloop") {
      if (state_ != State::loop) expected("outer loop before endloop");
      state_ = State::closed;
    } else if (kind == "endfacet") {
      if (state_ != State::closed) expected("endloop before endfacet");
      if (corners_.size() == 3) {
        triangle({corners_[0], corners_[1], corners_[2]}, normal_, begin_);
      } else {
        ++triangles_;
        complain("triangle " + std::to_string(triangles_) + ": found " + std::to_string(corners_.size()) +
                 " vertices, expected 3");
      }
      state_ = State::outside;
    } else {
      complain("found unknown word '" + shown(kind) +
               "', expected solid, facet, outer, vertex, endloop, endfacet or endsolid");
    }
  }

  /// The three numbers from word `first` on; what is none becomes 0 and is reported.
  Vec3 numbers(const std::vector<std::string_view>& words, std::size_t first, const std::string& what) {
    Vec3 result = Vec3::Zero();
    if (words.size() != first + 3) {
      complain("triangle " + std::to_string(triangles_ + 1) + ": found " + std::to_string(words.size()) +
               " words, expected '" + what + " x y z'");
      return result;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = parse_number(words[first + k]);
      if (value && std::abs(*value) <= kFarthestCoordinate) {
        result[static_cast<Eigen::Index>(k)] = *value;
      } else {
        complain("triangle " + std::to_string(triangles_ + 1) + ", " + what + ": found '" + shown(words[first + k]) +
                 "', expected a finite number no larger than 1e50");
      }
    }
    return result;
  }

  SurfaceModel& model_;
  ReadErrors& errors_;
  SurfaceBuilder builder_;
  std::size_t triangles_ = 0, turned_ = 0, line_ = 0, begin_ = 0;
  State state_ = State::outside;
  Vec3 normal_ = Vec3::Zero();
  std::vector<Vec3> corners_;
};

}  // namespace

Result<SurfaceModel> read_stl(const std::filesystem::path& path) {
  return built_from(
      path, [](std::string_view bytes, SurfaceModel& model, ReadErrors& errors) { Reader(model, errors).run(bytes); });
}

}  // namespace etendue
