// berth's methods on OpenGL.
#include <optional>

#include "lab/bench/peer.hpp"
#include "thesis/opengl/gl_evaluate.hpp"

namespace berth::lab {
namespace {

class GlPeer : public Peer {
 public:
  explicit GlPeer(Method method) : method_(method) {}

  std::string name() const override { return "berth " + std::string(name_of(method_)); }
  std::string lacks() const override {
    return method_ == Method::gl_exact ? "" : "certainty: misses what its lattice does";
  }
  bool has_company() const override { return true; }

  void load(const BenchScene& scene) override {
    images_.emplace(scene.camera.width_px, scene.camera.height_px);
  }

  void prepare(const BenchScene& scene) override {
    images_->upload.send(scene.obstacle_depth_m, images_->obstacle_depth_m);
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    ImageDistanceSettings settings;
    settings.range_m = scene.range_m;
    settings.mean_direction = false;
    images_->upload.send(scene.robot, images_->robot);
    evaluator_.evaluate(method_, scene.camera, images_->robot, images_->obstacle_depth_m,
                        scene.link_count, settings, answer_);
    distances_m.clear();
    for (const LinkDistance& link : answer_.links) {
      distances_m.push_back(link.status == LinkStatus::ok ? std::optional(link.distance_m)
                                                          : std::nullopt);
    }
  }

 private:
  Method method_;
  std::optional<GlUploadedImages> images_;
  GlEvaluator evaluator_;
  LinkDistances answer_;
};

}  // namespace

std::vector<std::unique_ptr<Peer>> make_gl_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  for (const Method method : kMethods) {
    if (runs_on_opengl(method)) peers.push_back(std::make_unique<GlPeer>(method));
  }
  return peers;
}

}  // namespace berth::lab
