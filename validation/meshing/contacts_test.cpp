// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kTouch = 0x1p-38;

Polygon floor_of(double side) {
  return quadrilateral({0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0});
}

/// A wall over a line of the floor, from height `low` to `high`.
Polygon wall(double x0, double y0, double x1, double y1, double low, double high) {
  return quadrilateral({x0, y0, low}, {x1, y1, low}, {x1, y1, high}, {x0, y0, high});
}

std::vector<Segment> on_face(const std::vector<Contact>& found, std::size_t face) {
  std::vector<Segment> segments;
  for (const Contact& contact : found) {
    if (contact.face == face) segments.push_back(contact.segment);
  }
  return segments;
}

std::vector<Segment> on_floor(const std::vector<Polygon>& others) {
  std::vector<Face> faces{{floor_of(4), 0, 0}};
  for (const Polygon& other : others) faces.push_back({other, 0, 0});
  return on_face(contacts(faces, kTouch), 0);
}

bool joins(const Segment& segment, const Vec3& a, const Vec3& b) {
  const double slack = 2 * kTouch;  // ends at a border may lie beyond it by the touching distance, and at a slant
  return ((segment.from - a).norm() < slack && (segment.to - b).norm() < slack) ||
         ((segment.from - b).norm() < slack && (segment.to - a).norm() < slack);
}

/// A box of 1 × 2, turned by the angle of (3, 4), that stands on the floor.
Box standing() {
  Mat3 axes;
  axes << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
  return {{1.7, 1.9, 0.5}, axes, {0.5, 1, 0.5}};
}

// CLAIM      IU.6.5.1: contacts are what other faces have in common with a face, in front of it: the foot of a wall, cut at the
//            floor's border; the line where one pierces the floor; no foot that hovers, no face behind, no plate that lies
//            in the plane, no corner alone.
// ORACLE     closed form: end points by hand.
// TOLERANCE  twice the distance that counts as touching.
TEST(Contacts, AreTheFeetOfWhatStandsOnAFace) {
  proves({"IU.6.5.1"}, Oracle::closed_form, "end points by hand");
  struct Case {
    Polygon other;
    bool meets;
    Vec3 a, b;
  };
  const Vec3 none = Vec3::Zero();
  const std::vector<Case> cases{
      {wall(1, 1, 3, 2, 0, 2), true, {1, 1, 0}, {3, 2, 0}},
      {wall(-2, 1, 2, 3, 0, 2), true, {0, 2, 0}, {2, 3, 0}},
      {wall(1, 1, 3, 2, -1, 2), true, {1, 1, 0}, {3, 2, 0}},
      {wall(1, 1, 3, 2, kTouch / 2, 2), true, {1, 1, 0}, {3, 2, 0}},
      {wall(1, 1, 3, 2, 3 * kTouch, 2), false, none, none},
      {wall(1, 1, 3, 2, -2, 0), false, none, none},
      {wall(5, 1, 5, 2, 0, 2), false, none, none},
      {wall(0, 1, 0, 2, 0, 2), true, {0, 1, 0}, {0, 2, 0}},
      {polygon({{1, 1, 0}, {2, 1, 1}, {1, 2, 1}}), false, none, none},
      {polygon({{1, 1, 0}, {1, 2, 0}, {2, 1, 0}}), false, none, none},
      {polygon({{1, 1, -1}, {3, 1, 1}, {1, 3, 1}}), true, {2, 1, 0}, {1, 2, 0}},
      {polygon({{1, 1, 0}, {1.5, 1.25, 0}, {3, 2, 0}, {2, 2, 1}}), true, {1, 1, 0}, {3, 2, 0}},
  };
  std::uint64_t wrong = 0;
  for (const Case& one : cases) {
    const auto found = on_floor({one.other});
    const bool right = one.meets ? found.size() == 1 && joins(found[0], one.a, one.b) : found.empty();
    wrong += !right;
    EXPECT_TRUE(right) << "case " << &one - cases.data() << ": " << found.size();
  }
  EXPECT_TRUE(all_agree(wrong, cases.size()));
}

// CLAIM      IU.6.5.1: cut at its contacts, a floor with a turned box on it has elements under the box that fill its base and
//            elements beside it that fill the rest, with any division; no element of any face lies on both sides of
//            another; elements that nothing cuts keep their patches, the others are patches of their own.
// ORACLE     closed form: the base's area; identity: corners against all four lines of the base.
// TOLERANCE  areas: 64 roundings of 16 for each of at most 200 pieces.
TEST(Contacts, DivideAFloorAlongTheFootOfABox) {
  proves({"IU.6.5.1"}, Oracle::closed_form, "area of the base");
  const Box box = standing();
  const auto depth = [&](const Vec3& p) {  // above zero inside the base
    const Vec3 local = box.axes.transpose() * (p - box.centre);
    return std::min(box.half_edges.x() - std::abs(local.x()), box.half_edges.y() - std::abs(local.y()));
  };
  for (const int cells : {1, 3, 4, 8}) {
    Scene scene = scene_of({floor_of(4), box});
    scene.objects[0].subdivision = {{cells, cells}, {1, 1}};
    if (cells % 4 == 0) scene.objects[0].subdivision.patches[0] = scene.objects[0].subdivision.patches[1] = cells / 2;
    const ElementMesh whole = *mesh_elements(scene);
    EXPECT_TRUE(holds(whole.contacts.empty()));
    scene.align_mesh = true;
    const ElementMesh mesh = *mesh_elements(scene);
    double under = 0, beside = 0;
    std::uint64_t astride = 0;
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
      const Element& element = mesh.elements[k];
      members[element.patch].push_back(k);
      if (element.face != 0) continue;
      const bool covered = depth(element.polygon.centroid()) > 0;
      (covered ? under : beside) += element.polygon.area();
      for (const Vec3& v : element.polygon.vertices()) {
        const double in = depth(v);
        astride += (covered ? in : -in) < -2 * kTouch;
      }
    }
    EXPECT_TRUE(near(under, 2, 200 * 64 * 16 * 0x1p-53)) << cells;
    EXPECT_TRUE(near(beside, 14, 200 * 64 * 16 * 0x1p-53)) << cells;
    EXPECT_TRUE(all_agree(astride, mesh.elements.size()));
    EXPECT_TRUE(holds(members.size() == mesh.patches && members.rbegin()->first + 1 == mesh.patches));
    std::uint64_t mixed = 0;
    for (const auto& [patch, elements] : members) {
      for (const std::size_t k : elements) mixed += elements.size() > 1 && mesh.elements[k].cell == kNoCell;
    }
    EXPECT_TRUE(all_agree(mixed, members.size()));
    const auto four = [](const auto& patch) { return patch.second.size() == 4; };
    const auto kept = static_cast<double>(std::count_if(members.begin(), members.end(), four));
    EXPECT_TRUE(near(kept, cells == 8 ? 16 - 7 : 0, 0)) << "seven unit squares have a side of the base in them";
  }
}

// CLAIM      A scene in which nothing stands inside a face, as a room alone, is not changed by cutting: the same elements in the
//            same patches.
// ORACLE     identity: equality.
// TOLERANCE  none.
TEST(Contacts, LeaveARoomAsItIs) {
  proves({"IU.6.5.1"}, Oracle::identity, "equal meshes");
  Scene scene = room_of({0.1, -0.7, 0.3}, {2.2, 3.1, 1.9});
  for (Object& object : scene.objects) object.subdivision = {{4, 6}, {2, 3}};
  const ElementMesh whole = *mesh_elements(scene);
  const ElementMesh cut = cut_at_contacts(whole);
  ASSERT_EQ(cut.elements.size(), whole.elements.size());
  EXPECT_EQ(cut.patches, whole.patches);
  std::uint64_t different = 0;
  for (std::size_t k = 0; k < cut.elements.size(); ++k) {
    const Element &a = cut.elements[k], &b = whole.elements[k];
    different += a.polygon.vertices() != b.polygon.vertices() || a.patch != b.patch || a.cell != b.cell;
  }
  EXPECT_TRUE(all_agree(different, cut.elements.size()));
  EXPECT_GT(cut.contacts.size(), 20u) << "its walls stand on the borders of its faces";
}

}  // namespace
}  // namespace etendue::validation
