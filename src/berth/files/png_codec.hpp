// Inside files/ only: grayscale PNG files as numbers, with libspng.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

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
