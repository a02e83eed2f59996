// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "core/haptics/scene/simulation.h"
#include "kerf/plugin.hpp"

/// A blunt probe with the smallest law there is: its tip touches. It can be told to go wrong.
namespace kerf::test {

struct BluntProbe {
    static constexpr auto about() { return describe("probe", "A blunt probe."); }
    [[nodiscard]] Outline outline() const {
        return revolution({{0.0, 0.0}, {-0.5e-3, 0.5e-3}}).cuts().to(-50e-3, 0.5e-3).gripped_at(-60e-3);
    }
};

struct Touch {
    double stiffness, fault_from, fault_until;

    struct State {
        std::uint64_t steps = 0;  ///< commits so far
    };
    static constexpr auto about() {
        constexpr const char* of_test = "the test's";
        return describe(
            "touch", "Contact of the tip.",
            param(&Touch::stiffness,
                  {.id = "stiffness", .help = "Of bone.", .min = 0.0, .max = 1e12, .def = 1e6, .source = of_test}),
            param(&Touch::fault_from, {.id = "fault_from",
                                       .help = "First tick of the fault.",
                                       .min = 0.0,
                                       .max = 1e18,
                                       .def = 1e18,
                                       .source = of_test}),
            param(&Touch::fault_until, {.id = "fault_until",
                                        .help = "Tick after it.",
                                        .min = 0.0,
                                        .max = 1e18,
                                        .def = 1e18,
                                        .source = of_test}));
    }

    void resist(const Held<BluntProbe>&, const BoneQuery& bone, const State& state, Channels& channels) const noexcept {
        const SurfacePoint tip = bone.nearest({});
        if (tip.body < 0) return;
        const auto now = static_cast<double>(state.steps);
        const bool is_faulty = now >= fault_from && now < fault_until;
        channels.contact({.id = 1,
                          .along = -tip.normal,
                          .stiffness = is_faulty ? std::numeric_limits<double>::quiet_NaN() : stiffness,
                          .depth = -tip.distance});
    }
    void commit(const Held<BluntProbe>&, const BoneQuery&, const Advance&, State& state, Actions&) const noexcept {
        ++state.steps;
    }
};

inline ToolSetup probe(double k, double fault_from = 1e18, double fault_until = 1e18) {
    using Components = PluginTables<BluntProbe, Touch>;
    return {.tool = &Components::components[0],
            .force = &Components::components[1],
            .tool_parameters = {},
            .force_parameters = {k, fault_from, fault_until},
            .drives = {},
            .bound = {}};
}

}  // namespace kerf::test
