// Writers of the scene's files. Those that take a path throw std::runtime_error where they cannot
// write.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "lab/bundled_scene/truth.hpp"
#include "sim/bundled_camera.hpp"
#include "sim/motion.hpp"
#include "sim/shapes.hpp"

namespace berth::lab {

/// With all folders above it; nothing happens where it is there already.
void make_folder(const std::filesystem::path& folder);

void write_text(const std::filesystem::path& file, const std::string& text);

/// 16-bit gray.
void write_png(const std::filesystem::path& file, const Image<std::uint16_t>& image);

/// Binary STL, metres.
void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh,
               const std::string& title);

/// ROS camera_info.
std::string camera_info_yaml(const sim::BundledCamera& camera);
/// `evaluation` is the text of the key's value.
std::string scene_yaml(std::span<const sim::BundledCamera> cameras, const std::string& evaluation);
std::string joints_csv(const std::vector<sim::JointRow>& rows);
std::string truth_csv(const std::vector<TruthRow>& rows);

/// The arm on its table; meshes as package://berth_arm/meshes/<link>.stl.
std::string arm_urdf();

}  // namespace berth::lab
