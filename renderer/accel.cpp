// SPDX-License-Identifier: Apache-2.0
#include "renderer/accel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <map>

namespace mms::renderer {

void Crossings::add(const Hit& h) {
  int at = count;
  while (at > 0 && hits[at - 1].t > h.t) --at;
  for (int i = at; i-- > 0 && hits[i].t == h.t;)
    if (hits[i].object == h.object && hits[i].primitive == h.primitive) return;
  if (at == kMaxCrossings) {
    overflow = true;
    return;
  }
  if (count == kMaxCrossings) {
    overflow = true;
    --count;
  }
  for (int i = count; i > at; --i) hits[i] = hits[i - 1];
  hits[at] = h;
  ++count;
}

namespace {

const auto kFlags = RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);

struct Shared {  // what a callback of Embree needs to know of its object
  const Shape* shape = nullptr;
  bool collect = false;
};

struct Context {
  RTCIntersectContext embree;  // first: Embree hands back its address
  Crossings* crossings;
};

Crossings* crossings_of(RTCIntersectContext* c) { return reinterpret_cast<Context*>(c)->crossings; }

Roots roots_of(const Shape& shape, const RTCRay& ray) {
  const Vec3d o{ray.org_x, ray.org_y, ray.org_z}, d{ray.dir_x, ray.dir_y, ray.dir_z};
  return std::visit(
      [&]<class S>(const S& s) -> Roots {
        if constexpr (std::is_same_v<S, Mesh>)
          return {};
        else
          return intersect(s, o, d, ray.tnear, ray.tfar);
      },
      shape);
}

void analytic_bounds(const RTCBoundsFunctionArguments* a) {
  const Bounds b = bounds(*static_cast<const Shared*>(a->geometryUserPtr)->shape);
  constexpr float inf = std::numeric_limits<float>::infinity();
  const auto down = [](double x) { return std::nextafter(float(x), -inf); };
  const auto up = [](double x) { return std::nextafter(float(x), inf); };
  *a->bounds_o = {down(b.low.x), down(b.low.y), down(b.low.z), 0,
                  up(b.high.x),  up(b.high.y),  up(b.high.z),  0};
}

void analytic_intersect(const RTCIntersectFunctionNArguments* a) {
  if (!a->valid[0]) return;
  const Shared& shared = *static_cast<const Shared*>(a->geometryUserPtr);
  auto& ray_hit = *reinterpret_cast<RTCRayHit*>(a->rayhit);
  const Roots roots = roots_of(*shared.shape, ray_hit.ray);
  if (shared.collect) {
    for (int i = 0; i < roots.count; ++i)
      crossings_of(a->context)->add({int(a->geomID), a->primID, float(roots.t[i]), 0, 0});
    return;
  }
  if (roots.count == 0) return;
  ray_hit.ray.tfar = float(roots.t[0]);
  ray_hit.hit.geomID = a->geomID;
  ray_hit.hit.primID = a->primID;
  ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

void analytic_occluded(const RTCOccludedFunctionNArguments* a) {
  if (!a->valid[0]) return;
  const Shared& shared = *static_cast<const Shared*>(a->geometryUserPtr);
  auto& ray = *reinterpret_cast<RTCRay*>(a->ray);
  if (!shared.collect && roots_of(*shared.shape, ray).count > 0)
    ray.tfar = -std::numeric_limits<float>::infinity();
}

/// Of a mesh that several objects share: which one it is says the instance.
void instance_filter(const RTCFilterFunctionNArguments* a) {
  if (!a->valid[0]) return;
  const auto& hit = *reinterpret_cast<const RTCHit*>(a->hit);
  if (!static_cast<const Shared*>(a->geometryUserPtr)[hit.instID[0]].collect) return;
  a->valid[0] = 0;
  const auto& ray = *reinterpret_cast<const RTCRay*>(a->ray);
  if (Crossings* c = crossings_of(a->context))
    c->add({int(hit.instID[0]), hit.primID, ray.tfar, hit.u, hit.v});
}

void collect_filter(const RTCFilterFunctionNArguments* a) {
  if (!a->valid[0]) return;
  a->valid[0] = 0;
  const auto& hit = *reinterpret_cast<const RTCHit*>(a->hit);
  const auto& ray = *reinterpret_cast<const RTCRay*>(a->ray);
  if (Crossings* c = crossings_of(a->context))
    c->add({int(hit.geomID), hit.primID, ray.tfar, hit.u, hit.v});
}

}  // namespace

struct Accel::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Shared> shared;  ///< of each object
  bool any_collected = false;

  std::map<int, RTCScene> meshes;  ///< that several objects share, by the first of them

  RTCGeometry geometry_of(const Mesh& mesh) const {
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
    for (Vec3f v : mesh.positions) *p++ = v.x, *p++ = v.y, *p++ = v.z;
    auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0,
                                                             RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                             mesh.triangles.size()));
    for (const auto& corners : mesh.triangles)
      for (std::uint32_t c : corners) *t++ = c;
    return g;
  }

  void attach(RTCScene to, RTCGeometry g, unsigned id) {
    rtcCommitGeometry(g);
    rtcAttachGeometryByID(to, g, id);
    rtcReleaseGeometry(g);
  }

  /// What stands in the scene for a mesh that is there several times: `o` where `first` is, moved.
  RTCGeometry instance(const Object& o, const Object& first, int number) {
    RTCScene& mesh = meshes[number];
    if (!mesh) {
      mesh = rtcNewScene(device);
      rtcSetSceneFlags(mesh, kFlags);
      RTCGeometry g = geometry_of(std::get<Mesh>(first.shape));
      rtcSetGeometryUserData(g, shared.data());
      rtcSetGeometryIntersectFilterFunction(g, instance_filter);
      rtcSetGeometryOccludedFilterFunction(g, instance_filter);
      attach(mesh, g, 0);
      rtcCommitScene(mesh);
    }
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(g, mesh);
    rtcSetGeometryTimeStepCount(g, 1);
    const auto moved = [&](Vec3d p) { return o.transform.point(first.transform.inverse_point(p)); };
    const Vec3d zero = moved({0, 0, 0});
    float columns[12];
    float* c = columns;
    for (const Vec3d v :
         {moved({1, 0, 0}) - zero, moved({0, 1, 0}) - zero, moved({0, 0, 1}) - zero, zero})
      *c++ = float(v.x), *c++ = float(v.y), *c++ = float(v.z);
    constexpr float kIdentity[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            &o == &first ? kIdentity : columns);
    return g;
  }

  void add(unsigned id, const Object& object, bool collect) {
    const Mesh* mesh = std::get_if<Mesh>(&object.shape);
    RTCGeometry g = mesh ? geometry_of(*mesh) : rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    if (mesh && collect) {
      rtcSetGeometryIntersectFilterFunction(g, collect_filter);
      rtcSetGeometryOccludedFilterFunction(g, collect_filter);
    }
    if (!mesh) {
      rtcSetGeometryUserPrimitiveCount(g, 1);
      rtcSetGeometryUserData(g, &shared[id]);
      rtcSetGeometryBoundsFunction(g, analytic_bounds, nullptr);
      rtcSetGeometryIntersectFunction(g, analytic_intersect);
      rtcSetGeometryOccludedFunction(g, analytic_occluded);
    }
    attach(scene, g, id);
  }
};

namespace {

/// For each object the one whose mesh it shares, itself included; -1 for those that share none.
/// What was displaced is another mesh.
std::vector<int> sharing(const SceneData& scene) {
  std::vector<int> first(scene.objects.size(), -1);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& o = scene.objects[i];
    if (o.instance_of < 0 || o.displaced) continue;
    if (scene.objects[std::size_t(o.instance_of)].displaced) continue;
    first[i] = first[std::size_t(o.instance_of)] = o.instance_of;
  }
  return first;
}

}  // namespace

Accel::Accel(const SceneData& scene, const std::vector<bool>& semi_transparent)
    : state_(std::make_unique<State>()) {
  state_->device = rtcNewDevice(nullptr);
  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, kFlags);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    state_->shared.push_back({&scene.objects[i].shape, semi_transparent[i]});
    state_->any_collected |= semi_transparent[i];
  }
  const std::vector<int> first = sharing(scene);
  for (unsigned i = 0; i < scene.objects.size(); ++i) {
    const Object& o = scene.objects[i];
    if (first[i] < 0)
      state_->add(i, o, semi_transparent[i]);
    else
      state_->attach(state_->scene,
                     state_->instance(o, scene.objects[std::size_t(first[i])], first[i]), i);
  }
  rtcCommitScene(state_->scene);
}

Accel::~Accel() {
  for (const auto& [first, mesh] : state_->meshes) rtcReleaseScene(mesh);
  rtcReleaseScene(state_->scene);
  rtcReleaseDevice(state_->device);
}

bool Accel::any_semi_transparent() const { return state_->any_collected; }

Hit Accel::intersect(Vec3f o, Vec3f d, float t_min, float t_max, Crossings& crossings) const {
  Context context;
  rtcInitIntersectContext(&context.embree);
  context.crossings = &crossings;
  crossings.count = 0;
  crossings.overflow = false;
  RTCRayHit r{};
  r.ray = {o.x, o.y, o.z, t_min, d.x, d.y, d.z, 0, t_max, ~0u, 0, 0};
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &context.embree, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const unsigned object =
      r.hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? r.hit.geomID : r.hit.instID[0];
  const Hit hit{int(object), r.hit.primID, r.ray.tfar, r.hit.u, r.hit.v};
  while (crossings.count > 0 && crossings.hits[crossings.count - 1].t >= hit.t) {
    --crossings.count;
    crossings.overflow = false;  // whatever was dropped lay behind the opaque hit too
  }
  return hit;
}

bool Accel::occluded(Vec3f o, Vec3f d, float t_max) const {
  Context context;
  rtcInitIntersectContext(&context.embree);
  context.crossings = nullptr;
  RTCRay r{o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, t_max, ~0u, 0, 0};
  rtcOccluded1(state_->scene, &context.embree, &r);
  return r.tfar < 0;
}

SurfacePoint surface_of(const SceneData& scene, const Hit& hit, Vec3f origin, Vec3f direction) {
  const Vec3d p = Vec3d(origin) + Vec3d(direction) * double(hit.t);
  const Object& o = scene.objects[hit.object];
  SurfacePoint at = std::visit(
      [&]<class S>(const S& s) {
        if constexpr (std::is_same_v<S, Mesh>)
          return surface_at(s, hit.primitive, hit.u, hit.v);
        else
          return surface_at(s, p);
      },
      o.shape);
  at.error += o.slack;
  return at;
}

}  // namespace mms::renderer
