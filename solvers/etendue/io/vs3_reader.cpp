// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/vs3_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/surface_builder.hpp"
#include "etendue/io/vs3_records.hpp"
#include "etendue/text/fingerprint.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

using Kind = Vs3Surface::Kind;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

Polygon reversed(const Polygon& polygon) {
  return Polygon::make({polygon.vertices().rbegin(), polygon.vertices().rend()}).value();
}

class Assembler {
 public:
  Assembler(const Vs3File& file, SurfaceModel& model, ReadErrors& errors)
      : file_(file), model_(model), errors_(errors), builder_(model, errors), placed_(file.surfaces.size()) {}

  void run() {
    // Obstructions come last in the file, but a surface may lie on one.
    for (std::size_t k = 0; k < placed_.size(); ++k) make_polygon(k);
    for (std::size_t k = 0; k < placed_.size(); ++k) check_relations(k);
    if (errors_.count() > 0) return;
    for (std::size_t k = 0; k < placed_.size(); ++k) place(k);
    for (std::size_t k = 0; k < placed_.size(); ++k) siblings(k);
    builder_.finish();
    for (std::size_t k = 0; k < placed_.size(); ++k) add_row(k);
    for (std::size_t k = 0; k < placed_.size(); ++k) combine(k);
    mask();
    for (const ComposedRow& row : model_.rows) {
      if (!(row.area > 0)) errors_.add(0, "surface '" + row.name + "': its subsurfaces leave nothing of it");
    }
  }

 private:
  struct Placed {
    std::optional<Polygon> polygon;
    std::size_t face = kNone, element = kNone, row = kNone;
  };

  const Vs3Surface& at(std::size_t k) const { return file_.surfaces[k]; }
  std::size_t index(long number) const { return static_cast<std::size_t>(number) - 1; }
  bool covers(std::size_t k) const { return at(k).kind == Kind::mask || at(k).kind == Kind::null; }

  void make_polygon(std::size_t k) {
    if (at(k).corners.empty()) return;
    auto made = builder_.polygon(at(k).corners, at(k).line, at(k).called());
    if (!made) return;
    if (is_convex(*made)) {
      placed_[k].polygon = std::move(*made);
    } else {
      errors_.add(at(k).line, at(k).called() + ": is concave, expected a convex quadrilateral; divide it and combine");
    }
  }

  void check_relations(std::size_t k) {
    const Vs3Surface& s = at(k);
    const auto complain = [&](const std::string& what) { errors_.add(s.line, s.called() + ": " + what); };
    const long count = static_cast<long>(file_.surfaces.size());
    if (s.combined != 0) {
      if (s.combined >= s.number) {
        complain("found cmb " + std::to_string(s.combined) + ", expected a lower number than its own");
      } else if (at(index(s.combined)).combined != 0 || at(index(s.combined)).kind != Kind::surface) {
        complain("found cmb " + std::to_string(s.combined) + ", expected a surface S that is not itself combined");
      }
      if (s.kind != Kind::surface) complain("found cmb " + std::to_string(s.combined) + " on a mask, expected 0");
    }
    if (s.base == 0) {
      if (covers(k)) complain("found no base, expected the surface that it covers");
      return;
    }
    if (s.base > count) return complain("found base " + std::to_string(s.base) + ", expected a surface of this file");
    const Vs3Surface& base = at(index(s.base));
    if (s.base >= s.number && base.kind != Kind::obstruction) {
      return complain("found base " + std::to_string(s.base) + ", expected a lower number than its own");
    }
    if (covers(index(s.base))) return complain("found base " + base.called() + ", expected no mask or null surface");
    if (covers(k) && base.kind == Kind::obstruction)
      return complain("found an obstruction as base, expected a surface S");
    if (placed_[k].polygon && placed_[index(s.base)].polygon) lies_in(k, complain);
  }

  /// Facing as its base does, if it has one.
  Polygon as_base(std::size_t k) const {
    const Polygon& own = *placed_[k].polygon;
    if (at(k).base == 0) return own;
    return own.normal().dot(placed_[index(at(k).base)].polygon->normal()) > 0 ? own : reversed(own);
  }

  template <class Complain>
  void lies_in(std::size_t k, const Complain& complain) {
    const Vs3Surface& base = at(index(at(k).base));
    const Polygon& outer = *placed_[index(at(k).base)].polygon;
    const double size = (outer.vertices()[2] - outer.vertices()[0]).norm();
    double off = 0;
    for (const Vec3& v : placed_[k].polygon->vertices()) {
      off = std::max(off, std::abs(outer.normal().dot(v - outer.centroid())));
    }
    if (off > kFlatEnough * size) {
      return complain("is " + rounded(off, 3) + " off the plane of its base " + base.called() + ", expected in it");
    }
    // A null surface is taken away, whichever way it faces.
    const bool same_way = placed_[k].polygon->normal().dot(outer.normal()) > 0;
    if (same_way == covers(k) && at(k).kind != Kind::null) {
      complain(covers(k) ? "faces away from its base " + base.called() + ", expected towards it"
                         : "faces its base " + base.called() + ", expected the same way");
      return;
    }
    const Polygon inner = as_base(k);
    const Overlap how = overlap(outer, inner, off);
    if (how != Overlap::second_inside && how != Overlap::same) {
      complain("reaches beyond its base " + base.called() + ", expected inside");
    }
  }

  /// Elements and faces; bases come before what lies in them, obstructions as needed.
  void place(std::size_t k) {
    if (placed_[k].face != kNone) return;
    const Vs3Surface& s = at(k);
    if (s.base != 0) {
      place(index(s.base));
      placed_[k].face = placed_[index(s.base)].face;
    } else {
      placed_[k].face = builder_.face(*placed_[k].polygon, s.line, s.name);
    }
    if (s.kind == Kind::obstruction) return;
    placed_[k].element = builder_.element(as_base(k), placed_[k].face);
  }

  void siblings(std::size_t k) {
    for (std::size_t m = k + 1; m < placed_.size(); ++m) {
      if (at(k).base == 0 || at(k).base != at(m).base) continue;
      const Polygon& first = model_.mesh.elements[placed_[k].element].polygon;
      const Polygon& second = model_.mesh.elements[placed_[m].element].polygon;
      const Overlap how = overlap(first, second, kFlatEnough * std::sqrt(first.area()));
      if (how != Overlap::none) errors_.add(at(m).line, at(m).called() + " " + described(how) + " " + at(k).called());
    }
  }

  void add_row(std::size_t k) {
    const Vs3Surface& s = at(k);
    if (s.kind == Kind::obstruction || s.kind == Kind::null) return;
    ComposedRow row{s.name, {{placed_[k].element, 1}}, placed_[k].polygon->area(), s.emittance};
    for (std::size_t m = 0; m < placed_.size(); ++m) {
      if (at(m).base != s.number) continue;
      row.terms.push_back({placed_[m].element, -1});
      if (at(m).kind != Kind::mask) row.area -= placed_[m].polygon->area();
    }
    if (s.combined != 0) {
      combined_.emplace_back(k, std::move(row));
      return;
    }
    placed_[k].row = model_.rows.size();
    model_.rows.push_back(std::move(row));
  }

  void combine(std::size_t k) {
    for (auto& [surface, part] : combined_) {
      if (surface != k) continue;
      placed_[k].row = placed_[index(at(k).combined)].row;
      ComposedRow& row = model_.rows[placed_[k].row];
      row.terms.insert(row.terms.end(), part.terms.begin(), part.terms.end());
      row.emittance = (row.emittance * row.area + part.emittance * part.area) / (row.area + part.area);
      row.area += part.area;
    }
  }

  void mask() {
    for (std::size_t k = 0; k < placed_.size(); ++k) {
      if (at(k).kind == Kind::mask) model_.masks.push_back({placed_[k].row, placed_[index(at(k).base)].row});
    }
  }

  const Vs3File& file_;
  SurfaceModel& model_;
  ReadErrors& errors_;
  SurfaceBuilder builder_;
  std::vector<Placed> placed_;
  std::vector<std::pair<std::size_t, ComposedRow>> combined_;
};

}  // namespace

Result<SurfaceModel> read_vs3(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  ReadErrors errors(path.string());
  const Vs3File file = parse_vs3(*bytes, errors);
  SurfaceModel model;
  model.name = file.title;
  model.hash = Fingerprint().add(*bytes).hex();
  if (file.enclosure) {
    model.notes.emplace_back("the file asks for rows that sum to one (encl=1): not done, factors are as computed");
  }
  if (file.emittances) {
    model.notes.emplace_back("the file asks for reflections in the factors (emit=1): not done, factors are geometric");
  }
  Assembler(file, model, errors).run();
  if (errors.count() == 0 && model.rows.empty()) errors.add(0, "found obstructions only, expected a surface S");
  if (errors.count() > 0) return errors.error();
  return model;
}

}  // namespace etendue
