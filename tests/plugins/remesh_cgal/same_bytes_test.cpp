// SPDX-License-Identifier: Apache-2.0
// A strategy is a function of its request: what was asked before, and where memory was free, makes no difference.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "bone/remesh/remesh_child.h"
#include "kerf/units.hpp"
#include "tests/support/sawn_tube.h"

namespace kerf {
namespace {

using namespace literals;
using test::bent_bone, test::blade_at, test::cut_across, test::slot_blade;

class SameBytes : public testing::TestWithParam<const char*> {
protected:
    static std::unique_ptr<bone::RemeshChild> start() {
        std::string error;
        auto child = bone::RemeshChild::start(
            {KERF_BUILD_DIR "/libexec/kerf/kerf-remesh", KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so", GetParam()},
            error);
        EXPECT_NE(child, nullptr) << error;
        return child;
    }
    bone::RemeshResult ask(bone::RemeshChild& child, double from, double to) const {
        bone::RemeshRequest request;
        request.base = bone::tagged(bent_bone(4000.0));
        request.solids = {&blade_};
        request.cuts = {{blade_at(0.0, from), blade_at(0.0, to), 0}};
        return child.remesh(request, std::chrono::seconds(60));
    }
    static void expect_same(const bone::RemeshResult& a, const bone::RemeshResult& b) {
        ASSERT_EQ(a.status, KERF_OK) << a.message;
        ASSERT_EQ(b.status, KERF_OK) << b.message;
        EXPECT_EQ(a.mesh.mesh.triangles, b.mesh.mesh.triangles);
        EXPECT_EQ(a.mesh.tags, b.mesh.tags);
        ASSERT_EQ(a.mesh.mesh.vertices.size(), b.mesh.mesh.vertices.size());
        for (std::size_t v = 0; v < a.mesh.mesh.vertices.size(); ++v)
            ASSERT_TRUE(a.mesh.mesh.vertices[v] == b.mesh.mesh.vertices[v]) << v;
    }

private:
    ToolSolid blade_ = slot_blade();
};

TEST_P(SameBytes, WhateverWasAskedBefore) {
    const auto child = start();
    const bone::RemeshResult first = ask(*child, -13.0_mm, -4.0_mm);
    for (const double to : {-8.0_mm, -2.0_mm, -6.0_mm}) (void)ask(*child, -13.0_mm, to);
    expect_same(ask(*child, -13.0_mm, -4.0_mm), first);
}

TEST_P(SameBytes, InAnotherProcess) {
    const auto one = start(), other = start();
    (void)ask(*other, -13.0_mm, -7.0_mm);
    expect_same(ask(*one, -13.0_mm, -4.0_mm), ask(*other, -13.0_mm, -4.0_mm));
}

INSTANTIATE_TEST_SUITE_P(Strategies, SameBytes, testing::Values("exact", "local", "whole_rounded"),
                         [](const auto& strategy) { return std::string(strategy.param); });

}  // namespace
}  // namespace kerf
