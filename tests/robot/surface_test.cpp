#include "berth/robot/surface.hpp"

#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"

namespace berth {
namespace {

TriangleMesh box_at(const Eigen::Vector3d& size_m, const Eigen::Vector3d& centre_m) {
  TriangleMesh mesh;
  mesh.append(make_box(size_m), Eigen::Affine3d(Eigen::Translation3d(centre_m)));
  return mesh;
}

TEST(Surface, CentreDoesNotDependOnHowTheSurfaceIsCut) {
  TriangleMesh mesh = box_at({1, 2, 3}, {0.5, -1, 4});
  EXPECT_LT((surface_centre_m(mesh) - Eigen::Vector3d(0.5, -1, 4)).norm(), 1e-6);
  // One triangle in three, which add vertices on one side alone.
  const auto [a, b, c] = mesh.triangles.back();
  const auto middle = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.push_back((mesh.vertices_m[a] + mesh.vertices_m[b] + mesh.vertices_m[c]) / 3);
  mesh.triangles.back() = {a, b, middle};
  mesh.triangles.push_back({b, c, middle});
  mesh.triangles.push_back({c, a, middle});
  EXPECT_LT((surface_centre_m(mesh) - Eigen::Vector3d(0.5, -1, 4)).norm(), 1e-6);
}

TEST(Surface, CentreOfAMeshWithoutAreaIsThatOfItsVertices) {
  const TriangleMesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(surface_centre_m(line), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(surface_centre_m({}), Eigen::Vector3d::Zero());
}

TEST(Surface, ScaledMeshKeepsItsCentre) {
  const Eigen::AlignedBox3f box = scaled(box_at({1, 2, 4}, {3, 0, 0}), 6).bounding_box_m();
  EXPECT_LT((box.min() - Eigen::Vector3f(0, -6, -12)).norm(), 1e-5);
  EXPECT_LT((box.max() - Eigen::Vector3f(6, 6, 12)).norm(), 1e-5);
}

TEST(Surface, NormalsPointOutwardAndAreSharedByVerticesAtOnePlace) {
  const TriangleMesh box = make_box({2, 2, 2});
  TriangleMesh soup;
  for (const auto& triangle : box.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices_m.size());
    for (const std::uint32_t i : triangle) soup.vertices_m.push_back(box.vertices_m[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const std::vector<Eigen::Vector3f> normals = vertex_normals(soup);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals[i].norm(), 1, 1e-6);
    EXPECT_GT(normals[i].dot(soup.vertices_m[i].normalized()), 0.8);
    for (std::size_t k = 0; k < i; ++k) {
      if (soup.vertices_m[i] != soup.vertices_m[k]) continue;
      EXPECT_EQ(normals[i], normals[k]);
    }
  }
}

}  // namespace
}  // namespace berth
