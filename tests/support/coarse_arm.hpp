// The bundled arm of a tenth of its triangles, for tests that draw it a thousand times.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace berth::testing {

/// A binary STL in which all corners in a cube of 15 mm are one of them, so that cylinders are off
/// by a millimetre.
inline std::string coarse_stl(const std::string& fine) {
  constexpr float kCube_m = 0.015F;
  constexpr std::size_t kHeader = 84, kTriangle = 50, kNormal = 12;
  using Corner = std::array<float, 3>;
  std::map<std::array<int, 3>, Corner> kept;
  std::string coarse = fine.substr(0, kHeader);
  for (std::size_t at = kHeader; at + kTriangle <= fine.size(); at += kTriangle) {
    std::string triangle = fine.substr(at, kTriangle);
    std::array<Corner, 3> corners;
    std::memcpy(&corners, triangle.data() + kNormal, sizeof corners);
    for (Corner& p : corners) {
      std::array<int, 3> cube;
      for (int i = 0; i < 3; ++i) cube[i] = static_cast<int>(std::floor(p[i] / kCube_m));
      p = kept.emplace(cube, p).first->second;
    }
    if (std::set<Corner>(corners.begin(), corners.end()).size() < 3) continue;
    std::memcpy(triangle.data() + kNormal, &corners, sizeof corners);
    coarse += triangle;
  }
  const auto count = static_cast<std::uint32_t>((coarse.size() - kHeader) / kTriangle);
  std::memcpy(coarse.data() + kHeader - sizeof count, &count, sizeof count);
  return coarse;
}

/// Holds arm.urdf and its meshes until the program ends; made at the first call. `fine` is the
/// folder of the bundled arm.
inline const std::filesystem::path& coarse_arm_folder(const std::filesystem::path& fine) {
  static const TemporaryFolder folder;
  if (!folder.names().empty()) return folder.path();
  std::filesystem::copy(fine / "arm.urdf", folder / "arm.urdf");
  for (const auto& mesh : std::filesystem::directory_iterator(fine / "meshes")) {
    std::ifstream in(mesh.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    folder.write("meshes/" + mesh.path().filename().string(), coarse_stl(bytes));
  }
  return folder.path();
}

}  // namespace berth::testing
