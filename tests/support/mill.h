// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/haptics/scene/simulation.h"
#include "kerf/plugin.hpp"
#include "kerf/units.hpp"
#include "tests/support/block.h"

/// A mill that goes sideways through a bar and severs it, with the smallest law that does: edges on the front half of
/// its circumference resist its way along +x.
namespace kerf::test {

struct Mill {
    static constexpr double radius = 0.6e-3, length = 12e-3;

    static constexpr auto about() { return describe("mill", "A mill that cuts sideways."); }
    [[nodiscard]] Outline outline() const {
        return revolution({{0.0, radius}, {-length, radius}}).cuts().to(-50e-3, radius).gripped_at(-60e-3);
    }
};

struct Milling {
    static constexpr double force_per_edge = 0.2 /* [N] */, damping = 4.0 /* [N·s/m] */;
    struct State {
        std::uint64_t steps = 0;
    };
    static constexpr auto about() { return describe("milling", "Edges on the front half resist."); }

    void resist(const Held<Mill>&, const BoneQuery& bone, const State&, Channels& channels) const noexcept {
        constexpr int around = 9, along = 12;
        std::array<Vec3, around * along> edges;
        for (int a = 0; a < around; ++a)
            for (int l = 0; l < along; ++l) {
                const double angle = pi * (static_cast<double>(a) / (around - 1) - 0.5);
                edges[static_cast<std::size_t>(a * along + l)] = {
                    Mill::radius * std::cos(angle), Mill::radius * std::sin(angle), -Mill::length * (l + 0.5) / along};
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
    void commit(const Held<Mill>&, const BoneQuery&, const Advance&, State& state, Actions& actions) const noexcept {
        ++state.steps;
        actions.cut();
    }
};

inline ToolSetup mill() {
    using Components = PluginTables<Mill, Milling>;
    return {.tool = &Components::components[0],
            .force = &Components::components[1],
            .tool_parameters = {},
            .force_parameters = {},
            .drives = {},
            .bound = {}};
}

/// A bar along y, 3 × 14 × 3 mm, which the mill severs on its way along x at y = 2 mm.
inline Body bar(double spacing) {
    return block({-1.5e-3, -7e-3, -1.5e-3}, {1.5e-3, 7e-3, 1.5e-3}, spacing, {0.3, 0.1, 0.7});
}
/// The mill beside or in the bar, through all of its height.
inline Pose mill_at(double x, double y = 2e-3) { return {{x, y, 6e-3}, {1, 0, 0, 0}}; }

}  // namespace kerf::test
