#include "berth/robot/mesh_file/polygon_reader.hpp"

#include <assimp/scene.h>

#include <algorithm>

namespace berth {

void PolygonReader::InternReadFile(const std::string&, aiScene* scene, Assimp::IOSystem*) {
  // Assimp deletes all of them.
  auto* const mesh = new aiMesh;
  scene->mMeshes = new aiMesh* [1] { mesh };
  scene->mNumMeshes = 1;
  scene->mRootNode = new aiNode;
  scene->mRootNode->mMeshes = new unsigned[1]{0};
  scene->mRootNode->mNumMeshes = 1;
  mesh->mNumVertices = static_cast<unsigned>(polygons_.vertices_m.size());
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  std::transform(polygons_.vertices_m.begin(), polygons_.vertices_m.end(), mesh->mVertices,
                 [](const Eigen::Vector3f& p) { return aiVector3D(p.x(), p.y(), p.z()); });
  mesh->mNumFaces = static_cast<unsigned>(polygons_.faces.size());
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    const std::vector<std::uint32_t>& corners = polygons_.faces[i];
    mesh->mFaces[i].mNumIndices = static_cast<unsigned>(corners.size());
    mesh->mFaces[i].mIndices = new unsigned[corners.size()];
    std::copy(corners.begin(), corners.end(), mesh->mFaces[i].mIndices);
  }
}

}  // namespace berth
