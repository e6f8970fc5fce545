// The node's verdicts beside the library's, on the bundled scene.
#include "configuration_answers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth_ros {
namespace {

using Request = ConfigurationAnswers::Request;
using Response = ConfigurationAnswers::Response;
using berth::Verdict;
using Rows = std::vector<std::vector<double>>;

class Answers : public testing::Test {
 protected:
  Answers() {
    const berth::OpenCamera& camera = scene_.cameras.front();
    const auto frame = std::make_shared<berth::Frame>();
    berth::Observer(camera.mounted).observe(camera.read_depth(3), camera.at_exposure[3], *frame);
    now_ = {.robot = scene_.robot,
            .frames = {frame},
            .joints = camera.at_exposure[3],
            .joints_status = berth::TimeStatus::ok,
            .now_s = frame->stamp_s};
  }

  const std::vector<berth::MovableJoint>& joints() const { return scene_.robot->model().joints; }
  Rows draw(std::size_t count) const {
    std::mt19937 random(1);
    Rows rows(count, std::vector<double>(joints().size()));
    for (std::vector<double>& row : rows) {
      for (std::size_t j = 0; j < row.size(); ++j) {
        row[j] = std::uniform_real_distribution(joints()[j].lower, joints()[j].upper)(random);
      }
    }
    return rows;
  }
  /// Named from the last joint to the first.
  Request request_of(const Rows& rows) const {
    Request request;
    for (const berth::MovableJoint& joint : joints()) {
      request.trajectory.joint_names.insert(request.trajectory.joint_names.begin(), joint.name);
    }
    for (const std::vector<double>& row : rows) {
      request.trajectory.points.emplace_back().positions = {row.rbegin(), row.rend()};
    }
    return request;
  }
  Response answer(const Request& request) {
    Response response;
    answers_.answer(request, response);
    return response;
  }
  void expect_refused(const Request& request, const std::string& why) {
    const Response response = answer(request);
    EXPECT_FALSE(response.success);
    EXPECT_NE(response.message.find(why), std::string::npos) << response.message;
    EXPECT_TRUE(response.configurations.empty() && response.motions.empty());
    EXPECT_EQ(response.first_not_free, 0);
    EXPECT_EQ(response.first_near, -1);
  }

  const berth::OpenScene scene_ = berth::open_scene(BUNDLED_SCENE);
  RobotNow now_;
  StampClock clock_;
  ConfigurationAnswers answers_{{"front", "left"}, clock_, [this] { return now_; }};
};

TEST_F(Answers, AreTheLibrarysVerdicts) {
  const Rows rows = draw(300);
  std::vector<double> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  const std::span<const double> positions(all);
  berth::ConfigurationCheck check(scene_.robot);
  ASSERT_EQ(check.prepare(now_.frames, now_.now_s), berth::ResultStatus::ok);
  Request request = request_of(rows);
  request.check_motions = true;
  request.without = {scene_.robot->model().evaluated_link_names()[1]};
  for (const bool has_known : {false, true}) {
    request.known_margin_m = has_known ? 0.01 : std::numeric_limits<double>::quiet_NaN();
    berth::ConfigurationMargins margins{.margin_m = 0.03, .without = request.without};
    if (has_known) margins.known_margin_m = 0.01;
    std::vector<Verdict> expected(rows.size()), motions(rows.size() - 1);
    check.ask(positions, margins, expected);
    check.ask_motions(positions.first(all.size() - joints().size()),
                      positions.subspan(joints().size()), margins, motions);
    request.resolve = has_known;
    if (request.resolve) check.resolve(positions, margins, expected);
    const Response response = answer(request);
    ASSERT_TRUE(response.success) << response.message;
    const auto is_same = [](std::uint8_t a, Verdict b) { return a == static_cast<int>(b); };
    EXPECT_TRUE(std::ranges::equal(response.configurations, expected, is_same));
    EXPECT_TRUE(std::ranges::equal(response.motions, motions, is_same));
    for (const Verdict verdict : {Verdict::free, Verdict::near}) {
      const auto count = std::ranges::count(expected, verdict);
      EXPECT_GT(count, 3) << name_of(verdict);
      std::cout << count << " of " << rows.size() << " are " << name_of(verdict) << "\n";
    }
  }
}

TEST_F(Answers, NameTheFirstThatIsNotFree) {
  const Response all = answer(request_of(draw(300)));
  const auto row_of = [&](int verdict) {
    return draw(300)[std::ranges::find(all.configurations, verdict) - all.configurations.begin()];
  };
  const std::vector<double> free = row_of(Response::FREE), near = row_of(Response::NEAR);
  Request request = request_of({free, free, near});
  Response response = answer(request);
  EXPECT_EQ(response.first_not_free, 2);
  EXPECT_EQ(response.first_near, 2);
  request.check_motions = true;
  response = answer(request);
  EXPECT_EQ(response.motions.size(), 2U);
  EXPECT_EQ(response.first_not_free, 1) << "the motion from 1 to 2";
  response = answer(request_of({free, free}));
  EXPECT_EQ(response.first_not_free, -1);
  EXPECT_EQ(response.first_near, -1);
}

TEST_F(Answers, TakeTheNewestPositionsOfJointsThatAreNotNamed) {
  const Response whole = answer(request_of({now_.joints.position}));
  Request request = request_of({now_.joints.position});
  request.trajectory.joint_names.pop_back();
  request.trajectory.points.front().positions.pop_back();
  const Response part = answer(request);
  ASSERT_TRUE(part.success) << part.message;
  EXPECT_EQ(part.configurations, whole.configurations);
  now_.joints.stamp_s -= 1;
  expect_refused(request, "the joint states are 1.0");
  now_.joints_status = berth::TimeStatus::missing_joint;
  expect_refused(request, "the joint states are missing_joint");
}

TEST_F(Answers, AreNoneWhileACameraIsLost) {
  const Request request = request_of(draw(3));
  now_.frames.push_back(nullptr);
  expect_refused(request, "degraded: camera left is no_frame");
  now_.frames.pop_back();
  now_.X_WB = berth::unset_pose();
  expect_refused(request, "stale: nobody tells where the robot's root stands");
  now_.X_WB.reset();
  now_.now_s += 1;
  expect_refused(request, "stale: camera front is too_old");
}

TEST_F(Answers, SayWhatIsWrongWithARequest) {
  Request good = request_of(draw(2)), bad = good;
  bad.trajectory.joint_names.front() = "elbow";
  expect_refused(bad, "trajectory.joint_names: \"elbow\" is no joint of the robot");
  bad.trajectory.joint_names.front() = bad.trajectory.joint_names.back();
  expect_refused(bad, "stands twice");
  bad = good;
  bad.trajectory.points[1].positions.pop_back();
  expect_refused(bad, "trajectory.points[1].positions: 6 numbers; expected 7");
  bad.trajectory.points.clear();
  expect_refused(bad, "trajectory.points: empty");
  bad = good;
  bad.trajectory.points[1].positions[0] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(bad, "of configuration 1 is nan; expected a finite number");
  bad = good;
  bad.trajectory.points[1].positions[0] = 1e9;
  EXPECT_TRUE(answer(bad).success);
  bad.check_motions = true;
  expect_refused(bad, "moves by 1000000000.");
  bad = good;
  bad.margin_m = -1;
  expect_refused(bad, "a margin is -1 m");
  bad = good;
  bad.without = {"finger"};
  expect_refused(bad, "link \"finger\" is not known");
  EXPECT_TRUE(answer(good).success);
}

}  // namespace
}  // namespace berth_ros
