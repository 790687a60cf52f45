// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/surface_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "etendue/assembly/round_checks.hpp"
#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/patch_chart.hpp"

namespace etendue {

namespace {

Bounded sum_over_terms(const ComposedRow& r, const ComposedRow& s,
                       const std::function<Bounded(std::size_t, std::size_t)>& between) {
  Bounded sum;
  double size = 0;
  for (const ComposedRow::Term& a : r.terms) {
    for (const ComposedRow::Term& b : s.terms) {
      if (a.element == b.element) continue;  // flat or round, it sees nothing of itself
      const Bounded exchange = between(a.element, b.element);
      sum.value += a.sign * b.sign * exchange.value;
      sum.bound += exchange.bound;
      size += exchange.value;
    }
  }
  const auto roundings = static_cast<int>(std::min<std::size_t>(r.terms.size() * s.terms.size() + 1, 1u << 30));
  sum.bound = (sum.bound + (roundings > 2 ? gamma_bound(roundings) * size : 0)) * (1 + gamma_bound(4));
  // The truth is not negative: moving the value there, by at most its error, only brings it nearer.
  sum.value = std::max(0.0, sum.value);
  return sum;
}

/// A polygon whose elements are only the convex parts that it was divided into.
bool is_one_concave(const Object& object) {
  const auto* polygon = std::get_if<Polygon>(&object.shape);
  return polygon != nullptr && !is_convex(*polygon) && !(object.subdivision.element_size > 0);
}

std::optional<CurvedPatch> round_patch(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return *sphere;
  if (const auto* disc = std::get_if<Disc>(&shape)) return *disc;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return *cylinder;
  return std::nullopt;
}

}  // namespace

bool SurfaceModel::plain() const {
  if (!masks.empty() || rows.size() != elements()) return false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].terms.size() != 1 || rows[k].terms[0].element != k || rows[k].terms[0].sign != 1) return false;
  }
  return true;
}

double SurfaceModel::element_area(std::size_t element) const {
  const std::size_t flat = mesh.elements.size();
  return element < flat ? mesh.elements[element].polygon.area() : area_of(rounds[element - flat].shape);
}

std::vector<double> areas_of(const SurfaceModel& model) {
  std::vector<double> areas;
  areas.reserve(model.elements());
  for (std::size_t k = 0; k < model.elements(); ++k) areas.push_back(model.element_area(k));
  return areas;
}

Result<SurfaceModel> surface_model(const Scene& scene) {
  auto mesh = mesh_elements(scene, CurvedObjects::left_out);
  if (!mesh) return mesh.error();
  SurfaceModel model;
  model.name = scene.name;
  model.mesh = std::move(mesh).value();
  model.metres_per_unit = scene.metres_per_unit;
  std::vector<std::size_t> of_object(scene.objects.size(), 0), counted(scene.objects.size(), 0);
  for (const Face& face : model.mesh.faces) model.face_names.push_back(scene.objects[face.object].name);
  for (const Element& element : model.mesh.elements) ++of_object[model.mesh.face_of(element).object];
  std::size_t next = 0;  // elements follow their objects
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    const std::string& name = scene.objects[object].name;
    if (is_one_concave(scene.objects[object])) {
      ComposedRow row{name, {}, std::get<Polygon>(scene.objects[object].shape).area(), 1};
      for (; of_object[object] > row.terms.size(); ++next) row.terms.push_back({next, 1});
      model.rows.push_back(std::move(row));
      continue;
    }
    for (; next < model.mesh.elements.size() && model.mesh.face_of(model.mesh.elements[next]).object == object;
         ++next) {
      const std::string number = of_object[object] > 1 ? "[" + std::to_string(++counted[object]) + "]" : "";
      model.rows.push_back({name + number, {{next, 1}}, model.mesh.elements[next].polygon.area(), 1});
    }
    if (const auto patch = round_patch(scene.objects[object].shape)) {
      const std::size_t element = model.mesh.elements.size() + model.rounds.size();
      model.rows.push_back({name, {{element, 1}}, area_of(*patch), 1});
      model.rounds.push_back({*patch, name, object});
    }
  }
  if (model.rows.empty()) return Error{ErrorCode::invalid_input, "the scene has no surface"};
  if (const auto apart = check_rounds(scene, model); !apart) return apart.error();
  note_open_cylinders(model);
  return model;
}

double share_of_parts(const SurfaceModel& model) {
  double least = 1;
  for (const ComposedRow& row : model.rows) {
    double terms = 0;
    for (const ComposedRow::Term& term : row.terms) terms += model.element_area(term.element);
    if (row.terms.size() > 1) least = std::min(least, row.area / terms);
  }
  // A base of which next to nothing is left would cost more than anything: its bound then says what it did not reach.
  constexpr double kLeast = 0.1;
  least = std::max(least, kLeast);
  return least * least;
}

Bounded row_exchange(const SurfaceModel& model, std::size_t r, std::size_t s,
                     const std::function<Bounded(std::size_t, std::size_t)>& between) {
  for (const Mask& mask : model.masks) {
    if (mask.row == r || mask.row == s) {
      const bool its_base = mask.base == (mask.row == r ? s : r);
      return {its_base ? model.rows[mask.row].area : 0, 0};
    }
  }
  return sum_over_terms(model.rows[r], model.rows[s], between);
}

ExchangeMatrix composed(const SurfaceModel& model, const ExchangeMatrix& elements) {
  require(elements.complete() && elements.size() == model.elements(), "composed: all elements' pairs are there");
  std::vector<double> areas;
  for (const ComposedRow& row : model.rows) areas.push_back(row.area);
  ExchangeMatrix matrix(std::move(areas));
  const auto between = [&elements](std::size_t a, std::size_t b) {
    return Bounded{elements.exchange(a, b), elements.exchange_bound(a, b)};
  };
  for (std::size_t r = 0; r < model.rows.size(); ++r) {
    for (std::size_t s = r; s < model.rows.size(); ++s) matrix.set(r, s, row_exchange(model, r, s, between));
  }
  const TileReport report = elements.report();
  for (std::size_t tile = 0; tile < matrix.layout().tiles(); ++tile)
    matrix.close(tile, tile == 0 ? report : TileReport{});
  return matrix;
}

}  // namespace etendue
