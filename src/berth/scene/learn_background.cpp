#include "berth/scene/learn_background.hpp"

#include "berth/pipeline/observer.hpp"

namespace berth {

void learn_background(const OpenCamera& camera, const std::function<void()>& before_image,
                      const std::function<void(DepthView, const Frame&)>& learn) {
  Observer observer(camera.view);
  Frame frame;
  for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
    before_image();
    const DepthImage depth_m = camera.read_depth(k);
    observer.observe(depth_m, camera.at_exposure[k], frame, camera.exposure_time[k]);
    observer.finish_watch(frame);
    learn(depth_m, frame);
  }
}

}  // namespace berth
