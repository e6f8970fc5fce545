#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "thesis/opengl/gl_buffer.hpp"
#include "thesis/opengl/gl_texture.hpp"
#include "thesis/opengl/shader_source.hpp"

namespace berth {

/// Compiled shaders of shaders/ and what they are given. A shader's inputs are declared in its file
/// alone; the program asks OpenGL for their names and types, so that whoever sets one that is not
/// declared, or with another type, gets a std::logic_error, and so does who runs the program before
/// all are set. Values and objects stay set. The objects have to live as long as they are used.
class GlProgram {
 public:
  /// One compute shader. Throws std::runtime_error with the compiler's message.
  GlProgram(std::string_view compute_file, const ShaderConstants& constants);
  explicit GlProgram(std::string_view compute_file) : GlProgram(compute_file, ShaderConstants{}) {}
  /// A vertex and a fragment shader.
  GlProgram(std::string_view vertex_file, std::string_view fragment_file,
            const ShaderConstants& constants);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void set(std::string_view uniform, int value);
  void set(std::string_view uniform, unsigned value);
  void set(std::string_view uniform, float value);
  void set(std::string_view uniform, double value);
  void set(std::string_view uniform, const Eigen::Vector2i& value);
  void set(std::string_view uniform, const Eigen::Vector2d& value);
  void set(std::string_view uniform, const Eigen::Vector4f& value);
  void set(std::string_view uniform, const Eigen::Vector4d& value);
  void set(std::string_view uniform, const Eigen::Matrix4f& value);
  /// A `sampler2D` or `usampler2D`: read without filtering, by texelFetch.
  void read(std::string_view sampler, const GlTexture& texture);
  /// An `image2D` or `uimage2D`.
  void write(std::string_view image, const GlTexture& texture);
  /// A buffer block.
  void bind(std::string_view block, const GlBuffer& buffer);

  /// Runs a compute shader with this many workgroups. What it wrote is visible to all that follows.
  void dispatch(int groups_x, int groups_y = 1, int groups_z = 1);

  /// Makes a vertex and a fragment shader those that draw calls use.
  void use();

 private:
  struct Input {
    std::string name;
    unsigned type;  ///< GL_FLOAT, ..., or GL_SHADER_STORAGE_BLOCK
    int place;      ///< a uniform's location, a block's binding
    int unit;       ///< of a sampler or image
    unsigned object = 0;
    bool is_set = false;
  };

  void link(std::initializer_list<unsigned> shaders);
  void find_uniforms();
  void find_blocks();
  /// Null for an input that is declared and not used: a compiler may leave it out.
  Input* find(std::string_view name, unsigned type);
  void apply();

  unsigned name_ = 0;
  std::string title_;
  std::string source_;
  std::vector<Input> inputs_;
};

}  // namespace berth
