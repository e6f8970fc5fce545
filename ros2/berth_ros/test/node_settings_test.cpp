// What a node is told: settings that change while they are read, an SRDF's links, the joints'
// rhythm.
#include "node_settings.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "joint_rhythm.hpp"
#include "srdf.hpp"

namespace berth_ros {
namespace {

std::string written(const std::string& name, const std::string& text) {
  const std::string file = (std::filesystem::temp_directory_path() / name).string();
  std::ofstream(file) << text;
  return file;
}

TEST(NodeSettings, MayBeReadWhileTheyChange) {
  rclcpp::init(0, nullptr);
  SettingNode node("settings");
  NodeSettings settings(node, false);
  std::atomic<bool> is_over = false;
  std::thread reader([&] {
    while (!is_over) {
      const double range_m = settings.evaluation().distance.range_m;
      EXPECT_TRUE(range_m == 0.25 || range_m == 0.5 || range_m == 1.0) << range_m;
      if (const auto separation = settings.separation()) {
        EXPECT_EQ(separation->human_speed_m_s, berth::SeparationSettings{}.human_speed_m_s);
      }
      EXPECT_EQ(settings.cameras().size(), 1u);
    }
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  for (int k = 0; std::chrono::steady_clock::now() < end; ++k) {
    EXPECT_TRUE(settings.take({rclcpp::Parameter("evaluation.range_m", k % 2 ? 0.25 : 0.5),
                               rclcpp::Parameter("separation.monitor", k % 3 == 0)}));
  }
  is_over = true;
  reader.join();
  rclcpp::shutdown();
}

TEST(Srdf, LinksWithoutCollisionsAreThoseThatNobodyEnables) {
  const std::string file =
      written("berth_srdf_test.srdf", R"(<?xml version="1.0"?><robot name="arm">
    <disable_collisions link1="base" link2="hand" reason="Never"/>
    <disable_default_collisions link="cable"/><disable_default_collisions link="bellows"/>
    <disable_default_collisions link="tool"/><enable_collisions link1="tool" link2="base"/>
    </robot>)");
  EXPECT_EQ(links_without_collisions(file), (std::vector<std::string>{"cable", "bellows"}));
}

TEST(Srdf, WhatIsNoneIsNamed) {
  const auto error_of = [](const std::string& file) {
    try {
      links_without_collisions(file);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(error_of("nowhere.srdf").find("nowhere.srdf"), std::string::npos);
  const std::string other = written("berth_no_srdf_test.srdf", "<scene/>");
  EXPECT_NE(error_of(other).find("no <robot>; expected an SRDF"), std::string::npos);
}

TEST(JointRhythm, TellsTheLongestOfTheLastGaps) {
  JointRhythm rhythm;
  EXPECT_EQ(rhythm.longest_gap_s(), 0);
  rhythm.add(std::nan(""));
  for (const double stamp_s : {10.0, 10.0, 10.25, 10.25, 10.375}) rhythm.add(stamp_s);
  EXPECT_EQ(rhythm.longest_gap_s(), 0.25);
  for (int k = 1; k <= 7; ++k) rhythm.add(10.375 + 0.125 * k);
  EXPECT_EQ(rhythm.longest_gap_s(), 0.125) << "one long gap is forgotten after eight more";
  rhythm.add(2.0);
  EXPECT_EQ(rhythm.longest_gap_s(), 0) << "the clock was set back";
  rhythm.add(2.5);
  EXPECT_EQ(rhythm.longest_gap_s(), 0.5);
}

}  // namespace
}  // namespace berth_ros
