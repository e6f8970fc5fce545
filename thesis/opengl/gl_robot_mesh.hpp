#pragma once

#include <Eigen/Core>
#include <vector>

#include "berth/robot/robot_model.hpp"
#include "thesis/opengl/gl_buffer.hpp"

namespace berth {

/// The robot's triangles on the GPU, uploaded once.
class GlRobotMesh {
 public:
  struct Link {
    /// In RobotModel::links and RobotPose::X_BL.
    std::size_t link_index;
    LinkId id;
    /// surface_centre_m of its mesh, in its own frame L.
    Eigen::Vector4f centre_L_m;
    /// Its vertices.
    int first;
    int count;
  };

  /// Leaves out ignored links and links without geometry.
  explicit GlRobotMesh(const RobotModel& model);
  ~GlRobotMesh();
  GlRobotMesh(const GlRobotMesh&) = delete;
  GlRobotMesh& operator=(const GlRobotMesh&) = delete;

  /// Least id first, environment last.
  const std::vector<Link>& links() const { return links_; }

  /// The next draw calls take their vertices from here.
  void use() const;
  /// Draws one link with the program that is in use.
  static void draw(const Link& link);

 private:
  std::vector<Link> links_;
  GlBuffer vertices_;
  unsigned array_ = 0;
};

}  // namespace berth
