// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "etendue/geometry/bezier.hpp"
#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cone.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/mesh.hpp"
#include "etendue/geometry/plane.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/polygon_with_holes.hpp"
#include "etendue/geometry/quadric.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/torus.hpp"
#include "etendue/geometry/triangle.hpp"
#include "etendue/optics/dispersion.hpp"
#include "etendue/optics/spectrum.hpp"
#include "etendue/reflectance/attenuation.hpp"
#include "etendue/reflectance/cube_map.hpp"
#include "etendue/reflectance/highlight.hpp"
#include "etendue/reflectance/pattern.hpp"
#include "etendue/reflectance/transparency.hpp"
#include "etendue/scene/material_bump.hpp"
#include "etendue/scene/material_texture.hpp"

namespace etendue {

/// One value a colour channel: red, green, blue (linear, not display-encoded).
using Rgb = Eigen::Array3d;

/// The viewing system of IU.5.2, as read: directions need not be unit vectors, `up` need not be orthogonal to `gaze`.
struct Camera {
  Vec3 eye = Vec3::Zero();
  Vec3 gaze = Vec3::UnitY(), up = Vec3::UnitZ();
  double horizontal_half_angle = 0.5;  ///< θ [rad], in (0, π/2); the vertical one follows from square pixels
  int columns = 256, rows = 256;
  double lens_radius = 0;     ///< of a thin lens at the eye [length]; 0: a pinhole, everything is sharp
  double focal_distance = 1;  ///< along the gaze, of the plane that is sharp [length]
  double shutter = 0;         ///< how long the picture is exposed, from time 0 on [time]
};

/// A second colour of a surface, and where it shows.                                                @eq IU.4-1
struct MaterialPattern {
  Pattern pattern;
  Rgb k_d = Rgb::Zero(), k_a = Rgb::Zero();  ///< where the pattern shows its second colour
};

/// Everything either solver wants to know of a surface. Coefficients are fractions in [0, 1].
struct Material {
  std::string name;
  Rgb k_d = Rgb::Zero();      ///< diffuse reflection, per channel
  Rgb k_a = Rgb::Zero();      ///< reflection of the ambient light; the reader sets it to k_d unless it is given
  double k_s = 0;             ///< local specular reflection (Phong), not coloured
  double phong_exponent = 1;  ///< n
  std::optional<Highlight> highlight = std::nullopt;  ///< in place of Phong's; k_s weighs it
  double k_r = 0, k_t = 0;                            ///< global specular reflection and transmission
  double eta = 1;                ///< refractive index of the inside; where there is dispersion, that for yellow (n_d)
  bool fresnel = false;          ///< k_r + k_t is divided by Fresnel's factor, whatever each of them is
  Rgb absorption = Rgb::Zero();  ///< σ of the inside, per channel [1/length]
  std::optional<Dispersion> dispersion;  ///< the index for each wavelength
  double frost = 0;  ///< 1 − mean cosine of the angle by which a transmitted ray strays, in [0, ½]; 0: clear glass
  int priority = 0;  ///< where bodies overlap, the one of the highest counts; of equal ones that entered last
  Rgb rho = Rgb::Zero();       ///< diffuse reflectance for radiosity, each < 1; the reader sets it to k_d unless given
  Rgb emission = Rgb::Zero();  ///< E: radiant exitance of the emitter [W/m²]
  std::optional<MaterialPattern> pattern;                 ///< for rays; radiosity takes rho
  std::optional<MaterialTexture> texture = std::nullopt;  ///< likewise; a material has one of them at most
  std::optional<MaterialBump> bump;                       ///< for rays, and for rasterised pictures by Phong's shading
  std::optional<TransparencyLaw> see_through;             ///< for rasterised pictures; rays refract, by k_t and eta
  std::shared_ptr<const CubeMap> environment;             ///< what is mirrored, in place of the scene; null: the scene
  std::optional<Spectrum> reflectance;  ///< for rays of one wavelength; k_d and k_a are its colour by daylight
};

/// Local lights of ray tracing. Lights of radiosity are surfaces with emission.
struct PointLight {
  Vec3 position;
  Rgb intensity;
  Falloff falloff = {};
};
struct DirectionalLight {
  Vec3 direction;  ///< unit vector from the scene towards the light
  Rgb intensity;
};
/// Lights with an area, as N × N point lights that share the intensity, one in each of N × N equal parts.   @eq IU.2.1
struct RectangleLight {
  Vec3 corner, u, v;  ///< the rectangle corner + [0, 1] u + [0, 1] v
  Rgb intensity;
  int samples = 4;  ///< N
};
struct SphereLight {
  Vec3 centre;
  double radius;
  Rgb intensity;
  int samples = 4;  ///< N
};
using Light = std::variant<PointLight, DirectionalLight, RectangleLight, SphereLight>;

using Shape = std::variant<Sphere, Polygon, Triangle, Plane, Disc, Cylinder, Box, Mesh, Cone, Torus, Quadric,
                           BezierSurface, PolygonWithHoles>;

/// How a shape is divided for radiosity. A quadrilateral has elements[0] × elements[1] elements along its first and its
/// second edge, of which patches[0] × patches[1] patches are groups; patches divide elements.
struct Subdivision {
  int elements[2] = {1, 1}, patches[2] = {1, 1};
  double element_size = 0;  ///< where above 0: no side of an element is longer [length], whatever `elements` says
  double grading = 0;       ///< in [0, 1]: how much denser the elements lie towards the edges (division_line())
};

/// A shape in world coordinates (transforms are applied by the reader) and what it is made of.
struct Object {
  std::string name;
  Shape shape;
  std::size_t material = 0;  ///< index into Scene::materials
  Subdivision subdivision;
  std::string place = {};  ///< "scene.json:29:5: /objects/1", for messages; empty where it was not read from a file
  Vec3 velocity = Vec3::Zero();  ///< of the shape, which is where it says at time 0 [length/time]; for rays
  OwnCoordinates own = {};       ///< before its transforms and those of its groups, and where it is at time 0
};

/// Where a point that the object carries along at `time` is at time 0.
[[nodiscard]] inline Vec3 at_rest(const Object& object, const Vec3& point, double time) {
  return point - time * object.velocity;
}

struct Scene {
  std::string name;
  double metres_per_unit = 1;
  Camera camera;
  std::vector<Material> materials;
  std::vector<Light> lights;
  Rgb ambient = Rgb::Zero();     ///< I_a
  Rgb background = Rgb::Zero();  ///< what a ray that leaves the scene sees
  std::vector<Object> objects;
  std::optional<Illuminant> illuminant;  ///< spectrum of all light, for `render`; none: of equal energy, and white
  bool align_mesh = false;               ///< elements are cut where other objects stand on their faces
  Rgb white() const { return illuminant ? illuminant->white : Rgb::Ones(); }  ///< as its light is seen
};

/// Whether the picture sees it move.
[[nodiscard]] inline bool moves(const Scene& scene, const Object& object) {
  return scene.camera.shutter > 0 && object.velocity != Vec3::Zero();
}

}  // namespace etendue
