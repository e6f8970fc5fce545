#include <string>

#include "berth/control/velocity_filter.hpp"
#include "berth/types/closest_pair.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/separation.hpp"
#include "berth/types/status.hpp"
#include "berth/types/verdict.hpp"
#include "bindings.hpp"

namespace berth::python {
namespace {

namespace py = pybind11;

/// An enum of Python whose members have the names that berth writes everywhere.
template <class Enum, std::size_t N>
void bind_enum(py::module_& m, const char* name, const std::array<std::string_view, N>& names,
               const char* what) {
  py::enum_<Enum> bound(m, name, what);
  for (std::size_t i = 0; i < N; ++i) {
    bound.value(std::string(names[i]).c_str(), static_cast<Enum>(i));
  }
}

}  // namespace

void bind_statuses(py::module_& m) {
  bind_enum<ResultStatus>(m, "ResultStatus", kResultStatusNames, "How good a whole result is.");
  bind_enum<LinkStatus>(m, "LinkStatus", kLinkStatusNames, "What is known of a link's distance.");
  bind_enum<TimeStatus>(m, "TimeStatus", kTimeStatusNames,
                        "Whether stamps, joints and cameras allow a result.");
  bind_enum<CameraStatus>(m, "CameraStatus", kCameraStatusNames,
                          "What became of a camera in a request.");
  bind_enum<ObstacleKind>(m, "ObstacleKind", kObstacleKindNames,
                          "Whether an obstacle's point is occupied, or unknown.");
  bind_enum<SeparationState>(m, "SeparationState", kSeparationStateNames,
                             "Whether the robot may go on.");
  bind_enum<SeparationReason>(m, "SeparationReason", kSeparationReasonNames,
                              "What keeps the robot from going faster.");
  bind_enum<SeparationBasis>(m, "SeparationBasis", kSeparationBasisNames,
                             "What the scale of the speed was shown by.");
  bind_enum<RowKind>(m, "RowKind", kRowKindNames, "Which pair of a link a row is about.");
  bind_enum<FilterStatus>(m, "FilterStatus", kFilterStatusNames,
                          "Why a filtered velocity is what it is.");
  bind_enum<Verdict>(m, "Verdict", kVerdictNames,
                     "What is known of a configuration or a motion of the robot.");
  bind_enum<PixelFate>(m, "PixelFate", kPixelFateNames,
                       "What became of a pixel: the numbers in Frame.fate.");
}

}  // namespace berth::python
