#include "berth/robot/mesh_file/mesh_file.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/importerdesc.h>
#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "berth/files/file_bytes.hpp"
#include "berth/robot/mesh_file/formats.hpp"

namespace berth {
namespace {

/// Polygons for Assimp to cut into triangles, in the place of a file.
class PolygonReader : public Assimp::BaseImporter {
 public:
  explicit PolygonReader(Polygons polygons) : polygons_(std::move(polygons)) {}

  bool CanRead(const std::string&, Assimp::IOSystem*, bool) const override { return true; }
  const aiImporterDesc* GetInfo() const override { return &kInfo; }

 protected:
  void InternReadFile(const std::string&, aiScene* scene, Assimp::IOSystem*) override;

 private:
  static constexpr aiImporterDesc kInfo{"polygons", "", "", "", 0, 0, 0, 0, 0, "obj"};
  Polygons polygons_;
};

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

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return text;
}

Eigen::Affine3d to_eigen(const aiMatrix4x4& m) {
  Eigen::Affine3d X;
  X.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return X;
}

/// Above what any robot has; a few nodes can repeat a mesh without end.
constexpr std::size_t kMostTriangles = 10'000'000;

TriangleMesh to_mesh(const aiMesh& source) {
  TriangleMesh mesh;
  mesh.vertices_m.reserve(source.mNumVertices);
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D& p = source.mVertices[i];
    mesh.vertices_m.emplace_back(p.x, p.y, p.z);
  }
  mesh.triangles.reserve(source.mNumFaces);
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace& face = source.mFaces[i];
    if (face.mNumIndices == 3)
      mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return mesh;
}

void append_node(const std::filesystem::path& path, const aiScene& scene, const aiNode& node,
                 const Eigen::Affine3d& X_parent, TriangleMesh& mesh) {
  const Eigen::Affine3d X = X_parent * to_eigen(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    if (mesh.triangles.size() + part.mNumFaces > kMostTriangles)
      fail(path, fmt::format("the mesh has more than {} triangles; expected less", kMostTriangles));
    mesh.append(to_mesh(part), X);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    append_node(path, scene, *node.mChildren[i], X, mesh);
}

void require_finite(const std::filesystem::path& path, const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        fail(path, fmt::format("vertex {} is {} {} {}; expected finite numbers", i, p.x, p.y, p.z));
      }
    }
  }
}

void configure(Assimp::Importer& importer) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // Else a file without meshes gets made-up ones.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  // Without normals and texture coordinates the corners that neighbouring triangles share become
  // one.
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
          aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
          aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
}

/// Assimp would follow what a mesh file names, wherever it is.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

/// All but the reader of this ending, which Assimp else tries on a file that that one refuses.
void delete_other_readers(const char* extension, Assimp::Importer& importer) {
  const auto* const kept = importer.GetImporter(importer.GetImporterIndex(extension));
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const other = importer.GetImporter(i);
    if (other == kept) continue;
    importer.UnregisterLoader(other);
    const std::unique_ptr<Assimp::BaseImporter> deleted_here(other);
  }
}

/// In the place of a mesh, a download that failed leaves a web page.
void require_mesh(const std::filesystem::path& path, const std::string& bytes) {
  if (bytes.empty()) fail(path, "the mesh file is empty; expected an STL, OBJ, DAE or glTF file");
  const std::string begin = lower_case(bytes.substr(0, 64));
  if (begin.find("<!doctype html") != std::string::npos || begin.find("<html") != std::string::npos)
    fail(path, "a web page, not a mesh; expected an STL, OBJ, DAE or glTF file");
}

/// Assimp takes compressed or quantised positions for plain ones.
void require_plain_gltf(const std::filesystem::path& path, const std::string& bytes) {
  for (const char* packed :
       {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"}) {
    if (bytes.find(packed) != std::string::npos)
      fail(path, fmt::format("a glTF mesh with {}; expected one without", packed));
  }
}

bool is_gltf(const std::string& extension) { return extension == ".gltf" || extension == ".glb"; }

/// STL, OBJ and DAE are looked into before Assimp gets them.
const aiScene* import(const std::filesystem::path& path, const std::string& extension,
                      Assimp::Importer& importer) {
  std::string bytes = read_file_bytes(path);
  require_mesh(path, bytes);
  if (is_gltf(extension)) require_plain_gltf(path, bytes);
  const bool is_stl = extension == ".stl";
  const bool is_obj = extension == ".obj";
  if (!is_stl && !is_obj && extension != ".dae") return importer.ReadFile(path.string(), 0);
  importer.SetIOHandler(std::make_unique<NoFiles>().release());
  delete_other_readers(is_stl || is_obj ? "" : extension.c_str(), importer);
  if (is_stl || is_obj) {
    Polygons polygons = is_stl ? read_stl_polygons(path, bytes) : read_obj_polygons(path, bytes);
    importer.RegisterLoader(std::make_unique<PolygonReader>(std::move(polygons)).release());
  } else {
    bytes = checked_collada(path, bytes);
  }
  return importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, extension.c_str() + 1);
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& path) {
  Assimp::Importer importer;
  configure(importer);
  const std::string extension = lower_case(path.extension().string());
  const aiScene* scene = import(path, extension, importer);
  // Joining takes a vertex that is NaN for another one: look before.
  if (scene != nullptr) {
    require_finite(path, *scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_RemoveComponent |
                                         aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  }
  if (scene == nullptr)
    fail(path, fmt::format("the mesh cannot be read: {}; expected an STL, OBJ, DAE or glTF file of "
                           "triangles or polygons without holes",
                           importer.GetErrorString()));

  TriangleMesh mesh;
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  if (is_gltf(extension)) X.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (scene->mRootNode != nullptr) append_node(path, *scene, *scene->mRootNode, X, mesh);
  if (mesh.empty()) fail(path, "the mesh has no triangle; expected one at least");
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    if (!mesh.vertices_m[i].allFinite())
      fail(path,
           fmt::format("vertex {} is not finite after its node's transform; expected numbers", i));
  }
  return mesh;
}

}  // namespace berth
