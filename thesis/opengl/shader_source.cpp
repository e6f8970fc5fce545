#include "thesis/opengl/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "thesis/opengl/shader_texts.hpp"

namespace berth {
namespace {

constexpr std::string_view kInclude = "#include \"";

std::string_view text_of(std::string_view file) {
  const auto found = std::find_if(kShaderTexts.begin(), kShaderTexts.end(),
                                  [&](const ShaderText& text) { return text.file == file; });
  assert(found != kShaderTexts.end());
  return found->text;
}

void append_expanded(std::string_view file, std::string& out) {
  std::string_view rest = text_of(file);
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.starts_with(kInclude)) {
      append_expanded(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()), out);
    } else {
      out.append(line).push_back('\n');
    }
  }
}

}  // namespace

std::string shader_source(std::string_view file, const ShaderConstants& constants) {
  std::string source = "#version 450 core\n";
  for (const auto& [name, value] : constants) source += fmt::format("#define {} {}\n", name, value);
  append_expanded(file, source);
  return source;
}

std::vector<std::string_view> shader_files() {
  std::vector<std::string_view> files;
  for (const ShaderText& text : kShaderTexts) {
    const bool is_stage = text.file.ends_with(".comp.glsl") || text.file.ends_with(".vert.glsl") ||
                          text.file.ends_with(".frag.glsl");
    if (is_stage) files.push_back(text.file);
  }
  return files;
}

}  // namespace berth
