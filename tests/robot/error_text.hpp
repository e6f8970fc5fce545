#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <stdexcept>
#include <string>

namespace berth {

/// Expects that `call` throws an Error whose text holds each of `parts`, and that nothing appears
/// on standard output or standard error meanwhile.
template <typename Error = std::runtime_error, typename Call>
void expect_error(Call&& call, std::initializer_list<std::string> parts) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::string text = "nothing was thrown";
  bool thrown = false;
  try {
    call();
  } catch (const Error& error) {
    text = error.what();
    thrown = true;
  } catch (const std::exception& error) {
    text = std::string("another kind of error: ") + error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(thrown) << text;
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "expected \"" << part << "\" in: " << text;
}

}  // namespace berth
