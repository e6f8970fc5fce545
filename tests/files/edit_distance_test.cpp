#include "berth/files/edit_distance.hpp"

#include <gtest/gtest.h>

namespace berth {
namespace {

TEST(EditDistance, CountsInsertedDroppedAndReplacedLetters) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("abc", "abc"), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3);
}

TEST(EditDistance, NearestIsTheFirstOfTheLeast) {
  EXPECT_EQ(nearest("padding", {"tolerance_m", "padding_m", "speckle_px"}), "padding_m");
  EXPECT_EQ(nearest("x", {"a", "b"}), "a");
}

}  // namespace
}  // namespace berth
