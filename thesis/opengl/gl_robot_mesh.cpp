#include "thesis/opengl/gl_robot_mesh.hpp"

#include <epoxy/gl.h>

#include <algorithm>

#include "berth/robot/surface.hpp"

namespace berth {
namespace {

struct Vertex {
  Eigen::Vector3f position_L_m;
  Eigen::Vector3f normal_L;
};
static_assert(sizeof(Vertex) == 24);

/// The vertex shader needs all of a triangle's corners, at its last vertex alone: each vertex also
/// gets the two before it. The first has none, hence these.
constexpr std::size_t kPadding = 2;
constexpr GLuint kCorners = 3;

void append(const TriangleMesh& mesh_L, std::vector<Vertex>& vertices) {
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh_L);
  for (const auto& triangle : mesh_L.triangles) {
    for (const std::uint32_t i : triangle) vertices.push_back({mesh_L.vertices_m[i], normals[i]});
  }
}

GlBuffer upload(const std::vector<Vertex>& vertices) {
  const std::size_t bytes = vertices.size() * sizeof(Vertex);
  GlBuffer staging(bytes, GlMemory::upload);
  std::copy(vertices.begin(), vertices.end(), staging.mapped<Vertex>().begin());
  GlBuffer buffer(bytes, GlMemory::device);
  staging.copy_to(buffer, bytes);
  return buffer;
}

}  // namespace

GlRobotMesh::GlRobotMesh(const RobotModel& model) {
  std::vector<Vertex> vertices(kPadding, Vertex{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()});
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const berth::Link& link = model.links[i];
    if (link.role == LinkRole::ignored || link.mesh_L.empty()) continue;
    const auto first = static_cast<int>(vertices.size() - kPadding);
    append(link.mesh_L, vertices);
    const Eigen::Vector3f centre_L_m = surface_centre_m(link.mesh_L).cast<float>();
    links_.push_back({i, link.id, centre_L_m.homogeneous(), first,
                      static_cast<int>(3 * link.mesh_L.triangles.size())});
  }
  std::stable_sort(links_.begin(), links_.end(),
                   [](const Link& a, const Link& b) { return a.id < b.id; });
  vertices_ = upload(vertices);
  glCreateVertexArrays(1, &array_);
  for (GLuint corner = 0; corner < kCorners; ++corner) {
    glVertexArrayVertexBuffer(array_, corner, vertices_.name(), corner * sizeof(Vertex),
                              sizeof(Vertex));
    for (const GLuint part : {0U, 1U}) {
      const GLuint attribute = corner + part * kCorners;
      glEnableVertexArrayAttrib(array_, attribute);
      glVertexArrayAttribFormat(array_, attribute, 3, GL_FLOAT, GL_FALSE,
                                part * sizeof(Eigen::Vector3f));
      glVertexArrayAttribBinding(array_, attribute, corner);
    }
  }
}

GlRobotMesh::~GlRobotMesh() { glDeleteVertexArrays(1, &array_); }

void GlRobotMesh::use() const { glBindVertexArray(array_); }

void GlRobotMesh::draw(const Link& link) { glDrawArrays(GL_TRIANGLES, link.first, link.count); }

}  // namespace berth
