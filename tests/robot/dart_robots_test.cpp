// The invalid URDFs that Debian's package dart-doc ships, where it is installed: each is refused by
// name.
#include <gtest/gtest.h>

#include "berth/robot/robot_model.hpp"
#include "tests/robot/error_text.hpp"

namespace berth {
namespace {

struct Broken {
  std::string file;
  std::string told;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.file; }

class DartRobot : public testing::TestWithParam<Broken> {};

TEST_P(DartRobot, IsRefusedByName) {
  const std::filesystem::path folder = "/usr/share/doc/dart/data/urdf/test";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs Debian's package dart-doc";
  const auto file = folder / (GetParam().file + ".urdf");
  expect_error([&] { load_robot({.urdf = file}); }, {file.string(), GetParam().told});
}

INSTANTIATE_TEST_SUITE_P(
    Invalid, DartRobot,
    testing::Values(Broken{"invalid", "not a valid URDF"},
                    Broken{"invalid_mesh", "invalid_mesh.stl"},
                    Broken{"missing_mesh", "this_file_does_not_exist.stl"},
                    Broken{"missing_package", "package://missing_package/foo.stl"},
                    Broken{"primitive_geometry", "holds 3 shapes; expected one"},
                    Broken{"testWorld", "the root is <world>; expected <robot>"}),
    [](const auto& test) { return test.param.file; });

}  // namespace
}  // namespace berth
