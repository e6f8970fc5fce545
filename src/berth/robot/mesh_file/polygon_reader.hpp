// Inside robot/mesh_file/ only.
#pragma once

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>

#include <string>
#include <utility>

#include "berth/robot/mesh_file/obj_polygons.hpp"

namespace berth {

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

}  // namespace berth
