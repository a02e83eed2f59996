// SPDX-License-Identifier: Apache-2.0
#include "kerf/strategy.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace kerf {
namespace {

using remeshing::Outcome;

remeshing::Triangles one_triangle() {
    remeshing::Triangles mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {0, 1, 2};
    mesh.tags = {KERF_FACE_WALL};
    return mesh;
}

struct Written {
    std::vector<unsigned char> bytes = std::vector<unsigned char>(1024);
    kerf_arena arena{bytes.data(), bytes.size(), 8};
    kerf_remesh_out out{};
    kerf_status status;
    explicit Written(Outcome outcome)
        : status(RemeshAnswer::of(outcome, one_triangle(), "a wall is in the way").write(arena, out)) {}
};

TEST(RemeshAnswer, OfACutHasTheMesh) {
    const Written cut(Outcome::cut);
    EXPECT_EQ(cut.status, KERF_OK);
    EXPECT_EQ(cut.out.result.triangle_count, 1u);
    EXPECT_EQ(cut.out.result.vertex_count, 3u);
}

TEST(RemeshAnswer, OfOtherOutcomesHasNoMesh) {
    for (const auto& [outcome, status] :
         {std::pair{Outcome::unchanged, KERF_REMESH_UNCHANGED}, std::pair{Outcome::declined, KERF_REMESH_DECLINED},
          std::pair{Outcome::refused, KERF_REMESH_REFUSED}, std::pair{Outcome::cancelled, KERF_REMESH_CANCELLED}}) {
        const Written answer(outcome);
        EXPECT_EQ(answer.status, status);
        EXPECT_EQ(answer.out.result.triangle_count, 0u);
    }
}

TEST(RemeshAnswer, GivesTheReasonOfARefusal) {
    EXPECT_STREQ(Written(Outcome::refused).out.message, "a wall is in the way");
    EXPECT_STREQ(Written(Outcome::declined).out.message, "a wall is in the way");
    EXPECT_STREQ(Written(Outcome::unchanged).out.message, "");
}

}  // namespace
}  // namespace kerf
