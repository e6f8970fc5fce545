#include "thesis/image_method.hpp"

namespace berth {
namespace {

class MethodOnCpu : public ImageMethod {
 public:
  explicit MethodOnCpu(Method method) : method_(method) {}

  void evaluate(const ImageRequest& request, LinkDistances& out) override {
    berth::evaluate(method_, request, workspace_, out);
  }

 private:
  Method method_;
  EvaluateWorkspace workspace_;
};

}  // namespace

std::unique_ptr<ImageMethod> make_image_method(Method method) {
  require_on_processor(method);
  return std::make_unique<MethodOnCpu>(method);
}

}  // namespace berth
