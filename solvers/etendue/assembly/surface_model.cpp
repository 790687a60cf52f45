// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/surface_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

Bounded sum_over_terms(const ComposedRow& r, const ComposedRow& s,
                       const std::function<Bounded(std::size_t, std::size_t)>& between) {
  Bounded sum;
  double size = 0;
  for (const ComposedRow::Term& a : r.terms) {
    for (const ComposedRow::Term& b : s.terms) {
      if (a.element == b.element) continue;  // flat: sees nothing of itself
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

/// What to call a shape that no method takes; nothing for the others.
std::string unsuitable(const Shape& shape) {
  if (std::holds_alternative<Sphere>(shape)) return "sphere";
  if (std::holds_alternative<Cylinder>(shape)) return "cylinder";
  if (std::holds_alternative<Disc>(shape)) return "disc";
  return std::holds_alternative<Plane>(shape) ? "infinite plane" : "";
}

}  // namespace

bool SurfaceModel::plain() const {
  if (!masks.empty() || rows.size() != mesh.elements.size()) return false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].terms.size() != 1 || rows[k].terms[0].element != k || rows[k].terms[0].sign != 1) return false;
  }
  return true;
}

Result<SurfaceModel> surface_model(const Scene& scene) {
  std::string refused;
  for (const Object& object : scene.objects) {
    const std::string kind = unsuitable(object.shape);
    if (!kind.empty()) refused += (refused.empty() ? "" : ", ") + kind + " '" + object.name + "'";
  }
  if (!refused.empty()) {
    return Error{
        ErrorCode::invalid_input,
        "found " + refused + ", expected surfaces that are flat and bounded; approximate curved ones by meshes"};
  }
  auto mesh = mesh_elements(scene);
  if (!mesh) return mesh.error();
  SurfaceModel model;
  model.name = scene.name;
  model.mesh = std::move(mesh).value();
  model.metres_per_unit = scene.metres_per_unit;
  std::vector<std::size_t> of_object(scene.objects.size(), 0), counted(scene.objects.size(), 0);
  for (const Face& face : model.mesh.faces) model.face_names.push_back(scene.objects[face.object].name);
  for (const Element& element : model.mesh.elements) ++of_object[model.mesh.face_of(element).object];
  for (std::size_t k = 0; k < model.mesh.elements.size(); ++k) {
    const std::size_t object = model.mesh.face_of(model.mesh.elements[k]).object;
    std::string name = scene.objects[object].name;
    if (of_object[object] > 1) name += "[" + std::to_string(++counted[object]) + "]";
    model.rows.push_back({std::move(name), {{k, 1}}, model.mesh.elements[k].polygon.area(), 1});
  }
  return model;
}

double share_of_parts(const SurfaceModel& model) {
  double least = 1;
  for (const ComposedRow& row : model.rows) {
    double terms = 0;
    for (const ComposedRow::Term& term : row.terms) terms += model.mesh.elements[term.element].polygon.area();
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
  require(elements.complete() && elements.size() == model.mesh.elements.size(),
          "composed: all elements' pairs are there");
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
