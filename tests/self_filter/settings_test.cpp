#include "berth/self_filter/settings.hpp"
#include "tests/support/error_message.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace berth {
namespace {

std::string message_for(const std::function<void(SelfFilterSettings&)>& spoil) {
  SelfFilterSettings settings;
  spoil(settings);
  return error_message<std::invalid_argument>([&] { validate(settings); });
}

TEST(SelfFilterSettings, DefaultsAreValid) { EXPECT_NO_THROW(validate(SelfFilterSettings{})); }

TEST(SelfFilterSettings, EachKeyOutsideItsDomainIsNamed) {
  using Settings = SelfFilterSettings;
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"tolerance_m: -0.1", [](Settings& s) { s.tolerance_m = -0.1; }},
      {"tolerance_per_m2: inf",
       [](Settings& s) { s.tolerance_per_m2 = std::numeric_limits<double>::infinity(); }},
      {"padding_m: nan",
       [](Settings& s) { s.padding_m = std::numeric_limits<double>::quiet_NaN(); }},
      {"link_padding_m: -0.5",
       [](Settings& s) {
         s.link_padding_m = {0.1, -0.5};
       }},
      {"surface_tolerance_m: -1", [](Settings& s) { s.surface_tolerance_m = -1; }},
      {"flying_patch_radius_m: -1", [](Settings& s) { s.flying_patch_radius_m = -1; }},
      {"robot_region_scale: 0.99", [](Settings& s) { s.robot_region_scale = 0.99; }},
  };
  for (const auto& [expected, spoil] : cases) {
    EXPECT_NE(message_for(spoil).find(expected), std::string::npos)
        << expected << " not in: " << message_for(spoil);
    EXPECT_NE(message_for(spoil).find("expected"), std::string::npos);
  }
}

}  // namespace
}  // namespace berth
