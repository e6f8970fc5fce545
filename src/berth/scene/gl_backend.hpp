// What runs on OpenGL, behind one wall: a build without OpenGL has the wall alone.
#pragma once

#include <memory>
#include <string>

#include "berth/distance/evaluate.hpp"
#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/view.hpp"

namespace berth {

class FramePipeline;

/// Asks frames of this program's memory.
class FrameAsker {
 public:
  virtual ~FrameAsker() = default;
  virtual const Answer& ask(const Frame& frame) = 0;
};

/// One OpenGL context, current in this thread while it lives.
class GlBackend {
 public:
  virtual ~GlBackend() = default;

  virtual std::string renderer() const = 0;
  /// Throws std::runtime_error where OpenGL reported an error since the last call.
  virtual void check(const std::string& what) = 0;
  /// Observes and asks on OpenGL. Throws std::invalid_argument where the view's settings ask for
  /// what runs on the CPU alone.
  virtual std::unique_ptr<FramePipeline> make_pipeline(const std::shared_ptr<const View>& view) = 0;
  virtual std::unique_ptr<FrameAsker> make_asker(const std::shared_ptr<const Robot>& robot) = 0;
  /// As evaluate(), for a method that runs on OpenGL.
  virtual void evaluate(Method method, const Question& question, LinkDistances& out) = 0;
};

/// Throws std::runtime_error where the device, OpenGL or berth's own part for it is not there.
/// `device` is as GlContext takes it.
std::unique_ptr<GlBackend> open_gl_backend(const std::string& device);

}  // namespace berth
