// The messages of ros2/ have the fields of a result, and their constants are its enumerators. It
// reads the definitions as text, so that it needs no ROS.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "berth/pipeline/result.hpp"

namespace berth {
namespace {

using Names = std::set<std::string>;
using Constants = std::map<std::string, int>;

/// What a definition says of itself: its fields without their types, its constants.
struct MessageText {
  Names fields;
  Constants constants;
};

MessageText read_message(const std::string& name) {
  const std::filesystem::path folder = BERTH_MESSAGES;
  std::ifstream file(folder / (name + ".msg"));
  EXPECT_TRUE(file) << name;
  static const std::regex kConstant(R"(^\w+ +([A-Z][A-Z0-9_]*) *= *(\d+))");
  static const std::regex kField(R"(^[\w/]+(?:\[\d*\])? +([a-z]\w*))");
  MessageText message;
  std::smatch found;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_search(line, found, kConstant)) {
      message.constants[found[1]] = std::stoi(found[2]);
    } else if (std::regex_search(line, found, kField)) {
      message.fields.insert(found[1]);
    }
  }
  return message;
}

/// Why one of the two sides has a field that the other lacks. Where it has another name there, that
/// is given.
struct Exception {
  std::string field;
  std::string why;
  std::string name_there = "";
};

/// The fields of the list in the names of the message, once both sides' exceptions are taken out.
Names named_as_in_message(Names fields, std::span<const Exception> exceptions) {
  for (const Exception& exception : exceptions) {
    EXPECT_EQ(fields.erase(exception.field), 1U) << exception.field << ": " << exception.why;
    if (!exception.name_there.empty()) fields.insert(exception.name_there);
  }
  return fields;
}

void expect_same_fields(const std::string& message, const Names& listed,
                        std::span<const Exception> only_listed,
                        std::span<const Exception> only_in_message) {
  EXPECT_EQ(named_as_in_message(read_message(message).fields, only_in_message),
            named_as_in_message(listed, only_listed))
      << message << ".msg";
}

template <class EnumNames>
Constants constants_of(const EnumNames& names, const std::string& prefix = "") {
  Constants constants;
  for (const std::string_view name : names) {
    std::string upper = prefix;
    for (const char letter : name) upper += static_cast<char>(std::toupper(letter));
    constants.emplace(std::move(upper), static_cast<int>(constants.size()));
  }
  return constants;
}

Constants both(Constants a, const Constants& b) {
  a.insert(b.begin(), b.end());
  return a;
}

/// Takes the names of the fields that it visits.
struct NameTaker {
  Names& names;

  template <class T>
  void operator()(const Field& field, const T&) const {
    EXPECT_TRUE(names.insert(std::string(field.name)).second) << field.name << " stands twice";
  }
};

template <class T>
Names names_of(const T& value) {
  Names names;
  visit_fields(value, NameTaker{names});
  return names;
}

/// One that has all that a result may have.
Result full_result() {
  Result result;
  result.cameras.resize(1);
  result.links.resize(1);
  result.links[0].id = 1;
  result.has_visibility = true;
  result.has_candidates = true;
  result.link_names = std::make_shared<const std::vector<std::string>>();
  result.separation.emplace().links.resize(1);
  return result;
}

TEST(MessageFields, OfAResult) {
  Names listed = names_of(full_result());
  EXPECT_EQ(listed.erase("time"), 1U);
  for (const std::string& name : names_of(Timeliness())) {
    listed.insert(name == "status" ? "time_status" : name);
  }
  const Exception only_listed[] = {
      {"stamp_s", "ROS has a type for stamps; it is that of the header", "header"},
      {"joints_stamp_s", "ROS has a type for stamps", "joints_stamp"},
      {"frame", "lines of a recording are counted, not those of a running robot"},
      {"separation", "has a message of its own"}};
  const Exception only_in_message[] = {
      {"question_stamp", "a listener does not know when it was asked"}};
  expect_same_fields("LinkDistances", listed, only_listed, only_in_message);
}

TEST(MessageFields, OfALink) {
  const Result result = full_result();
  Names listed;
  visit_fields(result.links[0], result, NameTaker{listed});
  const Exception only_listed[] = {{"separation", "has a message of its own"},
                                   {"mean_direction_camera", "TF tells where the camera is"},
                                   {"robot_point_camera_m", "TF tells where the camera is"},
                                   {"obstacle_point_camera_m", "TF tells where the camera is"}};
  expect_same_fields("LinkDistance", listed, only_listed, {});
}

TEST(MessageFields, OfACamera) {
  const Exception only_listed[] = {{"stamp_s", "ROS has a type for stamps", "stamp"},
                                   {"frame", "images of a recording are counted"},
                                   {"self_filter", "/diagnostics tells the shares"}};
  const Exception only_in_message[] = {
      {"time_status", "in JSON it takes the place of a status that is stale"}};
  expect_same_fields("CameraState", names_of(CameraResult()), only_listed, only_in_message);
}

TEST(MessageFields, OfWhatALinkAndASeparationHave) {
  expect_same_fields("SpacePair", names_of(SpacePair()), {}, {});
  expect_same_fields("KnownPair", names_of(KnownPair()), {}, {});
  expect_same_fields("LinkVisibility", names_of(LinkVisibility()), {}, {});
  expect_same_fields("SightShares", names_of(SightShares()), {}, {});
  const Exception only_in_message[] = {{"link", "in JSON it stands in its link"}};
  expect_same_fields("LinkSeparation", names_of(LinkSeparation()), {}, only_in_message);
}

TEST(MessageConstants, AreTheEnumerators) {
  Constants time = constants_of(kTimeStatusNames, "TIME_");
  time.emplace("TIME_NO_ROBOT", kTimeStatusCount);  // of the node alone
  EXPECT_EQ(read_message("LinkDistances").constants, both(constants_of(kResultStatusNames), time));
  EXPECT_EQ(read_message("LinkDistance").constants,
            both(constants_of(kLinkStatusNames), constants_of(kObstacleKindNames)));
  EXPECT_EQ(read_message("CameraState").constants, constants_of(kCameraStatusNames));
  Constants state = constants_of(kSeparationStateNames);
  state.emplace("UNMONITORED", 4);  // of the node alone
  EXPECT_EQ(read_message("Separation").constants, state);
}

}  // namespace
}  // namespace berth
