// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "etendue/assembly/closure.hpp"
#include "etendue/assembly/scene_radiosity.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/io/camera_file.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/view/radiosity_view.hpp"
#include "support/evidence.hpp"
#include "support/exhibit.hpp"
#include "support/process.hpp"

namespace etendue::validation {
namespace {

// An area is half the length of a sum of at most four cross products of coordinates that are exact here.
constexpr double kAreaRounding = gamma_bound(16);

Scene room() {
  return read_scene(source_root() / "scenes/room/scene.json").value().scene;
}

// The room with cells of 1 m × 1.1 m on the floor, on which the boxes still stand exactly: 160 elements.
Scene coarse_room() {
  Scene scene = room();
  for (Object& object : scene.objects) {
    const bool ten = object.subdivision.elements[0] == 10;
    object.subdivision = {{ten ? 5 : 1, ten ? 5 : 1}, {1, 1}};
  }
  return scene;
}

struct Solved {
  ElementMesh mesh;
  ClosureReport closure;
  SceneRadiosity radiosity;
};

// The division of the coarse room and its form factors, which do not depend on the paint: computed once.
const FormFactorMatrix& coarse_factors() {
  static const FormFactorMatrix matrix =
      assemble_form_factors(*mesh_elements(coarse_room()), {{1e-12, 1e-15}, {1e-4, 1e-7}}, {});
  return matrix;
}

Solved solved(const Scene& scene) {
  const auto solver = RadiositySolver::gaussian_elimination;
  Solved result{*mesh_elements(scene), {}, {}};
  result.closure = closure_report(result.mesh, coarse_factors());
  result.radiosity = solve_scene_radiosity(scene, result.mesh, coarse_factors(), {solver}).value();
  return result;
}

// Mean radiosity of the object of this name.
Rgb mean(const Scene& scene, const Solved& room, const std::string& name) {
  Rgb power = Rgb::Zero();
  double area = 0;
  for (std::size_t k = 0; k < room.mesh.elements.size(); ++k) {
    const Element& element = room.mesh.elements[k];
    if (scene.objects[room.mesh.face_of(element).object].name != name) continue;
    power += element.polygon.area() * room.radiosity.radiosity[k];
    area += element.polygon.area();
  }
  require(area > 0, "mean: the room has this object");
  return power / area;
}

Scene with_wall_painted(Scene scene, const std::string& wall, const Rgb& reflectance) {
  for (Material& material : scene.materials) {
    if (material.name == wall) material.rho = reflectance;
  }
  return scene;
}

// CLAIM      IU.f62, E28: the room has four walls, floor and ceiling of 100 elements, a yellow box and a grey box of 20
//            elements in 5 patches, and a light of one; walls have 50 patches of two elements, since the printed 52
//            does not divide 100.
// ORACLE     closed form: the counts of the text.
// TOLERANCE  none: counts.
TEST(Room, HasTheElementsAndPatchesOfTheText) {
  proves({"IU.f62", "E28"}, Oracle::closed_form, "the counts of the text");
  const Scene scene = room();
  const ElementMesh mesh = *mesh_elements(scene);
  std::map<std::string, std::size_t> elements;
  for (const Element& element : mesh.elements) {
    const std::string& name = scene.objects[mesh.face_of(element).object].name;
    ++elements[name.substr(0, name.find(','))];
  }
  const std::map<std::string, std::size_t> expected{{"red wall", 100},   {"blue wall", 100}, {"light grey wall", 100},
                                                    {"black wall", 100}, {"floor", 100},     {"ceiling", 100},
                                                    {"yellow box", 20},  {"grey box", 20},   {"light", 1}};
  EXPECT_TRUE(holds(elements == expected));
  EXPECT_TRUE(near(static_cast<double>(mesh.elements.size()), 641, 0));
  EXPECT_EQ(mesh.patches, 6u * 50 + 2 * 5 + 1);
  EXPECT_TRUE(apart(100 % 52, 0, 0)) << "52 patches of whole elements, as printed";
  Scene printed = scene;
  printed.objects[0].subdivision.patches[0] = 52;
  printed.objects[0].subdivision.patches[1] = 1;
  EXPECT_TRUE(holds(!mesh_elements(printed).ok()));
}

/// The red residuals of Jacobi's steps: r' = diag(ρ) F r, so none exceeds the one before by more than the largest ρ.
std::vector<double> jacobi_residuals(const Scene& scene, const ElementMesh& mesh) {
  constexpr int kSteps = 24;  // far above rounding
  std::vector<double> residuals;
  for (int steps = 1; steps <= kSteps; ++steps) {
    RadiosityGoal goal;
    goal.solver = RadiositySolver::jacobi;
    goal.most_steps = steps;
    residuals.push_back(solve_scene_radiosity(scene, mesh, coarse_factors(), goal)->channels[0].solution.residual);
  }
  return residuals;
}

/// The room as the report shows it: by the form factors of its elements, and solved.
void exhibit_room(const Scene& scene, const Solved& room, const std::vector<Balance>& balance) {
  const Eigen::Index n = coarse_factors().factors.rows();
  FactorTable table{"The room of figure 62, coarsely divided", {}, {}, {}, room.closure.covered};
  RadiosityField field;
  field.title = "The same room, solved";
  for (Eigen::Index i = 0; i < n; ++i) {
    const Polygon& polygon = room.mesh.elements[static_cast<std::size_t>(i)].polygon;
    table.areas.push_back(polygon.area());
    for (Eigen::Index j = 0; j < n; ++j) {
      table.factors.push_back(coarse_factors().factors(i, j));
      table.bounds.push_back(coarse_factors().bounds(i, j));
    }
    field.corners.emplace_back();
    for (const Vec3& v : polygon.vertices())
      field.corners.back().insert(field.corners.back().end(), {v.x(), v.y(), v.z()});
    for (const double b : room.radiosity.radiosity[static_cast<std::size_t>(i)]) field.radiosity.push_back(b);
  }
  field.residuals = jacobi_residuals(scene, room.mesh);
  for (const Material& material : scene.materials) field.contraction = std::max(field.contraction, material.rho(0));
  field.balance = balance;
  const Vec3& eye = scene.camera.eye;
  const Vec3 gaze = scene.camera.gaze.normalized();
  field.eye = {eye.x(), eye.y(), eye.z()};
  field.gaze = {gaze.x(), gaze.y(), gaze.z()};
  exhibit(table);
  exhibit(field);
}

// CLAIM      IU.f62, IU.6-6: the room is closed: every element that is not under a box sees 1, and what the light emits
//            is absorbed.
// ORACLE     identity: closure and the balance of power.
// TOLERANCE  closure: the returned bounds of the row's factors, and γ_n of their sum; those of obstructed factors are
//            estimates, so this holds them to account. Escaped power: each element's share of that. Emitted power:
//            kAreaRounding. Defect: with r = E + ρFB − B it is Σ A_i r_i + Σ_ij B_i (A_i F_ij − A_j F_ji), where
//            |r_i| ≤ 2 bound since r = −M e and rows of |M| sum to less than 2; and γ_(3n) of sums of no more than
//            3 Σ A max B.
TEST(Room, IsClosedAndKeepsItsPower) {
  proves({"IU.f62", "IU.6-6", "IU.6-1"}, Oracle::identity, "Σ_j F_ij = 1 and power in = power out");
  const Scene scene = coarse_room();
  const Solved room = solved(scene);
  EXPECT_EQ(room.closure.covered.size(), 2u);
  const FormFactorMatrix& matrix = coarse_factors();
  const Eigen::Index n = matrix.factors.rows();
  Eigen::VectorXd areas(n), open(n);  // open: the share of a row that its bounds let escape
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    areas(i) = room.mesh.elements[k].polygon.area();
    const auto& covered = room.closure.covered;
    const bool sees_nothing = std::find(covered.begin(), covered.end(), k) != covered.end();
    open(i) = sees_nothing ? 1 : matrix.bounds.row(i).sum() + gamma_bound(static_cast<int>(n));
    if (sees_nothing) continue;
    EXPECT_TRUE(within(std::abs(1 - room.closure.row_sums(i)), open(i))) << "element " << i;
  }
  const double reciprocity = reciprocity_defect(matrix.factors, areas);
  std::vector<Balance> balance;
  for (const ChannelRadiosity& channel : room.radiosity.channels) {
    const Eigen::VectorXd& b = channel.solution.radiosity;
    const double rounding = gamma_bound(3 * static_cast<int>(n)) * 3 * areas.sum() * b.maxCoeff();
    const double defect = 2 * channel.solution.bound * areas.sum() + static_cast<double>(n) * reciprocity * b.sum();
    const double escaped = areas.cwiseProduct(b).dot(open);
    EXPECT_TRUE(near(channel.balance.emitted, 40 * 2.5, 40 * 2.5 * kAreaRounding));
    EXPECT_TRUE(near(channel.balance.absorbed, channel.balance.emitted, escaped + defect + rounding));
    EXPECT_TRUE(near(channel.balance.defect, 0, defect + rounding));
    balance.push_back({channel.balance.emitted, channel.balance.absorbed, channel.balance.escaped, defect + rounding});
  }
  exhibit_room(scene, room, balance);
}

/// What each pixel shows of the room: the index of an object, or −1 for nothing.
std::vector<int> shown_objects(const Camera& camera, const ElementMesh& mesh) {
  std::vector<Rgb> number;
  for (const Element& element : mesh.elements) {
    number.push_back(Rgb::Constant(static_cast<double>(mesh.face_of(element).object)));
  }
  VertexRadiosities flat;  // not extrapolated: an object's pixels all have its number
  for (std::size_t k = 0; k < number.size(); ++k) {
    flat.corners.emplace_back(mesh.elements[k].polygon.vertices().size(), number[k]);
  }
  std::vector<int> objects;
  const Image picture = view_radiosities(camera, mesh, flat, Rgb::Constant(-1), 1).value();
  for (const Rgb& pixel : picture.pixels) objects.push_back(static_cast<int>(std::lround(pixel(0))));
  return objects;
}

// CLAIM      IU.f62, IU.6.5v: the five views of scenes/room/cameras.json, of one solution, show together every surface that the text
//            names and no other; those from inside the room show nothing but the room; and what they show has the text's colours:
//            walls red, blue, light grey and black, boxes yellow and grey.
// ORACLE     render: which object each pixel shows; the order of the channels that a colour's name means.
// TOLERANCE  none: means over all pixels of an object and a view. "Grey" in a room with coloured walls: its largest channel
//            below twice its smallest; "light grey" more than twice as bright as "black".
TEST(Room, FiveViewsShowItsSurfacesAndColours) {
  proves({"IU.f62", "IU.6.5v"}, Oracle::render, "what each pixel shows");
  const Scene scene = coarse_room();
  const Solved room = solved(scene);
  const VertexRadiosities vertices = vertex_radiosities(room.mesh, room.radiosity.radiosity, room.closure.covered);
  const auto cameras = read_cameras(source_root() / "scenes/room/cameras.json", scene.metres_per_unit);
  ASSERT_TRUE(cameras.ok());
  EXPECT_EQ(cameras->size(), 5u);
  std::map<std::string, Rgb> sums;
  std::map<std::string, double> counts;
  std::uint64_t outside = 0, inside = 0;
  for (const NamedCamera& one : *cameras) {
    Camera camera = one.camera;
    camera.columns /= 4;
    camera.rows /= 4;
    const std::vector<int> objects = shown_objects(camera, room.mesh);
    const Image picture = view_radiosities(camera, room.mesh, vertices, Rgb::Zero(), 1).value();
    for (std::size_t k = 0; k < objects.size(); ++k) {
      if (camera.eye.y() > 0) {
        ++inside;
        outside += objects[k] < 0;
      }
      if (objects[k] < 0) continue;
      const std::string& name = scene.objects[static_cast<std::size_t>(objects[k])].name;
      const std::string kind = name.substr(0, name.find(','));
      sums.emplace(kind, Rgb::Zero()).first->second += picture.pixels[k];
      ++counts[kind];
    }
  }
  EXPECT_TRUE(all_agree(outside, inside)) << "pixels that see through the room";
  std::map<std::string, Rgb> means;
  for (const auto& [kind, sum] : sums) means[kind] = sum / counts[kind];
  EXPECT_EQ(means.size(), 9u) << "four walls, floor, ceiling, two boxes, the light";
  const auto brightness = [&](const char* kind) { return means.at(kind).mean(); };
  const Rgb red = means.at("red wall"), blue = means.at("blue wall"), yellow = means.at("yellow box");
  EXPECT_TRUE(holds(red(0) > 3 * red(1) && red(0) > 3 * red(2)));
  EXPECT_TRUE(holds(blue(2) > 3 * blue(0) && blue(2) > 3 * blue(1)));
  EXPECT_TRUE(holds(yellow(0) > 3 * yellow(2) && yellow(1) > 3 * yellow(2)));
  for (const char* grey : {"light grey wall", "black wall", "grey box"}) {
    EXPECT_TRUE(holds(means.at(grey).maxCoeff() < 2 * means.at(grey).minCoeff())) << grey;
  }
  EXPECT_TRUE(holds(brightness("light grey wall") > 2 * brightness("black wall")));
}

// CLAIM      IU.6.8: colours bleed: the red wall on the near side of the yellow box, the blue wall on that of the grey
//            box. Painting such a wall grey, with the largest of its reflectances in every channel, leaves its own
//            channel as it was to the last bit and brightens the other two everywhere, on the near side more than on
//            the far one.
// ORACLE     metamorphic: channels are separate systems, and B grows with every ρ.
// TOLERANCE  the returned bounds of both solutions; none for the channel that is untouched.
TEST(Room, WallsBleedTheirColourOntoTheBoxes) {
  proves({"IU.6.8", "IU.6-9"}, Oracle::metamorphic, "monotonicity in ρ, channel by channel");
  const Scene scene = coarse_room();
  const Solved room = solved(scene);
  struct Case {
    const char* wall;
    Rgb paint;
    Eigen::Index own, other;
    const char* near_side;
    const char* far_side;
  };
  const Case cases[] = {
      {"red wall", Rgb::Constant(0.62), 0, 2, "yellow box, towards the red wall", "yellow box, towards the blue wall"},
      {"blue wall", Rgb::Constant(0.62), 2, 0, "grey box, towards the blue wall", "grey box, towards the red wall"}};
  for (const Case& one : cases) {
    const Scene painted = with_wall_painted(scene, one.wall, one.paint);
    const Solved grey = solved(painted);
    const auto own = static_cast<std::size_t>(one.own), other = static_cast<std::size_t>(one.other);
    EXPECT_TRUE(grey.radiosity.channels[own].solution.radiosity == room.radiosity.channels[own].solution.radiosity);
    const double slack = grey.radiosity.channels[other].solution.bound + room.radiosity.channels[other].solution.bound;
    for (std::size_t k = 0; k < room.mesh.elements.size(); ++k) {
      const double dimmed = room.radiosity.radiosity[k](one.other) - grey.radiosity.radiosity[k](one.other);
      EXPECT_TRUE(within(std::max(dimmed, 0.0), slack));
    }
    const auto bleeding = [&](const char* side) {
      return 1 - mean(scene, room, side)(one.other) / mean(scene, grey, side)(one.other);
    };
    EXPECT_GT(bleeding(one.near_side), bleeding(one.far_side));
    EXPECT_GT(bleeding(one.near_side), 0.05) << "enough to be seen";
  }
}

}  // namespace
}  // namespace etendue::validation
