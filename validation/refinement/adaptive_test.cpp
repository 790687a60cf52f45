// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "etendue/io/scene_reader.hpp"
#include "etendue/meshing/shared_vertices.hpp"
#include "etendue/refinement/adaptive_radiosity.hpp"
#include "etendue/view/vertex_radiosity.hpp"
#include "refinement/penumbra.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.6.7.2: on a floor with a shadow, adaptive subdivision reaches the error of a uniform division into its smallest
//            elements, to 10 %, with at most three fifths as many; and the uniform error falls, faster than with order one half.
// ORACLE     closed form: the lamp's rectangle less the plate's shadow on it, seen from 9,216 points.
// TOLERANCE  the error a tenth above the uniform one, three fifths of its elements (measured: 559 of 1,024); of the order (constants have one on what is smooth at the
//            elements' scale, one half across a jump) only that it lies between one half and 1.1.
TEST(AdaptiveRadiosity, NeedsFewerElementsThanUniformForTheSameError) {
  proves({"IU.6.7.2"}, Oracle::closed_form, "visible part of a rectangle, from each point");
  const Penumbra penumbra;
  std::map<int, double> uniform;
  for (const int cells : {8, 16, 32}) {
    uniform[cells] = error_on_floor(penumbra, adapted(penumbra.scene(cells), {1e9, 0, 100'000}));
  }
  EXPECT_TRUE(near(std::log2(uniform[8] / uniform[32]) / 2, 0.8, 0.3));
  const AdaptiveSolution solution = adapted(penumbra.scene(8), {0.04, 2, 100'000});
  EXPECT_TRUE(holds(solution.complete));
  EXPECT_TRUE(within(error_on_floor(penumbra, solution), 1.1 * uniform[32])) << uniform[8] << ' ' << uniform[16];
  EXPECT_TRUE(within(static_cast<double>(floor_elements(solution)), 0.6 * 32 * 32));
}

// CLAIM      IU.6.7.2: elements are quartered where neighbours differ too much, nowhere else, until none do or the levels end;
//            neighbours' levels differ by one at most; the parts make up their faces.
// ORACLE     identity: every pair of elements that touch along a side, found by their corners; areas.
// TOLERANCE  areas: 2^-40 of the face. Differences: the threshold itself.
TEST(AdaptiveRadiosity, DividesUntilNeighboursAgree) {
  proves({"IU.6.7.2"}, Oracle::identity, "all touching pairs");
  const Penumbra penumbra;
  const Scene scene = penumbra.scene(4);
  const AdaptiveGoal goal{0.05, 3, 100'000};
  const AdaptiveSolution solution = adapted(scene, goal);
  const auto values = radiosities(scene, solution.model, emissions_of(scene, solution.model), solution.state);
  const auto& elements = solution.model.elements.elements;
  double white = 0, area = 0, finest = 1;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (solution.mesh.cells[k].face != 0) continue;
    white = std::max(white, values[k](0));
    area += elements[k].polygon.area();
    finest = std::min(finest, elements[k].polygon.area());
  }
  EXPECT_TRUE(near(area, 1, 0x1p-40));
  EXPECT_TRUE(near(finest, 1.0 / (32 * 32), 0x1p-40)) << "three halvings of a quarter";
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t j = i + 1; j < elements.size(); ++j) {
      const MeshCell &a = solution.mesh.cells[i], &b = solution.mesh.cells[j];
      if (a.face != 0 || b.face != 0) continue;
      const Vec3 low = elements[i].polygon.vertices()[0].cwiseMax(elements[j].polygon.vertices()[0]);
      const Vec3 high = elements[i].polygon.vertices()[2].cwiseMin(elements[j].polygon.vertices()[2]);
      const double wide = high.x() - low.x(), tall = high.y() - low.y();
      constexpr double kTouch = 1e-9;  // corners are quotients of whole numbers, a few roundings apart at most
      if (std::min(wide, tall) < -kTouch || std::max(wide, tall) < kTouch || std::min(wide, tall) > kTouch) continue;
      ++pairs;
      EXPECT_LE(std::abs(a.level - b.level), 1);
      const bool differs = std::abs(values[i](0) - values[j](0)) > goal.difference * white;
      if (differs) {
        EXPECT_TRUE(a.level == goal.most_levels && b.level == goal.most_levels);
      }
    }
  }
  const auto found = neighbours(solution.mesh);
  const auto on_floor = [&](const Neighbours& pair) { return solution.mesh.cells[pair.first].face == 0; };
  EXPECT_EQ(static_cast<std::ptrdiff_t>(pairs), std::count_if(found.begin(), found.end(), on_floor));
  EXPECT_GT(pairs, 200u);
  EXPECT_GE(solution.rounds.size(), 3u);
}

// CLAIM      IU.6.7.2, IU.6.5: where small elements end on the side of a large one, their corners become its corners: every
//            side within a face is one of exactly two elements, so an interpolation from corners has no crack and no jump;
//            the vertices' values are the same from all sides, and a linear radiosity has at a T-vertex the mean of its
//            three elements, which is exact.
// ORACLE     identity: sides counted by their end points; a linear function at T-vertices.
// TOLERANCE  none for sides and values; 4 roundings of values below 8 for the linear function.
TEST(AdaptiveRadiosity, LeavesNoTVertexInTheDisplay) {
  proves({"IU.6.7.2", "IU.6.5"}, Oracle::identity, "each inner side has two elements");
  const Scene scene = scene_of({quadrilateral({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0})});
  AdaptiveMesh mesh = with_halved_singles(scene, adaptive_mesh(scene, *mesh_elements(scene)));
  for (const std::size_t cell : {std::size_t{0}, std::size_t{3}, std::size_t{5}}) {
    std::vector<bool> which(mesh.cells.size(), false);
    which[cell] = true;
    mesh = split(mesh, which).mesh;
  }
  const ElementMesh plain = *elements_of(mesh), shown = with_shared_vertices(plain);
  using End = std::array<double, 2>;
  const auto lone_sides = [](const ElementMesh& of) {
    std::map<std::pair<End, End>, int> sides;
    for (const Element& element : of.elements) {
      const auto& v = element.polygon.vertices();
      for (std::size_t k = 0; k < v.size(); ++k) {
        const Vec3 &a = v[k], &b = v[(k + 1) % v.size()];
        const bool border =
            (a.x() == b.x() && (a.x() == 0 || a.x() == 4)) || (a.y() == b.y() && (a.y() == 0 || a.y() == 4));
        const End from{a.x(), a.y()}, to{b.x(), b.y()};
        if (!border) ++sides[{std::min(from, to), std::max(from, to)}];
      }
    }
    std::uint64_t lone = 0;
    for (const auto& [side, count] : sides) lone += count != 2;
    return std::pair(lone, static_cast<std::uint64_t>(sides.size()));
  };
  EXPECT_GT(lone_sides(plain).first, 5u) << "there are T-vertices";
  const auto [lone, sides] = lone_sides(shown);
  EXPECT_TRUE(all_agree(lone, sides));

  std::vector<Rgb> linear;
  for (const Element& element : shown.elements) {
    linear.push_back(Rgb::Constant(1 + plain.elements[linear.size()].polygon.centroid().x() +
                                   0.5 * plain.elements[linear.size()].polygon.centroid().y()));
    EXPECT_TRUE(near(element.polygon.area(), plain.elements[linear.size() - 1].polygon.area(), 1e-15));
  }
  const VertexRadiosities values = vertex_radiosities(shown, linear);
  std::map<End, double> at;
  std::uint64_t different = 0, corners = 0;
  for (std::size_t k = 0; k < shown.elements.size(); ++k) {
    const auto& v = shown.elements[k].polygon.vertices();
    for (std::size_t c = 0; c < v.size(); ++c, ++corners) {
      const double value = values.corners[k][c](0);
      different += at.emplace(End{v[c].x(), v[c].y()}, value).first->second != value;
      const auto& own = plain.elements[k].polygon.vertices();
      if (std::find(own.begin(), own.end(), v[c]) != own.end()) continue;
      EXPECT_TRUE(near(value, 1 + v[c].x() + 0.5 * v[c].y(), 32 * 0x1p-53)) << "a T-vertex";
    }
  }
  EXPECT_TRUE(all_agree(different, corners));
}

// CLAIM      IU.6.7.2, IU.6-16: adaptive by shooting, paused anywhere, ends in the same bits; and its radiosities are those of the
//            full method (patches solved directly, elements gathering) on the same elements.
// ORACLE     identity for the pauses; another method for the radiosities.
// TOLERANCE  none for bits; the gap, and 1e-4 of the brightest for factors to 1e-5 found from either side.
TEST(AdaptiveRadiosity, AgreesWithTheFullMethodAndSurvivesPauses) {
  proves({"IU.6.7.2", "IU.6-16", "IU.6-18"}, Oracle::program, "elimination");
  const Scene scene = furnished(2, 1, false);
  const AdaptiveGoal goal{0.15, 1, 100'000};
  const FactorsOf factors = [](const PatchModel& model) {
    return remembered(exact_factors(model, {{1e-10, 1e-13}, {1e-4, 1e-7}}), model.patch_areas.size(), 1 << 24);
  };
  const auto begun = before_adapting(scene, model_of(scene), Beginning::halved_singles);
  const SceneShootingGoal converged{1e-6, 100'000, ShotRule::unshot};
  const AdaptiveSolution whole = adapt_by_shooting(scene, *begun, factors, goal, converged).value();
  ASSERT_TRUE(whole.complete);
  EXPECT_GT(whole.rounds.size(), 1u);
  AdaptiveSolution paused = *begun;
  for (std::size_t most = 5; !paused.complete; most += 40) {
    paused = adapt_by_shooting(scene, paused, factors, goal, {1e-6, most, ShotRule::unshot}).value();
  }
  EXPECT_TRUE(holds(same_bits(whole.state, paused.state) && whole.mesh.cells == paused.mesh.cells));

  const AdaptiveSolution full = adapt_by_elimination(scene, *begun, factors, goal).value();
  ASSERT_TRUE(full.complete);
  ASSERT_TRUE(holds(full.mesh.cells == whole.mesh.cells));
  const auto shot = radiosities(scene, whole.model, emissions_of(scene, whole.model), whole.state);
  const auto solved = radiosities(scene, full.model, emissions_of(scene, full.model), full.state);
  const Rgb gap = shooting_gap(scene, whole.model, whole.state, true).radiosity;
  for (std::size_t q = 0; q < shot.size(); ++q) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      EXPECT_TRUE(near(shot[q](c), solved[q](c), gap(c) + full.bound(c) + 1e-4 * 10));
    }
  }
  const Rgb left = (full.state.emitted - full.state.absorbed - full.state.escaped).abs();
  EXPECT_TRUE(within(left.maxCoeff(), 1e-9 * full.state.emitted.maxCoeff()));
}

// CLAIM      IU.6.7.2, IU.6.5.1: in a scene that is cut at contacts, and whose triangle is divided by size, adaptive subdivision
//            quarters cells and pieces alike; patches and elements make up their faces; what is a patch of many elements is one
//            polygon; pieces are neighbours along their sides, but not across a contact.
// ORACLE     identity: areas; a piece cut in four; neighbours by sides that pieces have in common, counted by a point beside each.
// TOLERANCE  areas: 2^-40 of the face.
TEST(AdaptiveRadiosity, QuartersPiecesToo) {
  proves({"IU.6.7.2", "IU.6.5.1"}, Oracle::identity, "areas, and what lies beside the sides of pieces");
  const Penumbra penumbra;
  Scene scene = penumbra.scene(4);
  scene.objects.push_back({"post", Box{{0.53, 0.21, 0.1}, Mat3::Identity(), {0.1, 0.07, 0.1}}, 1, {}});
  scene.objects.push_back({"sail", Triangle{{0, 1, 0.5}, {0.3, 1, 0.5}, {0, 1, 0.9}}, 0, {{1, 1}, {1, 1}, 0.13}});
  scene.align_mesh = true;
  const ElementMesh before = *mesh_elements(scene);
  const AdaptiveSolution solution = adapted(scene, {0.05, 2, 100'000});
  const auto& after = solution.model.elements;
  std::vector<double> elements(before.faces.size(), 0), patches(before.faces.size(), 0);
  for (const Element& element : after.elements) elements[element.face] += element.polygon.area();
  for (const Element& patch : solution.model.patches.elements) patches[patch.face] += patch.polygon.area();
  for (std::size_t k = 0; k < before.faces.size(); ++k) {
    const double area = before.faces[k].polygon.area();
    EXPECT_TRUE(near(elements[k], area, 0x1p-40 * area));
    EXPECT_TRUE(near(patches[k], area, 0x1p-40 * area));
  }
  std::map<std::int64_t, int> halvings;
  for (const MeshCell& cell : solution.mesh.cells) {
    if (cell.level == kPiece) ++halvings[cell.b];
  }
  EXPECT_TRUE(holds(halvings[0] > 0 && halvings[2] > 0)) << halvings[0] << ' ' << halvings[1] << ' ' << halvings[2];
  EXPECT_GT(floor_elements(solution), 60u);

  // Of each side of a piece, the element that a point beside its middle is in: its neighbour, unless a contact lies between.
  std::set<std::pair<std::size_t, std::size_t>> told;
  for (const auto& [first, second] : neighbours(solution.mesh)) told.emplace(first, second);
  std::uint64_t wrong = 0, sides = 0, across = 0;
  for (std::size_t k = 0; k < after.elements.size(); ++k) {
    if (solution.mesh.cells[k].level != kPiece) continue;
    const Polygon& own = after.elements[k].polygon;
    const auto& v = own.vertices();
    for (std::size_t s = 0; s < v.size(); ++s) {
      const Vec3 side = v[(s + 1) % v.size()] - v[s], middle = v[s] + 0.4375 * side;
      const Vec3 beside = middle + 1e-7 * side.cross(own.normal()).normalized();
      const auto holds_point = [&](const Element& element) {
        if (element.face != after.elements[k].face) return false;
        const auto& w = element.polygon.vertices();
        for (std::size_t c = 0; c < w.size(); ++c) {
          if (own.normal().dot((w[(c + 1) % w.size()] - w[c]).cross(beside - w[c])) <= 0) return false;
        }
        return true;
      };
      const auto found = std::find_if(after.elements.begin(), after.elements.end(), holds_point);
      if (found == after.elements.end()) continue;
      const auto other = static_cast<std::size_t>(found - after.elements.begin());
      const bool crosses = std::any_of(after.contacts.begin(), after.contacts.end(), [&](const Contact& contact) {
        const Vec3 way = contact.segment.to - contact.segment.from, to = middle - contact.segment.from;
        const double t = way.dot(to) / way.squaredNorm();
        return contact.face == found->face && t > 0 && t < 1 && way.cross(to).norm() < 1e-9 * way.norm();
      });
      ++sides;
      across += crosses;
      wrong += (told.count({std::min(k, other), std::max(k, other)}) > 0) == crosses;
    }
  }
  EXPECT_TRUE(all_agree(wrong, sides));
  EXPECT_TRUE(holds(across >= 8 && sides > 100)) << across << ' ' << sides;

  const SplitMesh all = split(solution.mesh, std::vector<bool>(solution.mesh.cells.size(), true));
  std::vector<double> parts(solution.mesh.cells.size(), 0);
  const ElementMesh divided = *elements_of(all.mesh);
  for (std::size_t k = 0; k < all.parents.size(); ++k) parts[all.parents[k]] += divided.elements[k].polygon.area();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double area = after.elements[k].polygon.area();
    EXPECT_TRUE(near(parts[k], area, 0x1p-40 * area));
  }
  EXPECT_TRUE(holds(10 * all.mesh.cells.size() > 39 * solution.mesh.cells.size()));
}

/// Does a box of the room lie between two points? By slabs.
bool box_between(const Vec3& from, const Vec3& to) {
  const std::array<std::pair<Vec3, Vec3>, 2> boxes{
      {{Vec3(1, 1.1, 0), Vec3(2, 2.2, 0.9)}, {Vec3(3, 3.3, 0), Vec3(4, 4.4, 1.7)}}};
  for (const auto& [low, high] : boxes) {
    double enter = 1e-9, leave = 1;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double d = to(k) - from(k);
      const double a = (low(k) - from(k)) / d, b = (high(k) - from(k)) / d;  // d is 0 for no pair asked about
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter < leave) return true;
  }
  return false;
}

/// The part of 5 × 11 points of the room's light that a point of the floor sees; irrational steps keep rays off the axes.
double lit_part(const Vec3& point) {
  int lit = 0;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 11; ++j) {
      lit += !box_between(point, Vec3(2 + (i + 0.5013) / 5, 1.5 + 2.5 * (j + 0.5017) / 11, 3));
    }
  }
  return lit / 55.0;
}

/// Distance on the floor from the nearer box.
double from_boxes(const Vec3& p) {
  const auto from = [&](double x0, double y0, double x1, double y1) {
    return std::hypot(std::max({x0 - p.x(), p.x() - x1, 0.0}), std::max({y0 - p.y(), p.y() - y1, 0.0}));
  };
  return std::min(from(1, 1.1, 2, 2.2), from(3, 3.3, 4, 4.4));
}

/// By how much, of the darkest element that touches it, a corner of the floor on a box's outline is shown too dark; the mean over
/// all such corners. `covered`: elements that the display is told to leave out.
double shadow_leak(const Scene& scene, const AdaptiveSolution& solution, const std::vector<std::size_t>& covered) {
  const ElementMesh shown = with_shared_vertices(solution.model.elements);
  const auto values = radiosities(scene, solution.model, emissions_of(scene, solution.model), solution.state);
  const VertexRadiosities vertices = vertex_radiosities(shown, values, covered);
  double leak = 0, corners = 0;
  for (std::size_t k = 0; k < shown.elements.size(); ++k) {
    const Polygon& polygon = shown.elements[k].polygon;
    if (scene.objects[shown.face_of(shown.elements[k]).object].name != "floor") continue;
    if (from_boxes(polygon.centroid()) == 0) continue;
    for (std::size_t c = 0; c < polygon.vertices().size(); ++c) {
      if (from_boxes(polygon.vertices()[c]) > 1e-9) continue;
      leak += std::max(0.0, 1 - vertices.corners[k][c].sum() / values[k].sum());
      ++corners;
    }
  }
  return leak / corners;
}

struct Density {
  double elements = 0, area = 0;
  void add(const Element& element) {
    ++elements;
    area += element.polygon.area();
  }
  double value() const { return elements / area; }
};

// CLAIM      IU.f65: refined adaptively, the room's mesh is dense on the walls where the ceiling meets them, on the floor in the half
//            shadows of the boxes, and around their feet; elsewhere it stays as the scene has it. Shadows do not leak: the boxes stand on
//            whole elements, and what lies under them has no part in the display.
// ORACLE     closed form: where the half shadows are, by the light's visible part behind two boxes, written out here.
// TOLERANCE  "dense": at least half as many again per square metre as on the rest of the same surfaces, at the feet twice as many
//            as a metre away; the ceiling, which no shadow reaches, has its 100 elements. Leaks: at the feet the floor is
//            shown darker than its elements by a fifth at most in the mean, as it does darken towards them; by less than half of
//            what the elements under the boxes would make it.
TEST(AdaptiveRadiosity, RefinesTheRoomWhereTheTextShowsIt) {
  proves({"IU.f65"}, Oracle::closed_form, "half shadows of two boxes");
  const Scene scene = read_scene(source_root() / "scenes/room/scene.json").value().scene;
  const PatchModel model = *patch_model(scene, *mesh_elements(scene));
  const FactorsOf factors = [](const PatchModel& of) {
    return remembered(hemicube_factors(of, {PixelBody::hemicube, 256, 1, false, 1}), of.patch_areas.size(), 1 << 26);
  };
  const SceneShootingGoal shooting{0.02, 5000, ShotRule::overshoot};
  const AdaptiveSolution solution = adapt_by_shooting(scene, *before_adapting(scene, model, Beginning::halved_singles),
                                                      factors, {0.07, 2, 20'000}, shooting)
                                        .value();
  ASSERT_TRUE(solution.complete);
  Density under_ceiling, below, half_shadow, rest, feet, far;
  std::size_t ceiling = 0;
  for (const Element& element : solution.model.elements.elements) {
    const std::string& name = scene.objects[solution.mesh.faces[element.face].object].name;
    const Vec3 at = element.polygon.centroid();
    ceiling += name.rfind("ceiling", 0) == 0;
    if (name == "red wall" || name == "light grey wall" || name == "blue wall") {
      if (at.z() > 2.4) under_ceiling.add(element);
      if (at.z() > 1.5 && at.z() < 2.4) below.add(element);
    }
    if (name != "floor" || from_boxes(at) == 0) continue;
    const double lit = lit_part(at);
    (lit > 0 && lit < 1 ? half_shadow : rest).add(element);
    if (from_boxes(at) < 0.3) feet.add(element);
    if (from_boxes(at) > 1) far.add(element);
  }
  EXPECT_EQ(ceiling, 100u);
  EXPECT_TRUE(holds(under_ceiling.value() > 1.5 * below.value())) << under_ceiling.value() << ' ' << below.value();
  EXPECT_TRUE(holds(half_shadow.value() > 1.5 * rest.value())) << half_shadow.value() << ' ' << rest.value();
  EXPECT_TRUE(holds(feet.value() > 2 * far.value())) << feet.value() << ' ' << far.value();
  const auto under = without_view(solution.model, solution.state.irradiance, {});
  const double told = shadow_leak(scene, solution, under), untold = shadow_leak(scene, solution, {});
  EXPECT_TRUE(within(told, 0.2));
  EXPECT_TRUE(holds(untold > 2 * told)) << untold << ' ' << told;
}

// CLAIM      IU.f66: a furnished room of more than 20,000 elements is shot to a given share; of what windows and lamps shoot
//            nothing gets behind its surfaces; and what has arrived by then has elements quartered on tables, floor and walls, but not everywhere.
//            (The picture takes a second round and more shots: scenes/reading-room.)
// ORACLE     identity: emitted = absorbed + unshot + escaped, and nothing escapes.
// TOLERANCE  1e-9 of what is emitted: sums of 30,000 elements in some hundred steps.
TEST(AdaptiveRadiosity, RefinesAFurnishedRoomOfManyElements) {
  proves({"IU.f66"}, Oracle::identity, "the balance of power in a closed room");
  const Scene scene = read_scene(source_root() / "scenes/reading-room/scene.json").value().scene;
  const PatchModel model = *patch_model(scene, *mesh_elements(scene));
  AdaptiveSolution solution = before_adapting(scene, model, Beginning::halved_singles).value();
  const std::size_t elements = solution.mesh.cells.size();
  EXPECT_GT(elements, 20'000u);
  const auto factors = hemicube_factors(solution.model, {PixelBody::hemicube, 64, 1, false, 1});
  SceneShooting& state = solution.state;
  const SceneShootingGoal goal{0.6, 1000, ShotRule::unshot};
  ASSERT_EQ(shoot_until(state, scene, solution.model, *factors, goal), ShootingEnd::reached);
  EXPECT_TRUE(within(state.unshot_shares.back(), 0.6));
  const double emitted = state.emitted.sum();
  const double left = unshot_power(solution.model, state).sum();
  EXPECT_TRUE(near(state.absorbed.sum() + state.escaped.sum() + left, emitted, 1e-9 * emitted));
  EXPECT_TRUE(within(state.escaped.sum(), 1e-9 * emitted));

  const auto values = radiosities(scene, solution.model, emissions_of(scene, solution.model), state);
  const AdaptiveMesh finer = split(solution.mesh, too_steep(solution.mesh, scene, values, {0.01, 2, 60'000})).mesh;
  EXPECT_GT(finer.cells.size(), elements + 1000);
  EXPECT_LT(finer.cells.size(), 2 * elements);
}

}  // namespace
}  // namespace etendue::validation
