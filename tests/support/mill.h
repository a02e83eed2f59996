// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

#include "core/haptics/simulation.h"
#include "kerf/force.hpp"
#include "kerf/units.hpp"
#include "tests/support/block.h"

/// A mill that goes sideways through a bar and severs it, with the smallest law that does: edges on the front half of
/// its circumference resist its way along +x.
namespace kerf::test {

struct Milling {
    static constexpr double radius = 0.6e-3, length = 12e-3, force_per_edge = 0.2 /* [N] */,
                            damping = 4.0 /* [N·s/m] */;
    struct State {
        std::uint64_t steps = 0;
    };
    enum : std::size_t { tool_parameter_count = 0, force_parameter_count = 0, drive_count = 0, signal_count = 0 };

    static void resist(const Tick&, const BoneQuery& bone, const State&, Channels& channels) noexcept {
        constexpr int around = 9, along = 12;
        std::array<Vec3, around * along> edges;
        for (int a = 0; a < around; ++a)
            for (int l = 0; l < along; ++l) {
                const double angle = pi * (static_cast<double>(a) / (around - 1) - 0.5);
                edges[static_cast<std::size_t>(a * along + l)] = {radius * std::cos(angle), radius * std::sin(angle),
                                                                  -length * (l + 0.5) / along};
            }
        std::array<kerf_bone_sample, around * along> samples;
        bone.sample(edges, {1, 0, 0}, samples);
        kerf_channel* c = channels.add(KERF_CUT, 1);
        c->d[0] = 1.0;
        c->gap = 1.0;
        for (const auto& s : samples) {
            if (s.engagement <= 0.0) continue;
            c->tau += force_per_edge * s.engagement;
            c->eta += damping * s.engagement;
            c->gap = std::min(c->gap, s.gap);
        }
        c->w = 1e-4;
        if (c->tau == 0.0) c->gap = 0.0;
    }
    static void commit(const Tick&, const BoneQuery&, const Advance&, State& state, std::span<double>,
                       Actions& actions) noexcept {
        ++state.steps;
        actions.cut();
    }
};

inline ToolSetup mill() {
    static constexpr kerf_tool tool{
        sizeof(kerf_tool), nullptr, 0, [](const double*, kerf_tool_shape* out) -> kerf_status {
            const kerf_profile_point points[] = {
                {0.0, Milling::radius}, {-Milling::length, Milling::radius}, {-50e-3, Milling::radius}};
            std::copy(std::begin(points), std::end(points), out->profile);
            out->profile_count = 3;
            out->cutting_count = 2;
            out->grip_z = -60e-3;
            return KERF_OK;
        }};
    using Table = ForceTable<Milling>;
    static constexpr kerf_force force{
        sizeof(kerf_force), sizeof(Milling::State), alignof(Milling::State), nullptr, 0, nullptr, 0, 5000,
        &Table::begin,      &Table::resist,         &Table::commit};
    static constexpr kerf_component components[] = {
        {sizeof(kerf_component), KERF_KIND_TOOL, "mill", "", nullptr, 0, 0, &tool, nullptr, nullptr},
        {sizeof(kerf_component), KERF_KIND_FORCE, "milling", "", nullptr, 0, 0, nullptr, &force, nullptr}};
    return {&components[0], &components[1], {}, {}, {}};
}

/// A bar along y, 3 × 14 × 3 mm, which the mill severs on its way along x at y = 2 mm.
inline Body bar(double spacing) {
    return block({-1.5e-3, -7e-3, -1.5e-3}, {1.5e-3, 7e-3, 1.5e-3}, spacing, {0.3, 0.1, 0.7});
}
/// The mill beside or in the bar, through all of its height.
inline Pose mill_at(double x, double y = 2e-3) { return {{x, y, 6e-3}, {1, 0, 0, 0}}; }

}  // namespace kerf::test
