# cmake -DFOLDER=... -DOUT=... -P embed_shaders.cmake: all *.glsl of the folder as one C++ header.
file(GLOB files ${FOLDER}/*.glsl)
list(SORT files)
set(entries "")
foreach(file ${files})
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND entries "    ShaderText{\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
list(LENGTH files count)
file(WRITE ${OUT}.new "// Made from shaders/*.glsl by embed_shaders.cmake.
#pragma once

#include <array>
#include <string_view>

namespace berth {

struct ShaderText {
  std::string_view file;
  std::string_view text;
};

inline constexpr std::array<ShaderText, ${count}> kShaderTexts{
${entries}};

}  // namespace berth
")
configure_file(${OUT}.new ${OUT} COPYONLY)
