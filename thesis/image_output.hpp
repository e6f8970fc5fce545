#pragma once

#include <string>

#include "thesis/image_result.hpp"

namespace berth {

/// result_json() with method, `gl_renderer`, `pairs`, and each link's `robot_pixel` and
/// `robot_pixels`.
std::string image_result_json(const ImageResult& result);

/// The links as a table for people, as result_table().
std::string image_result_table(const ImageResult& result);

/// What a line of result_json() or of image_result_json() may be.
std::string schema_of_all_results();

}  // namespace berth
