// Inside record/ only: a robot as attachments. Its meshes are binary PLY files, which keep indices
// and every bit of a vertex.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "berth/pipeline/robot.hpp"
#include "berth/record/mcap_reader.hpp"
#include "berth/robot/triangle_mesh.hpp"

namespace berth {

std::string ply_of(const TriangleMesh& mesh);

/// Of what ply_of() wrote. Throws std::runtime_error that says what is wrong.
TriangleMesh mesh_of_ply(std::string_view bytes);

inline constexpr std::string_view kRobotFile = "robot.json";

/// The tree of links, what is attached, and their meshes, without settings.
void append_robot(const Robot& robot, std::vector<mcap::Attachment>& out);

/// The same robot with these settings. Throws as read_cell() does.
std::shared_ptr<const Robot> read_robot(const mcap::FileReader& file,
                                        const EvaluationSettings& settings);

}  // namespace berth
