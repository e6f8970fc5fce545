#include "berth/pipeline/mounted_camera.hpp"
#include "bindings.hpp"
#include "settings.hpp"

namespace berth::python {

void bind_all_settings(py::module_& m) {
  bind_settings<SelfFilterSettings>(m, "SelfFilterSettings", "self_filter",
                                    "How much of an image counts as the robot itself.");
  bind_settings<SensorSettings>(m, "SensorSettings", "sensor",
                                "What is known of a camera's faults.");
  bind_settings<SpaceSettings>(m, "SpaceSettings", "space",
                               "What a camera's readings say of free and unknown space.");
  bind_settings<WatchSettings>(m, "WatchSettings", "watch",
                               "When a camera counts as moved or implausible.");
  bind_settings<EvaluationSettings>(m, "EvaluationSettings", "evaluation",
                                    "How distances are looked for.");
  bind_settings<TimeSettings>(m, "TimeSettings", "time", "How old is too old.");
}

}  // namespace berth::python
