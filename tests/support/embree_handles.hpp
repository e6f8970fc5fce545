#pragma once

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

namespace berth {

struct ReleaseEmbreeDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseEmbreeScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, ReleaseEmbreeDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbreeScene>;

/// Throws std::runtime_error with the device's last error, if there is one.
inline void require_no_embree_error(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree: {}: error {}", doing, static_cast<int>(error)));
}

}  // namespace berth
