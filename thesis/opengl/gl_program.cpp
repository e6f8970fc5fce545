#include "thesis/opengl/gl_program.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace berth {
namespace {

GLuint compile(GLenum stage, std::string_view file, const std::string& source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::array<char, 4096> log{};
  glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
  glDeleteShader(shader);
  throw std::runtime_error(fmt::format("OpenGL: shader {}: {}", file, log.data()));
}

bool is_image(GLenum type) { return type == GL_IMAGE_2D || type == GL_UNSIGNED_INT_IMAGE_2D; }

bool is_sampler(GLenum type) { return type == GL_SAMPLER_2D || type == GL_UNSIGNED_INT_SAMPLER_2D; }

GLenum sampler_type(GlPixel pixel) {
  return pixel == GlPixel::depth_m ? GL_SAMPLER_2D : GL_UNSIGNED_INT_SAMPLER_2D;
}

GLenum image_type(GlPixel pixel) {
  return pixel == GlPixel::depth_m ? GL_IMAGE_2D : GL_UNSIGNED_INT_IMAGE_2D;
}

GLenum image_format(GLenum type) { return type == GL_IMAGE_2D ? GL_R32F : GL_R32UI; }

}  // namespace

GlProgram::GlProgram(std::string_view compute_file, const ShaderConstants& constants)
    : title_(compute_file), source_(shader_source(compute_file, constants)) {
  link({compile(GL_COMPUTE_SHADER, compute_file, source_)});
}

GlProgram::GlProgram(std::string_view vertex_file, std::string_view fragment_file,
                     const ShaderConstants& constants)
    : title_(fmt::format("{} and {}", vertex_file, fragment_file)) {
  const std::string vertex = shader_source(vertex_file, constants);
  const std::string fragment = shader_source(fragment_file, constants);
  source_ = vertex + fragment;
  link({compile(GL_VERTEX_SHADER, vertex_file, vertex),
        compile(GL_FRAGMENT_SHADER, fragment_file, fragment)});
}

GlProgram::~GlProgram() { glDeleteProgram(name_); }

void GlProgram::link(std::initializer_list<unsigned> shaders) {
  name_ = glCreateProgram();
  for (const GLuint shader : shaders) glAttachShader(name_, shader);
  glLinkProgram(name_);
  for (const GLuint shader : shaders) glDeleteShader(shader);
  GLint linked = GL_FALSE;
  glGetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (!linked) {
    std::array<char, 4096> log{};
    glGetProgramInfoLog(name_, log.size(), nullptr, log.data());
    throw std::runtime_error(fmt::format("OpenGL: shader {}: {}", title_, log.data()));
  }
  find_uniforms();
  find_blocks();
}

void GlProgram::find_uniforms() {
  GLint count = 0;
  glGetProgramInterfaceiv(name_, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
  int samplers = 0;
  int images = 0;
  for (GLint i = 0; i < count; ++i) {
    constexpr std::array<GLenum, 3> kAsked = {GL_TYPE, GL_LOCATION, GL_BLOCK_INDEX};
    std::array<GLint, 3> got{};
    glGetProgramResourceiv(name_, GL_UNIFORM, i, kAsked.size(), kAsked.data(), got.size(), nullptr,
                           got.data());
    if (got[2] >= 0) continue;
    std::array<char, 128> name{};
    glGetProgramResourceName(name_, GL_UNIFORM, i, name.size(), nullptr, name.data());
    const auto type = static_cast<GLenum>(got[0]);
    const int unit = is_sampler(type) ? samplers++ : is_image(type) ? images++ : -1;
    if (unit >= 0) glProgramUniform1i(name_, got[1], unit);
    inputs_.push_back({name.data(), type, got[1], unit});
  }
}

void GlProgram::find_blocks() {
  GLint count = 0;
  glGetProgramInterfaceiv(name_, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
  for (GLint i = 0; i < count; ++i) {
    std::array<char, 128> name{};
    glGetProgramResourceName(name_, GL_SHADER_STORAGE_BLOCK, i, name.size(), nullptr, name.data());
    glShaderStorageBlockBinding(name_, i, i);
    inputs_.push_back({name.data(), GL_SHADER_STORAGE_BLOCK, i, -1});
  }
}

GlProgram::Input* GlProgram::find(std::string_view name, unsigned type) {
  const auto found = std::find_if(inputs_.begin(), inputs_.end(),
                                  [&](const Input& input) { return input.name == name; });
  if (found == inputs_.end() && source_.find(name) != std::string::npos) return nullptr;
  if (found == inputs_.end() || found->type != type) {
    throw std::logic_error(fmt::format("shader {} has no input \"{}\" of this type", title_, name));
  }
  found->is_set = true;
  return &*found;
}

void GlProgram::set(std::string_view uniform, int value) {
  if (Input* input = find(uniform, GL_INT)) glProgramUniform1i(name_, input->place, value);
}

void GlProgram::set(std::string_view uniform, unsigned value) {
  if (Input* input = find(uniform, GL_UNSIGNED_INT)) {
    glProgramUniform1ui(name_, input->place, value);
  }
}

void GlProgram::set(std::string_view uniform, float value) {
  if (Input* input = find(uniform, GL_FLOAT)) glProgramUniform1f(name_, input->place, value);
}

void GlProgram::set(std::string_view uniform, double value) {
  if (Input* input = find(uniform, GL_DOUBLE)) glProgramUniform1d(name_, input->place, value);
}

void GlProgram::set(std::string_view uniform, const Eigen::Vector2i& value) {
  if (Input* input = find(uniform, GL_INT_VEC2)) {
    glProgramUniform2iv(name_, input->place, 1, value.data());
  }
}

void GlProgram::set(std::string_view uniform, const Eigen::Vector4f& value) {
  if (Input* input = find(uniform, GL_FLOAT_VEC4)) {
    glProgramUniform4fv(name_, input->place, 1, value.data());
  }
}

void GlProgram::set(std::string_view uniform, const Eigen::Vector2d& value) {
  if (Input* input = find(uniform, GL_DOUBLE_VEC2)) {
    glProgramUniform2dv(name_, input->place, 1, value.data());
  }
}
void GlProgram::set(std::string_view uniform, const Eigen::Vector4d& value) {
  if (Input* input = find(uniform, GL_DOUBLE_VEC4)) {
    glProgramUniform4dv(name_, input->place, 1, value.data());
  }
}

void GlProgram::set(std::string_view uniform, const Eigen::Matrix4f& value) {
  if (Input* input = find(uniform, GL_FLOAT_MAT4)) {
    glProgramUniformMatrix4fv(name_, input->place, 1, GL_FALSE, value.data());
  }
}

void GlProgram::read(std::string_view sampler, const GlTexture& texture) {
  if (Input* input = find(sampler, sampler_type(texture.pixel()))) input->object = texture.name();
}

void GlProgram::write(std::string_view image, const GlTexture& texture) {
  if (Input* input = find(image, image_type(texture.pixel()))) input->object = texture.name();
}

void GlProgram::bind(std::string_view block, const GlBuffer& buffer) {
  if (Input* input = find(block, GL_SHADER_STORAGE_BLOCK)) input->object = buffer.name();
}

void GlProgram::apply() {
  glUseProgram(name_);
  for (const Input& input : inputs_) {
    if (!input.is_set) {
      throw std::logic_error(fmt::format("shader {}: input \"{}\" is not set", title_, input.name));
    }
    if (input.type == GL_SHADER_STORAGE_BLOCK) {
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, input.place, input.object);
    } else if (is_sampler(input.type)) {
      glBindTextureUnit(input.unit, input.object);
    } else if (is_image(input.type)) {
      glBindImageTexture(input.unit, input.object, 0, GL_FALSE, 0, GL_READ_WRITE,
                         image_format(input.type));
    }
  }
}

void GlProgram::dispatch(int groups_x, int groups_y, int groups_z) {
  apply();
  glDispatchCompute(groups_x, groups_y, groups_z);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                  GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void GlProgram::use() { apply(); }

}  // namespace berth
