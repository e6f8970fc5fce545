// Embree 4, or 3, whose rays take a context in place of arguments that may be left out.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace berth::sim {

#if RTC_VERSION_MAJOR >= 4

/// The first hit of one ray.
inline void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray); }

/// Makes `tfar` negative where the ray hits anything.
inline void occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }

/// The first hits of 16 rays that lie close together; those with a 0 in `valid` are left out.
inline void intersect_packet(const int* valid, RTCScene scene, RTCRayHit16& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

#else

inline void intersect(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}

inline void occlude(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}

inline void intersect_packet(const int* valid, RTCScene scene, RTCRayHit16& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
}

#endif

}  // namespace berth::sim
