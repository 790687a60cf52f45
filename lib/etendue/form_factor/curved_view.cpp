// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/curved_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

/// Where a blocker stands on the patch the two are equally far but for rounding.
constexpr double kTouchingDepth = 1 + 0x1p-30;

/// A closed form takes some fifty roundings; what crossings err by moves two pieces alike. Each of the pieces has a share
/// of at most 1.
constexpr double kPieceRounding = 256 * kUnitRoundoff;

class View {
 public:
  View(const Vec3& normal, const ViewBody& patch, const std::vector<ViewBody>& blockers)
      : normal_(normal), patch_(patch), blockers_(blockers) {}

  Bounded factor() {
    const bool cut = patch_.dips_below(normal_);
    for (const ViewCurve& curve : patch_.outline()) add_pieces(curve, &patch_, cut);
    for (const ViewBody& blocker : blockers_) {
      for (const ViewCurve& curve : blocker.outline()) add_pieces(curve, &blocker, cut);
    }
    if (cut) {
      std::vector<ViewCurve> horizon;
      const TangentFrame frame = tangent_frame(normal_);
      ViewCurve::add_arc(Vec3::Zero(), frame.v, frame.u, 0, 2 * std::numbers::pi, horizon);
      for (const ViewCurve& curve : horizon) add_pieces(curve, nullptr, false);
    }
    // 0 ≤ F ≤ 1 holds for the truth: moving the value there only brings it nearer.
    return {std::clamp(sum_, 0.0, 1.0), bound_};
  }

 private:
  // `owner`: null for the horizon.
  void add_pieces(const ViewCurve& curve, const ViewBody* owner, bool cut_by_horizon) {
    cuts_.clear();
    if (cut_by_horizon) curve.cut_by_plane(normal_, cuts_);
    if (owner != &patch_) patch_.cut(curve, cuts_);
    for (const ViewBody& blocker : blockers_) {
      if (&blocker != owner) blocker.cut(curve, cuts_);
    }
    std::sort(cuts_.begin(), cuts_.end());
    cuts_.push_back(curve.end());
    // Neighbouring pieces of one kind are added as one.
    double from = curve.begin(), since = from;
    int kind = 0;
    for (const double to : cuts_) {
      if (!(to > from)) continue;
      const int next = sign(curve, 0.5 * (from + to), owner);
      if (next != kind) {
        add(curve, since, from, kind);
        since = from;
        kind = next;
      }
      from = to;
    }
    add(curve, since, from, kind);
  }

  void add(const ViewCurve& curve, double from, double to, int kind) {
    if (kind == 0 || !(to > from)) return;
    const double share = curve.share(from, to, normal_);
    sum_ += kind * share;
    bound_ += kPieceRounding + kViewOffset * kViewOffset;
  }

  // 1 where what is seen lies to the left of the curve only, −1 where to the right only, else 0.
  int sign(const ViewCurve& curve, double x, const ViewBody* owner) const {
    const Vec3 w = curve.direction(x).normalized();
    const Vec3 step = kViewOffset * curve.tangent(x).cross(w).normalized();
    const Vec3 left = w + step, right = w - step;
    if (owner == nullptr) return seen(left) && patch_.depth(right) < ViewBody::kNothing ? 1 : 0;
    if (owner == &patch_) {
      const double depth = patch_.depth(left);
      return above(left) && open(left, depth < ViewBody::kNothing ? depth : owner->distance(curve, x), nullptr) ? 1 : 0;
    }
    const double behind = patch_.depth(left), beside = patch_.depth(right);
    if (!(beside < ViewBody::kNothing) || !(behind < ViewBody::kNothing) || !above(right)) return 0;
    if (owner->distance(curve, x) > std::max(behind, beside) * kTouchingDepth) return 0;
    if (!open(right, beside, owner)) return 0;
    return counted_before(left, right, behind, beside, owner) ? 0 : -1;
  }

  bool above(const Vec3& w) const { return w.dot(normal_) > 0; }
  bool seen(const Vec3& w) const {
    const double depth = patch_.depth(w);
    return depth < ViewBody::kNothing && open(w, depth, nullptr);
  }
  bool open(const Vec3& w, double depth, const ViewBody* except) const {
    for (const ViewBody& blocker : blockers_) {
      if (&blocker != except && blocker.depth(w) < depth) return false;
    }
    return true;
  }
  /// Has a blocker with the same outline here counted it already?
  bool counted_before(const Vec3& left, const Vec3& right, double behind, double beside, const ViewBody* owner) const {
    for (const ViewBody& blocker : blockers_) {
      if (&blocker == owner) return false;
      if (blocker.depth(left) < behind && !(blocker.depth(right) < beside)) return true;
    }
    return false;
  }

  const Vec3 normal_;
  const ViewBody& patch_;
  const std::vector<ViewBody>& blockers_;
  std::vector<double> cuts_;
  double sum_ = 0, bound_ = 0;
};

}  // namespace

Bounded visible_point_to_patch(const Vec3& point, const Vec3& normal, const CurvedPatch& patch,
                               std::span<const CurvedBlocker* const> blockers) {
  require(point.allFinite(), "visible_point_to_patch: the point is finite");
  require(is_unit_normal(normal), "visible_point_to_patch: normal is a unit vector");
  const auto body = ViewBody::seen(patch, point);
  if (!body || !body->may_be_above(normal)) return {0, 0};
  std::vector<ViewBody> all, near;
  for (const CurvedBlocker* blocker : blockers) {
    if (!ViewBody::add(*blocker, point, all)) return {0, 0};
  }
  for (ViewBody& blocker : all) {
    if (blocker.may_be_above(normal) && blocker.may_overlap(*body)) near.push_back(std::move(blocker));
  }
  return View(normal, *body, near).factor();
}

}  // namespace etendue
