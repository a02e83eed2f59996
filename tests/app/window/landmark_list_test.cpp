// SPDX-License-Identifier: Apache-2.0
#include "app/window/landmark_list.h"

#include <gtest/gtest.h>

namespace kerf::window {
namespace {

LandmarkList three_points() {
    LandmarkList list;
    list.add("a", {1, 0, 0});
    list.add("b", {2, 0, 0});
    list.add("c", {3, 0, 0});
    return list;
}

TEST(LandmarkList, JoinsTheSelectedPointAndTheOneBefore) {
    LandmarkList list = three_points();
    ASSERT_TRUE(list.join("axis"));
    ASSERT_EQ(list.all().size(), 2U);
    EXPECT_EQ(list.all()[1].id, "axis");
    EXPECT_EQ(list.all()[1].at.x, 2.0);
    EXPECT_EQ(list.all()[1].to.value_or(Vec3{}).x, 3.0);
    EXPECT_FALSE(list.join("again")) << "an axis is selected";
    list.reverse(1);
    EXPECT_EQ(list.all()[1].at.x, 3.0);
    list.select(0);
    EXPECT_FALSE(list.join("again")) << "no point is before it";
}

TEST(LandmarkList, UndoesEachChange) {
    LandmarkList list = three_points();
    list.join("axis");
    list.remove(0);
    EXPECT_TRUE(list.undo());
    EXPECT_EQ(list.all().size(), 2U);
    EXPECT_TRUE(list.undo());
    EXPECT_EQ(list.all().size(), 3U);
    EXPECT_EQ(list.selected(), 2U);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(list.undo());
    EXPECT_TRUE(list.all().empty());
    EXPECT_FALSE(list.undo());
}

TEST(LandmarkList, UndoesADragAsOneChange) {
    LandmarkList list = three_points();
    list.move(0, false, {1, 1, 0});
    list.move(0, false, {1, 2, 0});
    list.end_move();
    list.move(0, false, {1, 3, 0});
    list.undo();
    EXPECT_EQ(list.all()[0].at.y, 2.0);
    list.undo();
    EXPECT_EQ(list.all()[0].at.y, 0.0);
}

TEST(LandmarkList, UndoesARenamingAsOneChange) {
    LandmarkList list = three_points();
    list.rename(2, "t");
    list.rename(2, "ti");
    list.rename(2, "tip");
    EXPECT_TRUE(list.has("tip"));
    list.undo();
    EXPECT_EQ(list.all()[2].id, "c");
}

TEST(LandmarkList, SelectsAroundTheEnd) {
    LandmarkList list = three_points();
    list.select_next(1);
    EXPECT_EQ(list.selected(), 0U);
    list.select_next(-1);
    EXPECT_EQ(list.selected(), 2U);
    list.remove(2);
    EXPECT_EQ(list.selected(), 1U);
    LandmarkList().select_next(1);
}

}  // namespace
}  // namespace kerf::window
