// Embree's devices and scenes, and triangle meshes in them.
#pragma once

#include <memory>

#include "berth/robot/triangle_mesh.hpp"
#include "berth/types/camera.hpp"
#include "sim/embree.hpp"

namespace berth::sim {

struct ReleaseEmbreeDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseEmbreeScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, ReleaseEmbreeDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbreeScene>;

/// The threads that build a scene's tree. With one thread it is the same on every machine, and so
/// is which of two touching triangles a ray meets; but then TBB runs nothing else of the process in
/// parallel.
enum class EmbreeThreads { all, one };

/// Throws std::runtime_error where Embree fails, as the others here do.
EmbreeDevice make_embree_device(EmbreeThreads threads = EmbreeThreads::all);

/// Throws with the device's last error, if there is one.
void require_no_embree_error(RTCDevice device, const char* doing);

/// Copies the mesh, moved by X, into the scene; `number` is Embree's geomID.
void attach_mesh(RTCDevice device, RTCScene scene, unsigned number, const TriangleMesh& mesh,
                 const Pose& X = Pose::Identity());

/// Builds the scene's tree.
void commit_scene(RTCDevice device, RTCScene scene);

}  // namespace berth::sim
