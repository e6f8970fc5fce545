#include "berth/sensor/settings.hpp"
#include "tests/support/error_message.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace berth {
namespace {

std::string message_for(const std::function<void(SensorSettings&)>& spoil) {
  SensorSettings settings;
  spoil(settings);
  return error_message<std::invalid_argument>([&] { validate(settings); });
}

TEST(SensorSettings, TellTheFirstRuleThatIsOn) {
  EXPECT_EQ(SensorSettings{}.first_rule(), "");
  EXPECT_EQ((SensorSettings{.speckle_px = 1}.first_rule()), "");
  EXPECT_EQ((SensorSettings{.speckle_px = 2, .background_frames = 1}.first_rule()), "speckle_px");
  EXPECT_EQ((SensorSettings{.background_frames = 1}.first_rule()), "background_frames");
}

TEST(SensorSettings, DefaultsAreValid) { EXPECT_NO_THROW(validate(SensorSettings{})); }

TEST(SensorSettings, EachKeyOutsideItsDomainIsNamed) {
  using Settings = SensorSettings;
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"sensor.speckle_px: -1; expected", [](Settings& s) { s.speckle_px = -1; }},
      {"sensor.phantom_radius_m: inf; expected",
       [](Settings& s) { s.phantom_radius_m = std::numeric_limits<double>::infinity(); }},
      {"sensor.background_frames: -2; expected", [](Settings& s) { s.background_frames = -2; }},
  };
  for (const auto& [expected, spoil] : cases) {
    EXPECT_NE(message_for(spoil).find(expected), std::string::npos)
        << expected << " not in: " << message_for(spoil);
  }
}

}  // namespace
}  // namespace berth
