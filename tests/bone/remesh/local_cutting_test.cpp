// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/local_cutting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;

TaggedMesh ball() { return tagged(test::sphere(6.0_mm, 3)); }
const ToolSolid pin({{0.0, 1.0_mm}, {-4.0_mm, 1.0_mm}});
const CutStretch plunge{{{0, 0, 5.0_mm}, {0, 1, 0, 0}}, {{0, 0, 4.0_mm}, {0, 1, 0, 0}}, 0};

constexpr double coarse = 0.2_mm;  // a tolerance by which any of the results below will do

/// A strategy that always gives one status, and counts.
struct Always {
    kerf_status status;
    int* count;
    RemeshResult operator()(const RemeshRequest& /*request*/) const {
        ++*count;
        RemeshResult result;
        result.status = status;
        result.message = "status " + std::to_string(status);
        return result;
    }
};
/// Gives back the patch, its free vertices moved inwards.
struct Pushes {
    int* count;
    RemeshResult operator()(const RemeshRequest& request) const {
        ++*count;
        RemeshResult result;
        result.status = KERF_OK;
        result.mesh = request.base;
        for (std::size_t v = 0; v < request.locked.size(); ++v)
            if (request.locked[v] == 0) result.mesh.mesh.vertices[v].z -= 0.1_mm;
        return result;
    }
};

TEST(LocalCutting, HandsOverWhatIsDeclined) {
    int first = 0, second = 0;
    LocalCutting cutting(ball(), {&pin}, coarse, Always{KERF_REMESH_DECLINED, &first}, Pushes{&second});
    EXPECT_TRUE(cutting.cut(plunge));
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 1);
    EXPECT_EQ(cutting.handed_over(), 1);
    EXPECT_EQ(cutting.refusals(), 0) << "to decline is no fault";
    EXPECT_EQ(cutting.hand_over_reason(), "status " + std::to_string(KERF_REMESH_DECLINED));
    EXPECT_GT(cutting.removed(), 0.0);
}

TEST(LocalCutting, HandsOverAResultThatFails) {
    int first = 0, second = 0;
    const auto inverted = [&first](const RemeshRequest& request) {
        RemeshResult result = Pushes{&first}(request);
        std::swap(result.mesh.mesh.triangles.front()[0], result.mesh.mesh.triangles.front()[1]);
        return result;
    };
    LocalCutting cutting(ball(), {&pin}, coarse, inverted, Pushes{&second});
    EXPECT_TRUE(cutting.cut(plunge));
    EXPECT_EQ(first, 1) << "it gets no second attempt";
    EXPECT_EQ(second, 1);
    EXPECT_EQ(cutting.refusals(), 1);
    EXPECT_EQ(cutting.handed_over(), 1);
}

TEST(LocalCutting, KeepsWhatTheFirstStrategyMade) {
    int first = 0, second = 0;
    LocalCutting cutting(ball(), {&pin}, coarse, Pushes{&first}, Always{KERF_FAILED, &second});
    EXPECT_TRUE(cutting.cut(plunge));
    EXPECT_EQ(second, 0);
    EXPECT_EQ(cutting.handed_over(), 0);
}

TEST(LocalCutting, IsStaleWhereBothFail) {
    int first = 0, second = 0;
    LocalCutting cutting(ball(), {&pin}, 1e-6, Always{KERF_REMESH_DECLINED, &first},
                         Always{KERF_REMESH_REFUSED, &second});
    EXPECT_FALSE(cutting.cut(plunge));
    EXPECT_EQ(second, LocalCutting::max_refusals + 1);
    ASSERT_EQ(cutting.stale().size(), 1U);
    EXPECT_EQ(cutting.stale().front().why, "status " + std::to_string(KERF_REMESH_REFUSED));
}

TEST(LocalCutting, AsksADecliningStrategyOnce) {
    int first = 0;
    LocalCutting cutting(ball(), {&pin}, 1e-6, Always{KERF_REMESH_DECLINED, &first});
    EXPECT_FALSE(cutting.cut(plunge));
    EXPECT_EQ(first, 1);
    EXPECT_EQ(cutting.stale().size(), 1U);
}

}  // namespace
}  // namespace kerf::bone
