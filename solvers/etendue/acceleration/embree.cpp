// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/embree.hpp"

#include "etendue/core/contract.hpp"

#ifdef ETENDUE_EMBREE
#include <dlfcn.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "etendue/acceleration/bounding_volumes.hpp"
#include "etendue/acceleration/search.hpp"
#include "etendue/acceleration/single_ray.hpp"
#include "etendue/acceleration/wide_tree.hpp"
#endif

namespace etendue {

#ifndef ETENDUE_EMBREE

std::optional<Error> embree_missing() {
  return Error{ErrorCode::usage, "embree: this program was built without it (CMake option ETENDUE_EMBREE)"};
}

std::unique_ptr<const Accelerator> make_embree(const Scene&) {
  require(false, "make_embree: Embree is there");
  return nullptr;
}

#else

namespace {

// The library is opened when it is first wanted: whoever links etendue::solvers needs no Embree.
constexpr const char* kFile = "libembree3.so.3";
/// It builds its tree by itself: our threads are ours.
constexpr const char* kDevice = "threads=1";

/// What is used of Embree, by its own names.
struct Library {
  decltype(&rtcNewDevice) new_device = nullptr;
  decltype(&rtcReleaseDevice) release_device = nullptr;
  decltype(&rtcNewScene) new_scene = nullptr;
  decltype(&rtcReleaseScene) release_scene = nullptr;
  decltype(&rtcSetSceneFlags) set_scene_flags = nullptr;
  decltype(&rtcSetSceneBuildQuality) set_build_quality = nullptr;
  decltype(&rtcNewGeometry) new_geometry = nullptr;
  decltype(&rtcReleaseGeometry) release_geometry = nullptr;
  decltype(&rtcSetNewGeometryBuffer) new_buffer = nullptr;
  decltype(&rtcSetGeometryIntersectFilterFunction) set_intersect_filter = nullptr;
  decltype(&rtcSetGeometryOccludedFilterFunction) set_occluded_filter = nullptr;
  decltype(&rtcCommitGeometry) commit_geometry = nullptr;
  decltype(&rtcAttachGeometry) attach_geometry = nullptr;
  decltype(&rtcCommitScene) commit_scene = nullptr;
  decltype(&rtcIntersect1) intersect1 = nullptr;
  decltype(&rtcOccluded1) occluded1 = nullptr;
  decltype(&rtcGetDeviceError) device_error = nullptr;
  std::optional<Error> missing;
};

Library open_library() {
  Library library;
  void* handle = ::dlopen(kFile, RTLD_NOW | RTLD_LOCAL);  // never closed: it keeps threads of its own
  if (!handle) {
    library.missing = Error{ErrorCode::input_output,
                            std::string("embree: it cannot be opened (Debian: libembree3-3): ") + ::dlerror()};
    return library;
  }
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::decay_t<decltype(function)> >(::dlsym(handle, name));
    if (!function && !library.missing) {
      library.missing = Error{ErrorCode::input_output, std::string("embree: ") + kFile + " has no " + name};
    }
  };
  load(library.new_device, "rtcNewDevice");
  load(library.release_device, "rtcReleaseDevice");
  load(library.new_scene, "rtcNewScene");
  load(library.release_scene, "rtcReleaseScene");
  load(library.set_scene_flags, "rtcSetSceneFlags");
  load(library.set_build_quality, "rtcSetSceneBuildQuality");
  load(library.new_geometry, "rtcNewGeometry");
  load(library.release_geometry, "rtcReleaseGeometry");
  load(library.new_buffer, "rtcSetNewGeometryBuffer");
  load(library.set_intersect_filter, "rtcSetGeometryIntersectFilterFunction");
  load(library.set_occluded_filter, "rtcSetGeometryOccludedFilterFunction");
  load(library.commit_geometry, "rtcCommitGeometry");
  load(library.attach_geometry, "rtcAttachGeometry");
  load(library.commit_scene, "rtcCommitScene");
  load(library.intersect1, "rtcIntersect1");
  load(library.occluded1, "rtcOccluded1");
  load(library.device_error, "rtcGetDeviceError");
  if (library.missing) return library;
  const RTCDevice device = library.new_device(kDevice);
  if (!device) {
    library.missing = Error{ErrorCode::input_output, "embree: it cannot work on this machine (error " +
                                                         std::to_string(library.device_error(nullptr)) + ")"};
  } else {
    library.release_device(device);
  }
  return library;
}

const Library& library() {
  static const Library the_library = open_library();
  return the_library;
}

/// Those of a scene that Embree gets, object by object, and the others.
struct Division {
  std::vector<Surface> triangles, others;

  explicit Division(const Scene& scene) {
    for (const Surface& surface : surfaces(scene)) {
      (triangle_of(scene, surface) ? triangles : others).push_back(surface);
    }
  }
};

class Embree final : public Accelerator {
 public:
  explicit Embree(const Scene& scene) : Embree(scene, Division(scene)) {}
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() override {
    if (scene_) library().release_scene(scene_);
    library().release_device(device_);
  }

  [[nodiscard]] Nearest nearest(const Ray& ray) const override {
    NearestQuery query{{}, *this, SingleRay(ray, exact_.tree()), NearestSearch(scene(), ray), false};
    if (scene_) {
      rtcInitIntersectContext(&query.context);
      RTCRayHit asked{single(query.single, ray.t_max), {}};
      asked.hit.geomID = asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      library().intersect1(scene_, &query.context, &asked);
      if (query.doubtful) return exact_.nearest(ray);
    }
    Nearest answer = query.search.answer();
    if (!has_others_) return answer;
    Nearest other = others_.nearest(ray);
    answer.tests += other.tests;
    if (other.hit && (!answer.hit || precedes(*other.hit, *answer.hit))) answer.hit = other.hit;
    return answer;
  }

  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override {
    Obstruction answer;
    if (has_others_) answer = others_.obstruction(ray);
    if (answer.blocked || !scene_) return answer;
    ObstructionQuery query{{}, *this, ray, SingleRay(ray, exact_.tree()), answer, false};
    rtcInitIntersectContext(&query.context);
    RTCRay asked = single(query.single, ray.t_max);
    library().occluded1(scene_, &query.context, &asked);
    return query.doubtful && !query.answer.blocked ? exact_.obstruction(ray) : query.answer;
  }

 private:
  Embree(const Scene& scene, const Division& division)
      : Accelerator(scene), exact_(scene), others_(scene, division.others), has_others_(!division.others.empty()) {
    device_ = library().new_device(kDevice);
    if (division.triangles.empty()) return;
    members_.reserve(division.triangles.size());
    for (const Surface& surface : division.triangles) {
      const auto triangle = triangle_of(scene, surface);
      members_.push_back({*triangle, surface});
    }
    build();
  }

  /// One geometry, three corners a triangle: those that neighbours share round to the same bits.
  void build() {
    scene_ = library().new_scene(device_);
    library().set_scene_flags(scene_, RTC_SCENE_FLAG_ROBUST);
    library().set_build_quality(scene_, RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry geometry = library().new_geometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corner = static_cast<float*>(library().new_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                            3 * sizeof(float), 3 * members_.size()));
    auto* index = static_cast<unsigned*>(library().new_buffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                              3 * sizeof(unsigned), members_.size()));
    const WideTree& frame = exact_.tree();
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const Triangle& triangle = members_[i].triangle;
      for (const Vec3* point : {&triangle.a, &triangle.b, &triangle.c}) {
        for (int k = 0; k < 3; ++k) *corner++ = to_single(((*point)[k] - frame.middle[k]) * frame.unit);
      }
      for (unsigned k = 0; k < 3; ++k) *index++ = static_cast<unsigned>(3 * i) + k;
    }
    library().set_intersect_filter(geometry, &propose_hit);
    library().set_occluded_filter(geometry, &propose_obstacle);
    library().commit_geometry(geometry);
    library().attach_geometry(scene_, geometry);
    library().release_geometry(geometry);
    library().commit_scene(scene_);
    if (library().device_error(device_) != RTC_ERROR_NONE) throw std::bad_alloc();  // nothing else is left to fail
  }

  static RTCRay single(const SingleRay& from, double t_max) {
    RTCRay ray{};
    const Vec3 origin = from.behind_start(), direction = from.direction();
    ray.org_x = to_single(origin.x());
    ray.org_y = to_single(origin.y());
    ray.org_z = to_single(origin.z());
    ray.dir_x = to_single(direction.x());
    ray.dir_y = to_single(direction.y());
    ray.dir_z = to_single(direction.z());
    ray.tnear = 0;
    ray.tfar = from.from_behind(t_max);
    ray.mask = ~0U;
    return ray;
  }

  struct NearestQuery {
    RTCIntersectContext context;  // Embree hands its address back
    const Embree& self;
    SingleRay single;
    NearestSearch search;
    bool doubtful;
  };
  struct ObstructionQuery {
    RTCIntersectContext context;
    const Embree& self;
    const Ray& ray;
    SingleRay single;
    Obstruction answer;
    bool doubtful;
  };

  /// May a neighbour be what the ray meets? So where the proposal is nearer to an edge than single precision can tell;
  /// elsewhere the ray's line passes through the triangle in full precision, too.
  bool doubtful(const RTCFilterFunctionNArguments& proposal, const SingleRay& ray) const {
    const auto& hit = *reinterpret_cast<const RTCHit*>(proposal.hit);
    const Triangle& triangle = members_[hit.primID].triangle;
    const Vec3 ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, bc = triangle.c - triangle.b;
    const double beta = static_cast<double>(hit.u), gamma = static_cast<double>(hit.v);
    const double longest = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()}));
    const double reach = 4 * ray.margin() / exact_.tree().unit;
    return std::min({beta, gamma, 1 - beta - gamma}) * ab.cross(ac).norm() <= reach * longest;
  }

  /// Whether the proposal is a hit in full precision, and the nearest so far; then what comes later matters only if it
  /// may be as near.
  static void propose_hit(const RTCFilterFunctionNArguments* proposal) {
    auto& query = *reinterpret_cast<NearestQuery*>(proposal->context);
    const auto& member = query.self.members_[reinterpret_cast<const RTCHit*>(proposal->hit)->primID];
    ++query.search.tests().surfaces;
    query.doubtful = query.doubtful || query.self.doubtful(*proposal, query.single);
    const bool nearer = !query.doubtful && query.search.try_triangle(member.triangle, member.surface);
    proposal->valid[0] = nearer ? -1 : 0;
    if (nearer) reinterpret_cast<RTCRay*>(proposal->ray)->tfar = query.single.from_behind(query.search.limit());
  }

  static void propose_obstacle(const RTCFilterFunctionNArguments* proposal) {
    auto& query = *reinterpret_cast<ObstructionQuery*>(proposal->context);
    const auto& member = query.self.members_[reinterpret_cast<const RTCHit*>(proposal->hit)->primID];
    ++query.answer.tests.surfaces;
    query.doubtful = query.doubtful || query.self.doubtful(*proposal, query.single);
    query.answer.blocked = intersect(query.ray, member.triangle).has_value();
    proposal->valid[0] = query.answer.blocked ? -1 : 0;
  }

  BoundingVolumes exact_, others_;
  bool has_others_;
  HugeVector<WideTree::Member> members_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;  // none without triangles
};

}  // namespace

std::optional<Error> embree_missing() {
  return library().missing;
}

std::unique_ptr<const Accelerator> make_embree(const Scene& scene) {
  require(!embree_missing(), "make_embree: Embree is there");
  return std::make_unique<const Embree>(scene);
}

#endif

}  // namespace etendue
