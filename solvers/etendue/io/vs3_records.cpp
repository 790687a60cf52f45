// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/vs3_records.hpp"

#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "etendue/io/nearest.hpp"

namespace etendue {

namespace {

using Words = std::vector<std::string_view>;

constexpr std::string_view kSeparators = " ,\t";

char upper(char c) {
  return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
}

/// Exact at multiples of 90°.
struct Turn {
  double sine, cosine;
};
Turn turn(double degrees) {
  const double quarter = std::remainder(degrees, 360.0) / 90;
  if (quarter == std::floor(quarter)) {
    const int k = (static_cast<int>(quarter) % 4 + 4) % 4;
    constexpr double kSines[] = {0, 1, 0, -1};
    return {kSines[k], kSines[(k + 1) % 4]};
  }
  const double radians = quarter * std::numbers::pi / 2;
  return {std::sin(radians), std::cos(radians)};
}

class Parser {
 public:
  Parser(std::string_view text, ReadErrors& errors) : lines_(lines_of(text)), errors_(errors) {}

  Vs3File parse() {
    while (next_line()) {
      if (!record()) break;
    }
    if (format_ == Format::none) errors_.add(0, "found no record 'F 3' or 'F 3a', which says how geometry is given");
    if (file_.surfaces.empty()) errors_.add(0, "found no surface, expected records S");
    return std::move(file_);
  }

 private:
  enum class Format { none, vertices, blast };

  /// The next line that holds a word; its comment is cut off.
  bool next_line() {
    while (at_ < lines_.size()) {
      std::string_view line = lines_[at_++];
      line = line.substr(0, line.find('!'));
      words_ = words_of(line, kSeparators);
      if (!words_.empty()) return true;
    }
    return false;
  }

  void complain(const std::string& message) { errors_.add(at_, message); }

  /// Reads one; false at the end of the data.
  bool record() {
    switch (upper(words_[0][0])) {
      case '*':
      case 'E':
        return false;
      case '/':
      case 'X':
        return true;
      case 'T':
        title();
        return true;
      case 'C':
        control();
        return true;
      case 'F':
        format();
        return true;
      case 'V':
        vertex();
        return true;
      case 'S':
        surface(Vs3Surface::Kind::surface);
        return true;
      case 'M':
        surface(Vs3Surface::Kind::mask);
        return true;
      case 'N':
        surface(Vs3Surface::Kind::null);
        return true;
      case 'O':
        surface(Vs3Surface::Kind::obstruction);
        return true;
      default:
        complain("found unknown record '" + shown(words_[0]) + "', expected one of T C F V S M N O X / E *");
        return true;
    }
  }

  void title() {
    const std::string_view line = lines_[at_ - 1];
    const std::size_t begin = line.find_first_of(kSeparators, line.find_first_not_of(kSeparators));
    const std::size_t word = begin == std::string_view::npos ? begin : line.find_first_not_of(kSeparators, begin);
    file_.title = word == std::string_view::npos ? "" : std::string(line.substr(word));
  }

  void control() {
    static const std::vector<std::string> known{"eps",  "list", "out", "encl", "emit", "maxU",
                                                "maxO", "minO", "row", "col",  "prjD", "maxV"};
    std::string joined;
    for (std::size_t k = 1; k < words_.size(); ++k) joined += std::string(words_[k]) + " ";
    const Words pairs = words_of(joined, " =");
    for (std::size_t k = 0; k < pairs.size(); k += 2) {
      std::string key;
      for (const std::string& name : known) {
        if (edit_distance(name, pairs[k]) == 0) key = name;  // case does not count
      }
      if (key.empty()) {
        complain("found unknown control '" + shown(pairs[k]) +
                 "', expected one of eps list out encl emit maxU maxO minO "
                 "row col prjD maxV" +
                 did_you_mean(pairs[k], known));
      }
      const auto value = k + 1 < pairs.size() ? parse_number(pairs[k + 1]) : std::nullopt;
      if (!value) {
        complain("control " + shown(pairs[k]) + ": found " +
                 (k + 1 < pairs.size() ? "'" + shown(pairs[k + 1]) + "'" : "nothing") + ", expected a number");
        continue;
      }
      if (key == "encl") file_.enclosure = *value != 0;
      if (key == "emit") file_.emittances = *value != 0;
    }
  }

  void format() {
    const std::string word = words_.size() > 1 ? std::string(words_[1]) : "";
    Format found = Format::none;
    if (word == "3") found = Format::vertices;
    if (word == "3a" || word == "3A") found = Format::blast;
    if (found == Format::none) complain("record F: found '" + shown(word) + "', expected 3 or 3a");
    if (format_ != Format::none && found != format_) complain("record F: found a second one, expected one");
    format_ = found;
  }

  /// The number of word `k`, in [low, high].
  std::optional<long> integer(std::size_t k, const std::string& what, long low, long high) {
    const auto value = k < words_.size() ? parse_integer(words_[k]) : std::nullopt;
    if (value && *value >= low && *value <= high) return value;
    complain(what + ": found " + (k < words_.size() ? "'" + shown(words_[k]) + "'" : "nothing") +
             ", expected an integer in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
    return std::nullopt;
  }

  std::optional<double> real(std::string_view word, const std::string& what, double low, double high) {
    const auto value = parse_number(word);
    if (value && *value >= low && *value <= high) return value;
    complain(what + ": found '" + shown(word) + "', expected a finite number" +
             (high < kFarthestCoordinate ? " in [" + std::to_string(low) + ", " + std::to_string(high) + "]"
                                         : " no larger than 1e50"));
    return std::nullopt;
  }

  void vertex() {
    if (format_ == Format::blast) return complain("found a record V, expected none under F 3a");
    const long expected = static_cast<long>(vertices_.size()) + 1;
    const std::string what = "vertex " + std::to_string(expected);
    (void)integer(1, what + ", its number", expected, expected);
    Vec3 point = Vec3::Constant(std::nan(""));
    if (words_.size() != 5) {
      complain(what + ": found " + std::to_string(words_.size() > 2 ? words_.size() - 2 : 0) +
               " coordinates, expected x y z");
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = real(words_[axis + 2], what, -kFarthestCoordinate, kFarthestCoordinate);
        if (value) point[static_cast<Eigen::Index>(axis)] = *value;
      }
    }
    vertices_.push_back(point);
  }

  void surface(Vs3Surface::Kind kind) {
    Vs3Surface surface;
    surface.kind = kind;
    surface.line = at_;
    surface.number = static_cast<long>(file_.surfaces.size()) + 1;
    const bool obstruction = kind == Vs3Surface::Kind::obstruction;
    const std::size_t fields = format_ == Format::blast ? 3 : 6;  // before base
    surface.name = !obstruction && words_.size() > fields + 3 ? shown(words_[fields + 3]) : "";
    const std::string what = obstruction ? "obstruction " + std::to_string(surface.number) : surface.called();
    if (format_ == Format::none) complain(what + ": found before a record F, expected 'F 3' or 'F 3a' first");
    (void)integer(1, what + ", its number", surface.number, surface.number);
    if (!obstruction && !file_.surfaces.empty() && file_.surfaces.back().kind == Vs3Surface::Kind::obstruction) {
      complain(what + ": found after an obstruction, expected obstructions last");
    }
    if (!obstruction) {
      const long most = 1000000000;
      if (const auto base = integer(fields, what + ", base", 0, most)) surface.base = *base;
      if (const auto combined = integer(fields + 1, what + ", cmb", 0, most)) surface.combined = *combined;
      if (words_.size() > fields + 2) {
        if (const auto emittance = real(words_[fields + 2], what + ", emit", 0, 1)) surface.emittance = *emittance;
      } else {
        complain(what + ": found no emit, expected number, corners, base, cmb, emit and name");
      }
    }
    if (surface.name.empty())
      surface.name = (obstruction ? "obstruction " : "surface ") + std::to_string(surface.number);
    surface.corners = format_ == Format::blast ? blast_corners(what) : vertex_corners(what);
    file_.surfaces.push_back(std::move(surface));
  }

  std::vector<Vec3> vertex_corners(const std::string& what) {
    std::vector<Vec3> corners;
    bool sound = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto index = 2 + k < words_.size() ? parse_integer(words_[2 + k]) : std::nullopt;
      if (k == 3 && index && *index == 0) break;  // a triangle
      if (!index || *index < 1 || *index > static_cast<long>(vertices_.size())) {
        complain(what + ", corner " + std::to_string(k + 1) + ": found " +
                 (2 + k < words_.size() ? "'" + shown(words_[2 + k]) + "'" : "nothing") +
                 ", expected a vertex in [1, " + std::to_string(vertices_.size()) + "]" +
                 (k == 3 ? " or 0 for a triangle" : ""));
        sound = false;
        continue;
      }
      corners.push_back(vertices_[static_cast<std::size_t>(*index) - 1]);
      sound = sound && corners.back().allFinite();
    }
    return sound ? corners : std::vector<Vec3>();
  }

  /// The numbers that follow on lines of their own.
  std::vector<double> numbers_below(std::size_t count, const std::string& what) {
    std::vector<double> numbers;
    const std::size_t surface_line = at_;
    while (numbers.size() < count) {
      const std::size_t before = at_;
      if (!next_line() || !(std::isdigit(static_cast<unsigned char>(words_[0][0])) || words_[0][0] == '-' ||
                            words_[0][0] == '+' || words_[0][0] == '.')) {
        at_ = before;  // what stands there is a record of its own
        errors_.add(surface_line, what + ": found " + std::to_string(numbers.size()) + " numbers below it, expected " +
                                      std::to_string(count));
        return {};
      }
      for (const std::string_view word : words_) {
        const auto value = real(word, what, -kFarthestCoordinate, kFarthestCoordinate);
        numbers.push_back(value ? *value : std::nan(""));
      }
    }
    if (numbers.size() > count) {
      errors_.add(surface_line, what + ": found " + std::to_string(numbers.size()) + " numbers below it, expected " +
                                    std::to_string(count));
      return {};
    }
    for (const double value : numbers) {
      if (std::isnan(value)) return {};  // reported where it stands
    }
    return numbers;
  }

  std::vector<Vec3> blast_corners(const std::string& what) {
    const char shape = words_.size() > 2 && words_[2].size() == 1 ? upper(words_[2][0]) : '?';
    if (shape != 'R' && shape != 'T' && shape != 'Q') {
      complain(what + ", shape: found '" + (words_.size() > 2 ? shown(words_[2]) : "") + "', expected R, T or Q");
      return {};
    }
    const std::size_t plane = shape == 'R' ? 2 : (shape == 'T' ? 6 : 8);
    const std::vector<double> n = numbers_below(5 + plane, what);
    if (n.empty()) return {};
    std::vector<std::pair<double, double>> points;
    if (shape == 'R') {
      points = {{0, n[6]}, {0, 0}, {n[5], 0}, {n[5], n[6]}};
    } else {
      for (std::size_t k = 5; k < n.size(); k += 2) points.emplace_back(n[k], n[k + 1]);
    }
    const Turn azimuth = turn(n[3]), tilt = turn(n[4]);
    std::vector<Vec3> corners;
    for (const auto& [u, v] : points) {
      corners.emplace_back(n[0] - u * azimuth.cosine - v * tilt.cosine * azimuth.sine,
                           n[1] + u * azimuth.sine - v * tilt.cosine * azimuth.cosine, n[2] + v * tilt.sine);
    }
    return corners;
  }

  std::vector<std::string_view> lines_;
  ReadErrors& errors_;
  std::size_t at_ = 0;  ///< lines read
  Words words_;
  Format format_ = Format::none;
  std::vector<Vec3> vertices_;
  Vs3File file_;
};

}  // namespace

Vs3File parse_vs3(std::string_view text, ReadErrors& errors) {
  return Parser(text, errors).parse();
}

}  // namespace etendue
