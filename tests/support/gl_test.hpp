#pragma once

#include <gtest/gtest.h>

#include "tests/support/shared_gl.hpp"

namespace berth::testing {

/// A test that needs OpenGL 4.5: it skips, visibly, where there is none, and fails where OpenGL
/// reported an error.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!shared_gl()) GTEST_SKIP() << why_no_gl();
    context().make_current();
  }
  void TearDown() override {
    if (shared_gl()) context().check("this test");
  }
  static GlContext& context() { return shared_gl()->context; }
};

}  // namespace berth::testing
