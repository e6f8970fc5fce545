// Inside record/ only.
#pragma once

#include <memory>
#include <vector>

#include "berth/pipeline/robot.hpp"
#include "berth/record/mcap_reader.hpp"

namespace berth {

inline constexpr std::string_view kRobotFile = "robot.json";

/// The tree of links, what is attached, and their meshes, without settings.
void append_robot(const Robot& robot, std::vector<mcap::Attachment>& out);

/// The same robot with these settings. Throws as read_cell() does.
std::shared_ptr<const Robot> read_robot(const mcap::FileReader& file,
                                        const EvaluationSettings& settings);

}  // namespace berth
