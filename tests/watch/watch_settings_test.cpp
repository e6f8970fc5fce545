#include "berth/watch/watch_settings.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr double kNotTold = std::numeric_limits<double>::quiet_NaN();

std::string message_for(const std::function<void(WatchSettings&)>& spoil) {
  WatchSettings settings;
  spoil(settings);
  return error_message<std::invalid_argument>([&] { validate(settings); });
}

TEST(WatchSettings, AreOffAndValidByDefault) {
  EXPECT_NO_THROW(validate(WatchSettings{}));
  EXPECT_FALSE(WatchSettings{}.is_on());
  EXPECT_TRUE(WatchSettings{.max_seen_through = 0.1}.is_on());
  EXPECT_TRUE(WatchSettings{.max_displacement_m = 0.1}.is_on());
}

TEST(WatchSettings, EachKeyOutsideItsDomainIsNamed) {
  using Settings = WatchSettings;
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"watch.max_seen_through: -0.1", [](Settings& s) { s.max_seen_through = -0.1; }},
      {"watch.max_seen_through: 1.1", [](Settings& s) { s.max_seen_through = 1.1; }},
      {"watch.max_displacement_m: nan", [](Settings& s) { s.max_displacement_m = kNotTold; }},
      {"watch.agreeing_frames: 0", [](Settings& s) { s.agreeing_frames = 0; }},
      {"more than half of watch.frames, 15, and no more than all",
       [](Settings& s) { s.agreeing_frames = 7; }},
      {"watch.agreeing_frames: 16", [](Settings& s) { s.agreeing_frames = 16; }},
  };
  for (const auto& [expected, spoil] : cases) {
    EXPECT_NE(message_for(spoil).find(expected), std::string::npos)
        << expected << " not in: " << message_for(spoil);
    EXPECT_NE(message_for(spoil).find("expected"), std::string::npos);
  }
}

TEST(LearnedLimits, LieAboveTheGreatestValueThatWasSeen) {
  const WatchSettings settings =
      learned_limits(std::vector{0.01, kNotTold, 0.04, 0.02}, std::vector{0.002, 0.016, kNotTold});
  EXPECT_DOUBLE_EQ(settings.max_seen_through, 0.09);
  EXPECT_DOUBLE_EQ(settings.max_displacement_m, 0.024);
  EXPECT_NO_THROW(validate(settings));
}

TEST(LearnedLimits, LeaveRoomForAPersonWhereLittleWasSeen) {
  const WatchSettings settings = learned_limits(std::vector{0.001}, std::vector{0.001});
  EXPECT_DOUBLE_EQ(settings.max_seen_through, 0.03);
  EXPECT_DOUBLE_EQ(settings.max_displacement_m, 0.008);
}

TEST(LearnedLimits, AreOffWhereNothingWasSeen) {
  EXPECT_FALSE(learned_limits({}, {}).is_on());
  EXPECT_FALSE(learned_limits(std::vector{kNotTold}, std::vector{kNotTold}).is_on());
  EXPECT_DOUBLE_EQ(learned_limits(std::vector{0.9}, {}).max_seen_through, 1)
      << "which no frame exceeds: valid, and no alarm";
}

}  // namespace
}  // namespace berth
