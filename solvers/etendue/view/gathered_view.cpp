// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/gathered_view.hpp"

#include <algorithm>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/gather/final_gather.hpp"
#include "etendue/view/first_hits.hpp"

namespace etendue {

namespace {

/// Pixels between two looks at whether to stop: gathering one may take milliseconds.
constexpr int kPixelsAtOnce = 32;

/// The first and each further share of the way to the centroid by which a point is moved off other surfaces: below what any
/// picture shows, and soon beyond the slack.
constexpr double kFirstMove = 0x1p-40, kFurther = 16;

/// What a pixel shows of one face.
struct Part {
  std::size_t face;
  std::vector<FirstHits::Shown> hits;

  const FirstHits::Shown& middle() const {
    Vec3 mean = Vec3::Zero();
    for (const auto& hit : hits) mean += hit.point / static_cast<double>(hits.size());
    return *std::min_element(hits.begin(), hits.end(), [&](const auto& one, const auto& other) {
      return (one.point - mean).squaredNorm() < (other.point - mean).squaredNorm();
    });
  }
};

class Pixels {
 public:
  Pixels(const Scene& scene, const ElementMesh& mesh, const RadiosityField& field, const FirstHits& hits)
      : scene_(scene), mesh_(mesh), field_(field), hits_(hits), gather_(mesh) {}

  Rgb value(int column, int row, const Rgb& background, int samples) const {
    std::vector<Part> parts;
    int missed = 0;
    for (int sample = 0; sample < samples * samples; ++sample) {
      const double across = (sample % samples + 0.5) / samples, down = (sample / samples + 0.5) / samples;
      const auto shown = hits_.at(column, row, across, down);
      if (!shown) {
        ++missed;
        continue;
      }
      const std::size_t face = mesh_.elements[shown->element].face;
      auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& one) { return one.face == face; });
      if (part == parts.end()) part = parts.insert(part, Part{face, {}});
      part->hits.push_back(*shown);
    }
    Rgb sum = missed * background;
    for (const Part& part : parts) sum += static_cast<double>(part.hits.size()) * radiosity(part.middle());
    return sum / (samples * samples);
  }

 private:
  Rgb radiosity(const FirstHits::Shown& shown) const {
    const Element& element = mesh_.elements[shown.element];
    const Face& face = mesh_.faces[element.face];
    const Material& material = scene_.materials[face.material];
    const Vec3 &normal = face.polygon.normal(), &centroid = element.polygon.centroid();
    // A hit from afar is off by the rounding of that distance.
    const Vec3 point = shown.point - normal.dot(shown.point - centroid) * normal;
    if (!gather_.obstacle(point, normal)) return gathered(material, point, normal);
    for (double share = kFirstMove; share < 1; share *= kFurther) {
      const Vec3 moved = point + share * (centroid - point);
      if (!gather_.obstacle(moved, normal)) return gathered(material, moved, normal);
    }
    return field_.value[shown.element];  // covered everywhere: as it was solved
  }

  Rgb gathered(const Material& material, const Vec3& point, const Vec3& normal) const {
    return material.emission + material.rho * gather_.irradiance(point, normal, field_).irradiance;
  }

  const Scene& scene_;
  const ElementMesh& mesh_;
  const RadiosityField& field_;
  const FirstHits& hits_;
  FinalGather gather_;
};

}  // namespace

Result<Image> gather_radiosities(const Camera& camera, const Scene& scene, const ElementMesh& mesh,
                                 const RadiosityField& field, const Rgb& background, int samples,
                                 const Execution& execution) {
  require(samples >= 1, "gather_radiosities: at least one sample a pixel");
  require(field.value.size() == mesh.elements.size(), "gather_radiosities: the field is of this mesh");
  const auto hits = FirstHits::make(camera, mesh);
  if (!hits) return hits.error();
  const Pixels pixels(scene, mesh, field, *hits);
  Image picture(camera.columns, camera.rows);
  const int pieces = (camera.columns + kPixelsAtOnce - 1) / kPixelsAtOnce;
  const auto gather_piece = [&](std::size_t index) {
    const int row = static_cast<int>(index) / pieces, first = static_cast<int>(index) % pieces * kPixelsAtOnce;
    for (int column = first; column < std::min(first + kPixelsAtOnce, camera.columns); ++column) {
      picture.at(column, row) = pixels.value(column, row, background, samples);
    }
  };
  const auto count = static_cast<std::size_t>(camera.rows) * static_cast<std::size_t>(pieces);
  if (!parallel_for(count, execution, gather_piece)) return Error{ErrorCode::stopped, "the picture was stopped"};
  return picture;
}

}  // namespace etendue
