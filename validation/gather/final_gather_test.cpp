// SPDX-License-Identifier: Apache-2.0
#include "etendue/gather/final_gather.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/gather/sensors.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/element_rectangle.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Mat3 turn() {
  Mat3 columns;
  for (int axis = 0; axis < 3; ++axis) columns.col(axis) = tilted(Vec3::Unit(axis)) - tilted(Vec3::Zero());
  return columns;
}

void add(Scene& scene, const char* name, Shape shape, int columns, int rows) {
  scene.objects.push_back({name, std::move(shape), 0, {}});
  scene.objects.back().subdivision.elements[0] = columns;
  scene.objects.back().subdivision.elements[1] = rows;
}

/// A room of 3 × 2 × 2.5 in a tilted frame, with a box that stands on the floor, another in the air and, where it is
/// asked for, a thin plate that touches a wall.
Scene furnished_room(bool plate) {
  Scene scene;
  scene.materials.emplace_back();
  const Vec3 x(3, 0, 0), y(0, 2, 0), z(0, 0, 2.5), o(0, 0, 0);
  add(scene, "floor", tilted(rectangle(o, x, y)), 5, 4);
  add(scene, "ceiling", tilted(rectangle(z, y, x)), 3, 3);
  add(scene, "south", tilted(rectangle(o, z, x)), 4, 3);
  add(scene, "north", tilted(rectangle(y, x, z)), 3, 3);
  add(scene, "west", tilted(rectangle(o, y, z)), 2, 3);
  add(scene, "east", tilted(rectangle(x, z, y)), 3, 2);
  add(scene, "standing", Box{tilted(Vec3(1, 0.75, 0.5)), turn(), Vec3(0.4, 0.25, 0.5)}, 2, 2);
  // Askew, so that its planes pass the other box, and the other's pass it.
  const Mat3 askew = turn() * Eigen::AngleAxisd(std::numbers::pi / 6, Vec3::UnitZ()).toRotationMatrix();
  add(scene, "floating", Box{tilted(Vec3(1.75, 1.15, 0.9)), askew, Vec3(0.3, 0.2, 0.15)}, 1, 2);
  if (plate) {
    const Vec3 corner(2.4, 0, 0.3), along(0.2, 0.9, 0), up(0, 0, 0.8);
    add(scene, "plate", tilted(rectangle(corner, along, up)), 2, 2);
    add(scene, "its back", tilted(rectangle(corner, up, along)), 1, 1);
  }
  return scene;
}

/// Sensors all over the room's air, facing anywhere, then on its surfaces.
std::vector<Sensor> sensors_in(const Scene& scene, const ElementMesh& mesh, std::uint64_t seed, int count) {
  CounterRandom random(seed);
  std::vector<Sensor> sensors;
  for (int k = 0; k < count; ++k) {
    const double u = random.unit(), v = random.unit(), w = random.unit(), height = random.between(-1, 1);
    const double angle = random.between(0, 2 * std::numbers::pi), side = std::sqrt(1 - height * height);
    sensors.push_back({"air", tilted(Vec3(3 * u, 2 * v, 2.5 * w)),
                       Vec3(side * std::cos(angle), side * std::sin(angle), height).normalized()});
  }
  for (const Face& face : mesh.faces) {
    // The underside of the box that stands on the floor is no place for a sensor.
    const Vec3 down = tilted(-Vec3::UnitZ()) - tilted(Vec3::Zero());
    if (scene.objects[face.object].name == "standing" && face.polygon.normal().dot(down) > 0.5) continue;
    const std::vector<Vec3>& c = face.polygon.vertices();
    const double u = random.between(0.01, 0.99), v = random.between(0.01, 0.99);
    sensors.push_back(
        {scene.objects[face.object].name, c[0] + u * (c[1] - c[0]) + v * (c[3] - c[0]), face.polygon.normal()});
  }
  return sensors;
}

// CLAIM      IU.6-4, IU.6-6: in a closed room a point sees it wholly: its factors to all elements past boxes and a plate sum
//            to one; on a surface too. Where there is no such point (inside of a box) it is refused.
// ORACLE     identity: Σ F = 1.
// TOLERANCE  the sum of the returned bounds, and the rounding of the sum.
TEST(FinalGather, SeesTheWholeRoomFromEverywhere) {
  proves({"IU.6-2", "IU.6-4", "IU.6-6"}, Oracle::identity, "row sums of points in a furnished room");
  uses_seed(41);
  for (const bool plate : {false, true}) {
    const Scene scene = furnished_room(plate);
    const ElementMesh mesh = mesh_elements(scene).value();
    const FinalGather gather(mesh);
    int within_boxes = 0;
    for (const Sensor& sensor : sensors_in(scene, mesh, 41, 600)) {
      if (const auto obstacle = gather.obstacle(sensor.position, sensor.normal)) {
        // The floor under the box is the only place on a surface that may be hit by it.
        EXPECT_TRUE(obstacle->kind == FinalGather::Obstacle::Kind::inside || sensor.name != "air");
        ++within_boxes;
        continue;
      }
      double sum = 0, bound = 0;
      const auto factors = gather.factors(sensor.position, sensor.normal);
      for (const ElementFactor& one : factors) {
        sum += one.factor.value;
        bound += one.factor.bound;
      }
      EXPECT_TRUE(near(sum, 1, bound + static_cast<double>(factors.size()) * kUnitRoundoff)) << sensor.name;
    }
    EXPECT_TRUE(holds(within_boxes > 0 && within_boxes < 120)) << within_boxes;
  }
}

// CLAIM      IU.6-4: factors past shadow cones that were formed once for a point are those of blockers taken off face by face.
// ORACLE     another method: visible_point_to_polygon() past plates, each face of every object.
// TOLERANCE  the sum of both bounds.
TEST(FinalGather, AgreesWithPlatesTakenOneByOne) {
  proves({"IU.6-4"}, Oracle::program, "visible_point_to_polygon past every face");
  uses_seed(42);
  const Scene scene = furnished_room(true);
  const ElementMesh mesh = mesh_elements(scene).value();
  const FinalGather gather(mesh);
  for (const Sensor& sensor : sensors_in(scene, mesh, 42, 30)) {
    if (gather.obstacle(sensor.position, sensor.normal)) continue;
    std::vector<Bounded> ours(mesh.elements.size());
    for (const ElementFactor& one : gather.factors(sensor.position, sensor.normal)) ours[one.element] = one.factor;
    for (std::size_t k = 0; k < mesh.elements.size(); k += 3) {
      std::vector<Polygon> plates;
      for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (f != mesh.elements[k].face) plates.push_back(mesh.faces[f].polygon);
      }
      const Bounded theirs = visible_point_to_polygon(sensor.position, sensor.normal, mesh.elements[k].polygon, plates);
      EXPECT_TRUE(near(ours[k].value, theirs.value, ours[k].bound + theirs.bound)) << sensor.name << " " << k;
    }
  }
}

// CLAIM      IU.6-2: the irradiance under the corner of a radiating rectangle is F B, to the returned bound; a field of slopes
//            changes it by what the slope does, not by how it is divided: a field and its negative slope average out.
// ORACLE     closed form: element to parallel rectangle (B-4) in 600-bit balls; the mean of two fields.
// TOLERANCE  the returned bounds.
TEST(FinalGather, GathersARectangleAsTheClosedFormDoes) {
  proves({"IU.6-2", "IU.6-10"}, Oracle::closed_form, "B-4 at 600 bits, sides from 0.05 to 20");
  for (const double a : {0.05, 0.5, 1.0, 20.0}) {
    for (const double b : {0.1, 3.0}) {
      Scene scene;
      scene.materials.emplace_back();
      // Corner on the normal, front downwards.
      add(scene, "light", tilted(rectangle({0, 0, 1}, {0, b, 0}, {a, 0, 0})), 1, 1);
      const ElementMesh mesh = mesh_elements(scene).value();
      const FinalGather gather(mesh);
      const std::vector<Rgb> radiosity{Rgb(2, 1, 0.5)};
      const Vec3 point = tilted(Vec3::Zero()), normal = (tilted(Vec3::UnitZ()) - point).normalized();
      const double factor = oracle::element_to_corner_rectangle(a, b);
      const Gathered flat = gather.irradiance(point, normal, constant_field(radiosity, Rgb::Zero()));
      for (Eigen::Index c = 0; c < 3; ++c) {
        // The rotated corners are rounded as well: a few u of the distance turn them by as much.
        const double placed = 16 * kUnitRoundoff;
        EXPECT_TRUE(near(flat.irradiance(c), factor * radiosity[0](c), flat.bound(c) + placed));
      }
      RadiosityField rising = constant_field(radiosity, Rgb::Zero());
      rising.spread[0] = 1;
      RadiosityField falling = rising;
      const Vec3 slope = (tilted(Vec3(0.1, 0.05, 0)) - point) / std::max(a, b);
      for (std::size_t c = 0; c < 3; ++c) {
        rising.slope[0][c] = slope;
        falling.slope[0][c] = -slope;
      }
      const Gathered up = gather.irradiance(point, normal, rising), down = gather.irradiance(point, normal, falling);
      EXPECT_TRUE(within(std::abs((up.irradiance(0) + down.irradiance(0)) / 2 - flat.irradiance(0)),
                         up.bound(0) + down.bound(0) + flat.bound(0)));
      EXPECT_TRUE(holds(down.irradiance(0) > up.irradiance(0)));  // it falls away from the point's corner
    }
  }
}

/// H/π of a linear radiosity over the unit square at z = height, seen from (x, y, 0) along a unit normal: five-point Gauss rules
/// in 32 × 32 cells. Nothing of the square is below the horizon.
double gauss_irradiance(const Vec3& point, const Vec3& normal, double height, double value, const Vec3& slope) {
  const std::array<double, 5> nodes{-0.906179845938664, -0.5384693101056831, 0, 0.5384693101056831, 0.906179845938664};
  const std::array<double, 5> weights{0.23692688505618908, 0.47862867049936647, 0.5688888888888889, 0.47862867049936647,
                                      0.23692688505618908};
  constexpr std::size_t kCells = 32;
  double sum = 0;
  for (std::size_t i = 0; i < 5 * kCells; ++i) {
    for (std::size_t j = 0; j < 5 * kCells; ++j) {
      const auto at = [&](std::size_t k) { return (static_cast<double>(k / 5) + 0.5 + nodes[k % 5] / 2) / kCells; };
      const Vec3 q(at(i), at(j), height), d = q - point;
      const double radiosity = value + slope.dot(q - Vec3(0.5, 0.5, height)), square = d.squaredNorm();
      sum += weights[i % 5] * weights[j % 5] / 4 * radiosity * normal.dot(d) * height / (square * square);
    }
  }
  return sum / (std::numbers::pi * kCells * kCells);
}

// CLAIM      IU.6-2: what a linear radiosity over an element sends to a point is found to kLinearShare of what it changes by, from
//            far and near, in any direction, on either side of the element's middle.
// ORACLE     another method: Gauss rules over the element, 160 × 160 nodes, where the integrand is smooth.
// TOLERANCE  kLinearShare F |ΔB|, which the header promises; the rules, with cells of a third of the distance at most, err by less
//            than (1/6)^10.
TEST(FinalGather, GathersLinearRadiosity) {
  proves({"IU.6-2", "IU.6-10"}, Oracle::program, "160 × 160 Gauss nodes over the element");
  uses_seed(44);
  CounterRandom random(44);
  const Vec3 origin = tilted(Vec3::Zero());
  for (const double height : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    Scene scene;
    scene.materials.emplace_back();
    add(scene, "light", tilted(rectangle({0, 0, height}, {0, 1, 0}, {1, 0, 0})), 1, 1);
    const ElementMesh mesh = mesh_elements(scene).value();
    const FinalGather gather(mesh);
    for (int trial = 0; trial < 8; ++trial) {
      const double x = random.between(-0.2, 1.2), y = random.between(-0.2, 1.2);
      const double across = random.between(-0.5, 0.5), up = random.between(-0.5, 0.5);
      // Within half of the angle at which the farthest corner would set.
      const Vec3 normal = Vec3(across * height / 1.7, up * height / 1.7, 1).normalized(), point(x, y, 0);
      const double gx = random.between(-1, 1), gy = random.between(-1, 1);
      RadiosityField field = constant_field(std::vector<Rgb>{Rgb(2, 2, 2)}, Rgb::Zero());
      field.spread[0] = 1;
      field.slope[0].fill(tilted(Vec3(gx, gy, 0)) - origin);
      const Gathered found = gather.irradiance(tilted(point), (tilted(normal) - origin).normalized(), field);
      const double truth = gauss_irradiance(point, normal, height, 2, Vec3(gx, gy, 0));
      const double factor = gauss_irradiance(point, normal, height, 1, Vec3::Zero());
      EXPECT_TRUE(near(found.irradiance(0), truth, kLinearShare * factor * (std::abs(gx) + std::abs(gy))));
    }
  }
}

// CLAIM      Slopes of a linear radiosity are found exactly, whatever the grading of the mesh and the frame, and what errors in
//            radiosity do to an irradiance is within its bound.
// ORACLE     identity: radiosities that are means of a linear function; metamorphic: radiosities moved by their bound.
// TOLERANCE  slopes: 2^-36, of normal equations in distances from 1 to 8 with weights to their fourth power; irradiances: the
//            returned bound.
TEST(RadiosityField, FindsTheSlopeOfLinearRadiosity) {
  proves({"IU.6-7"}, Oracle::identity, "linear radiosity over a graded mesh");
  uses_seed(43);
  Scene scene;
  scene.materials.emplace_back();
  add(scene, "floor", tilted(rectangle({0, 0, 0}, {3, 0, 0}, {0.5, 2, 0})), 7, 5);
  scene.objects[0].subdivision.grading = 0.8;
  const ElementMesh mesh = mesh_elements(scene).value();
  const Vec3 origin = tilted(Vec3::Zero()), slope = tilted(Vec3(0.3, -0.2, 0)) - origin;
  std::vector<Rgb> radiosity;
  for (const Element& element : mesh.elements) {
    radiosity.push_back(Rgb(1, 2, 3) * (2 + slope.dot(element.polygon.centroid() - origin)));
  }
  const Rgb bound(1e-3, 2e-3, 3e-3);
  const RadiosityField field = linear_field(mesh, radiosity, {}, bound);
  for (std::size_t k = 0; k < radiosity.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_TRUE(within((field.slope[k][c] - (1.0 + static_cast<double>(c)) * slope).norm(), 0x1p-36)) << k;
    }
  }
  // Errors that tilt the radiosity: at a corner of the element they do more than at its centroid, and are bounded there.
  const std::size_t middle = 2 * 7 + 3;
  const Vec3 centroid = mesh.elements[middle].polygon.centroid();
  const Vec3 to_corner = mesh.elements[middle].polygon.vertices()[1] - centroid;
  std::vector<Rgb> tilting = radiosity;
  for (std::size_t k = 0; k < tilting.size(); ++k) {
    tilting[k] += ((mesh.elements[k].polygon.centroid() - centroid).dot(to_corner) < 0 ? -1.0 : 1.0) * bound;
  }
  const Rgb change = (linear_field(mesh, tilting, {}, bound).at(middle, to_corner) - field.at(middle, to_corner)).abs();
  EXPECT_TRUE(within(change(0), field.bound_at(middle, to_corner)(0)));
  EXPECT_TRUE(holds(change(0) > bound(0)));
  const FinalGather gather(mesh);
  CounterRandom random(43);
  std::vector<Rgb> moved = radiosity;
  for (Rgb& one : moved) one += (random.unit() < 0.5 ? -1.0 : 1.0) * bound;
  const RadiosityField other = linear_field(mesh, moved, {}, bound);
  for (const Vec3& place : {Vec3(1, 1, 0.02), Vec3(2.6, 0.4, 0.5), Vec3(0.3, 0.1, 1)}) {
    const Vec3 point = tilted(place), normal = (tilted(Vec3(0, 0.6, -0.8)) - origin).normalized();
    const Gathered one = gather.irradiance(point, normal, field), two = gather.irradiance(point, normal, other);
    for (Eigen::Index c = 0; c < 3; ++c) {
      EXPECT_TRUE(within(std::abs(one.irradiance(c) - two.irradiance(c)), one.bound(c)));
      EXPECT_TRUE(holds(one.bound(c) > 0.1 * bound(c)));  // it is the solution's bound, not rounding's
    }
  }
}

// CLAIM      A sensor where nothing can be measured is refused, and the message says why: inside of an object, on a surface but
//            askew, on an object and facing into it; what lies right on a surface is not.
// ORACLE     identity: places known by construction.
// TOLERANCE  none.
TEST(Sensors, AreRefusedWhereNothingCanBeMeasured) {
  proves({}, Oracle::identity, "four places in the furnished room");
  const Scene scene = furnished_room(true);
  const ElementMesh mesh = mesh_elements(scene).value();
  const FinalGather gather(mesh);
  const auto along = [](const Vec3& v) { return Vec3((tilted(v) - tilted(Vec3::Zero())).normalized()); };
  const auto told = [&](const Vec3& place, const Vec3& normal) {
    const std::vector<Sensor> sensors{{"s", tilted(place), along(normal), "file:7"}};
    const auto checked = check_sensors(scene, gather, sensors);
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_EQ(told({1, 0.75, 0.5}, {0, 0, 1}),
            "file:7: sensor 's' is inside of object 'standing': nothing arrives there\n1 error");
  EXPECT_EQ(
      told({0.3, 0.3, 0}, {0, 1, 1}),
      "file:7: sensor 's' lies on object 'floor', but its normal is neither the surface's nor the opposite: lift it "
      "off the surface, or turn it\n1 error");
  EXPECT_EQ(told({1, 0.75, 1}, {0, 0, -1}),
            "file:7: sensor 's' lies on object 'standing' and faces into it: reverse its normal\n1 error");
  for (const Vec3& place : {Vec3(0.3, 0.3, 0), Vec3(1, 0.75, 1), Vec3(0.3, 0.3, 0.5)}) {
    EXPECT_TRUE(holds(told(place, {0, 0, 1}).empty()));
  }
}

// CLAIM      What two meshes say together has no error of the order h²; the estimate is that error of the finer.
// ORACLE     identity: H + c h² for h and 2h.
// TOLERANCE  rounding: four operations on numbers of order one; the bound is (4 b + b')/3.
TEST(Sensors, ExtrapolateTheSquareOfTheElementsAway) {
  proves({}, Oracle::identity, "H + c h²");
  const Rgb truth(1, 2, 0.25), c(0.5, -0.3, 0.01);
  const Gathered fine{truth + 0.01 * c, Rgb::Constant(0.3)}, coarse{truth + 0.04 * c, Rgb::Constant(0.6)};
  const Extrapolated both = extrapolated(fine, coarse);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_TRUE(near(both.irradiance(k), truth(k), 8 * kUnitRoundoff * 2));
    EXPECT_TRUE(near(both.discretisation(k), std::abs(0.01 * c(k)), 8 * kUnitRoundoff * 2));
    EXPECT_TRUE(near(both.bound(k), 0.6, 64 * kUnitRoundoff));
  }
}

}  // namespace
}  // namespace etendue::validation
