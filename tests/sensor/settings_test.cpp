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
  EXPECT_EQ((SensorSettings{.speckle_px = 1, .average_frames = 1}.first_rule()), "");
  EXPECT_EQ((SensorSettings{.speckle_px = 2, .average_frames = 2}.first_rule()), "speckle_px");
  EXPECT_EQ((SensorSettings{.average_frames = 2}.first_rule()), "average_frames");
  EXPECT_EQ((SensorSettings{.background_frames = 1}.first_rule()), "background_frames");
}

TEST(SensorSettings, DefaultsAreValid) { EXPECT_NO_THROW(validate(SensorSettings{})); }

TEST(SensorSettings, EachKeyOutsideItsDomainIsNamed) {
  using Settings = SensorSettings;
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"sensor.noise_m: -0.1; expected", [](Settings& s) { s.noise_m = -0.1; }},
      {"sensor.speckle_px: -1; expected", [](Settings& s) { s.speckle_px = -1; }},
      {"sensor.noise_m: inf; expected",
       [](Settings& s) { s.noise_m = std::numeric_limits<double>::infinity(); }},
      {"sensor.average_frames: -1; expected", [](Settings& s) { s.average_frames = -1; }},
      {"sensor.average_frames: 101; expected a whole number from 0 to 100",
       [](Settings& s) { s.average_frames = 101; }},
      {"sensor.background_frames: -2; expected", [](Settings& s) { s.background_frames = -2; }},
      {"sensor.background_clearance_m: nan; expected",
       [](Settings& s) { s.background_clearance_m = std::numeric_limits<double>::quiet_NaN(); }},
  };
  for (const auto& [expected, spoil] : cases) {
    EXPECT_NE(message_for(spoil).find(expected), std::string::npos)
        << expected << " not in: " << message_for(spoil);
  }
}

}  // namespace
}  // namespace berth
