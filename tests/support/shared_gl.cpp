#include "tests/support/shared_gl.hpp"

#include <memory>

namespace berth::testing {
namespace {

struct Attempt {
#if defined(__SANITIZE_THREAD__)
  std::string why_not = "ThreadSanitizer knows nothing of OpenGL's drivers";
#else
  Attempt() {
    try {
      gl = std::make_unique<SharedGl>();
    } catch (const GlUnavailable& error) {
      why_not = error.what();
    }
  }
  std::string why_not;
#endif
  std::unique_ptr<SharedGl> gl;
};

Attempt& attempt() {
  static Attempt once;
  return once;
}

}  // namespace

SharedGl* shared_gl() { return attempt().gl.get(); }

const std::string& why_no_gl() { return attempt().why_not; }

}  // namespace berth::testing
