// The shaders of shaders/*.glsl, compiled into the library.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace berth {

/// A constant of a shader: its name and value, as `#define` takes them.
using ShaderConstants = std::vector<std::pair<std::string, std::string>>;

/// All of one shader as OpenGL takes it: the version, the constants, then the file with its
/// `#include "other.glsl"` lines replaced by those files. An unknown file is a programming error.
std::string shader_source(std::string_view file, const ShaderConstants& constants = {});

/// The files that are shaders of their own (.vert.glsl, .frag.glsl, .comp.glsl).
std::vector<std::string_view> shader_files();

}  // namespace berth
