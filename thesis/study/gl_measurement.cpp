#include "thesis/study/gl_measurement.hpp"

#include "lab/measure/stopwatch.hpp"

namespace berth::lab {

Measurement GlMeasurer::measure(const ParameterSet& set, const sim::ImagePair& images,
                                const LinkDistances& truth) {
  const Camera& camera = images.camera;
  if (!uploaded_ || !uploaded_->has_size(camera.width_px, camera.height_px))
    uploaded_.emplace(camera.width_px, camera.height_px);
  uploaded_->upload.send(images.robot, uploaded_->robot);
  uploaded_->upload.send(images.obstacle_depth_m, uploaded_->obstacle_depth_m);
  const auto run_ms = [&] {
    answer_.links.clear();
    const Stopwatch watch;
    evaluator_.evaluate(set.method, camera, uploaded_->robot, uploaded_->obstacle_depth_m,
                        images.link_count, set.settings, answer_);
    return watch.ms();
  };
  run_ms();
  Measurement found;
  found.time_ms = least_ms(run_ms);
  found.pairs = answer_.pairs;
  found.errors = errors_of(truth, answer_, set.settings.range_m);
  context_.check(name_of(set.method));
  return found;
}

}  // namespace berth::lab
