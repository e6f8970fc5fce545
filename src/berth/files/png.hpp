// Depth and link ID images as PNG files. Other libraries write the same: 16-bit grayscale.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Whether a unit of a depth image can be this length in metres. 1 or 1000 would put a whole room
/// out of every range.
bool is_depth_scale(double depth_scale_m);
constexpr const char* kDepthScaleExpected = "metres per unit from 1e-6 to 0.1, such as 0.001";

/// Depth in metres of a 16-bit grayscale PNG whose unit is `depth_scale_m`: its number times the
/// unit, plus `offset_m`. The numbers 0 and 65535, depths that are not above 0 then, those from
/// kMostReading_m on and those outside [near_m, far_m] become NaN. Throws std::runtime_error where
/// the file is missing, empty, incomplete, damaged, of another pixel format, of another size than
/// the camera's, or the scale is no is_depth_scale.
DepthImage read_depth_png(const std::filesystem::path& file, const Camera& expected_size,
                          double depth_scale_m, double near_m = 0,
                          double far_m = std::numeric_limits<double>::infinity(),
                          double offset_m = 0);

/// Throws as read_depth_png does, but for damage that only decoding finds: in microseconds it
/// reports that the file is there, of the right kind and size, and not cut off.
void check_depth_png(const std::filesystem::path& file, const Camera& expected_size,
                     double depth_scale_m);

/// The link IDs of an 8- or 16-bit grayscale PNG. Throws as read_depth_png does.
Image<LinkId> read_link_ids_png(const std::filesystem::path& file, const Camera& expected_size);

/// Writes 16-bit grayscale in units of `depth_scale_m`, rounded to the nearest unit; NaN becomes 0.
/// A depth is never written as 0 (no reading), which would remove an obstacle: the least is one
/// unit. Depths beyond 65534 units are written as 65534: nearer to the camera than they are, never
/// farther. Throws std::runtime_error where the file cannot be written, which leaves no part of it
/// behind, or the scale is no is_depth_scale.
void write_depth_png(const std::filesystem::path& file, DepthView depth_m, double depth_scale_m);

/// Writes 8-bit grayscale where all IDs fit, else 16-bit. Throws as write_depth_png does.
void write_link_ids_png(const std::filesystem::path& file, ImageView<LinkId> link_id);

/// What a grayscale image of plain numbers may be.
enum class PngDepths { only_16_bit, from_8_to_16_bit };

/// Throws std::runtime_error where the file is missing, no PNG, incomplete, damaged, not grayscale,
/// of another bit depth or of another size than the camera's.
Image<std::uint16_t> read_gray_png(const std::filesystem::path& file, const Camera& expected_size,
                                   PngDepths depths);

/// Throws as read_gray_png does for what the file's first and last bytes tell: all but damage
/// between them.
void check_gray_png(const std::filesystem::path& file, const Camera& expected_size,
                    PngDepths depths);

/// Writes 8 bits for each pixel where `bit_depth` is 8 (no value may be above 255), else 16. Throws
/// std::runtime_error as write_file_bytes does, and for an image without pixels.
void write_gray_png(const std::filesystem::path& file, const Image<std::uint16_t>& image,
                    int bit_depth);

}  // namespace berth
