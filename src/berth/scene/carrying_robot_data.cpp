#include "berth/scene/carrying_robot_data.hpp"

#include "berth/render/robot_renderer.hpp"

namespace berth {

CarryingRobotData::CarryingRobotData(const CalibrationData& bare, const AttachedParts& parts,
                                     CarriedParts which)
    : model_(*bare.model), data_(bare) {
  for (const AttachedPart& part : parts.parts) {
    if (part.is_taken || which == CarriedParts::all) {
      model_ = with_attachment(model_, attachment_of(part));
    }
  }
  data_.model = &model_;
  if (model_.links.size() > bare.model->links.size()) data_.meshes = build_link_meshes(model_);
}

}  // namespace berth
