#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace berth {

/// what() of the Error that `call` throws; empty where it throws none.
template <typename Error = std::runtime_error, typename Call>
std::string error_message(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

inline void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  EXPECT_FALSE(message.empty()) << "no error";
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
  }
}

/// A text that must be refused, and what the message must name.
struct BadText {
  std::string text;
  std::vector<std::string> message_parts;
};

}  // namespace berth
