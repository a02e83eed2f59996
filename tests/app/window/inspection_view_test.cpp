// SPDX-License-Identifier: Apache-2.0
// Parts of the inspection that need no context of OpenGL.
#include "app/window/inspection_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace kerf::window {
namespace {

TEST(InspectionLayers, FollowInACircle) {
    InspectionLayers layers = next_layers({});
    EXPECT_TRUE(layers.contacts && layers.field && layers.coupling);
    layers = next_layers(layers);
    EXPECT_TRUE(layers.contacts && !layers.field && !layers.coupling);
    layers = next_layers(layers);
    EXPECT_TRUE(!layers.contacts && layers.field && !layers.coupling);
    layers = next_layers(layers);
    EXPECT_TRUE(!layers.contacts && !layers.field && layers.coupling);
    EXPECT_FALSE(next_layers(layers).is_any());
}

TEST(InspectionArrows, HaveAFullLengthOfARoundForce) {
    run::ViewedInspection inspection;
    const auto full_with = [&](double force) {
        inspection.channels = {{.along = {0, 0, 2}, .force = 0.5 * force}};
        return full_arrow(inspection);
    };
    EXPECT_EQ(full_with(0.0), 10.0);
    EXPECT_EQ(full_with(9.0), 10.0);
    EXPECT_EQ(full_with(11.0), 20.0);
    EXPECT_EQ(full_with(21.0), 50.0);
    EXPECT_EQ(full_with(51.0), 100.0);
}

/// Bone where x < 0.3 mm, cortical where x > −0.4 mm.
run::ViewedSlice made_slice() {
    run::ViewedSlice slice{.step = 0.1e-3, .edge = 31, .reach = 2e-3};
    for (int row = 0; row < slice.edge; ++row)
        for (int column = 0; column < slice.edge; ++column) {
            const double x = slice.point(column, row).x;
            slice.distance.push_back(static_cast<float>(x - 0.3e-3));
            slice.tissue.push_back(static_cast<std::int8_t>(x >= 0.3e-3 ? -1 : x > -0.4e-3 ? 0 : 1));
        }
    return slice;
}

TEST(SlicePicture, HasALineAtTheSurfaceAndColoursOfTissues) {
    const run::ViewedTissue tissues[] = {{"cortical", {230, 220, 200}}, {"cancellous", {200, 60, 60}}};
    const run::ViewedSlice slice = made_slice();
    const Pixels picture = slice_picture(slice, tissues, 0.5e-3);
    ASSERT_EQ(picture.width, 93);
    const auto at = [&](double x) {  // [m] in the middle row
        const int column = static_cast<int>(std::lround(46.0 + x / slice.step * 3.0));
        return &picture.rgb[3 * static_cast<std::size_t>(46 * picture.width + column)];
    };
    EXPECT_GT(at(0.3e-3)[0], 240);
    EXPECT_GT(at(0.3e-3)[2], 240);
    EXPECT_LT(at(0.55e-3)[0], 60) << "air";
    EXPECT_GT(at(0.05e-3)[2], 120) << "cortical";
    EXPECT_GT(at(-0.9e-3)[0], at(-0.9e-3)[2] + 60) << "cancellous";
    EXPECT_GT(at(0.8e-3)[0], at(0.55e-3)[0] + 40) << "line at 0.5 mm from the surface";
}

TEST(SlicePicture, HasRowsFromTheTop) {
    run::ViewedSlice slice = made_slice();
    for (int row = 0; row < slice.edge; ++row)
        for (int column = 0; column < slice.edge; ++column)
            slice.distance[static_cast<std::size_t>(row * slice.edge + column)] =
                static_cast<float>(slice.point(column, row).y - 1e-3);
    slice.tissue.assign(slice.tissue.size(), -1);
    const Pixels picture = slice_picture(slice, {}, 10.0);
    const auto row_of_line = static_cast<std::size_t>(46 - 30);
    EXPECT_GT(picture.rgb[3 * (row_of_line * 93 + 10)], 240);
    EXPECT_LT(picture.rgb[3 * ((92 - row_of_line) * 93 + 10)], 60);
}

TEST(MeshSection, IsTheOutlineInThePlane) {
    run::ViewedMesh mesh;
    mesh.positions = {{0, 0, -1e-3f}, {2e-3f, 0, 1e-3f}, {0, 2e-3f, 1e-3f}};
    mesh.triangles = {{0, 1, 2}};
    const auto lines = section_of(mesh, identity_pose());
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(lines[0][0][0] + lines[0][1][0], 1e-3, 1e-9);
    EXPECT_NEAR(lines[0][0][1] + lines[0][1][1], 1e-3, 1e-9);
    EXPECT_TRUE(section_of(mesh, {{0, 0, 5e-3}, {1, 0, 0, 0}}).empty());
}

}  // namespace
}  // namespace kerf::window
