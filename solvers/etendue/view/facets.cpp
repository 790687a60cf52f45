// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/facets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

/// Flat and Gouraud's shading and that of dot products compute light at corners, and infinite planes have none.
Error no_corners(const Object& plane) {
  return {ErrorCode::invalid_input,
          (plane.place.empty() ? "" : plane.place + ": ") + "object '" + printable(plane.name) +
              "' is an infinite plane, which has no corners to be shaded at: use --shading phong " +
              "or --method raytrace"};
}

}  // namespace

Result<std::vector<Facet>> facets_of(const Scene& scene, const ShadingOptions& options) {
  std::vector<Facet> facets;
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    const auto* plane = std::get_if<Plane>(&scene.objects[object].shape);
    if (plane && options.shading != Shading::phong) return no_corners(scene.objects[object]);
    const Result<Tessellation> net =
        plane ? plane_before(*plane, scene.camera.eye) : tessellated(scene.objects[object], options.net);
    if (!net) return net.error();
    const Mesh& mesh = net->mesh;
    const auto normals = facet_normals(mesh);
    const auto at_corners = corner_normals(mesh, options.weight, net->crease_angle);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (normals[t].isZero(0)) continue;  // without area: nothing is seen of it
      const auto& ends = mesh.triangles[t];
      Facet facet{object,        {mesh.vertices[ends[0]], mesh.vertices[ends[1]], mesh.vertices[ends[2]]},
                  at_corners[t], normals[t],
                  false,         net->parameters[t]};
      if (facet.normal.dot(scene.camera.eye - facet.corners[0]) < 0) {
        facet.turned = true;
        facet.normal = -facet.normal;
        for (Vec3& normal : facet.normals) normal = -normal;
      }
      facets.push_back(facet);
    }
  }
  return facets;
}

double length_to_see(const Scene& scene, const std::vector<Facet>& facets) {
  Eigen::AlignedBox3d box;
  double height = std::numeric_limits<double>::infinity();
  for (const Facet& facet : facets) {
    if (const auto* plane = std::get_if<Plane>(&scene.objects[facet.object].shape)) {
      height = std::min(height, std::abs(plane->normal.dot(scene.camera.eye - plane->point)));
    } else {
      for (const Vec3& corner : facet.corners) box.extend(corner);
    }
  }
  return std::min(box.isEmpty() ? 1 : box.diagonal().norm(), height);
}

}  // namespace etendue
