// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/core_instruments.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "kerf/exact_math.hpp"
#include "kerf/plugin.hpp"

namespace kerf {

namespace {

using namespace literals;

constexpr double jaw_radius = 1.5_mm, jaw_length = 40.0_mm, near_contact = 0.3_mm;

struct Forceps {
    double jaws;

    static constexpr auto about() {
        return describe(
            "forceps", "Forceps, closed and opened by hand, that hold a piece of bone.",
            drive(&Forceps::jaws, {.id = "jaws", .help = "0: open; 1: closed.", .min = 0.0, .max = 1.0, .def = 0.0}));
    }
    [[nodiscard]] Outline outline() const {
        return revolution({{0.0, 0.0}, {-0.5 * jaw_radius, 0.85 * jaw_radius}, {-jaw_radius, jaw_radius}})
            .cuts()  // the ABI's cutting part; `grasp` never cuts with it
            .to(-jaw_length, jaw_radius)
            .to(-80.0_mm, 4.0_mm)
            .gripped_at(-80.0_mm);
    }
};

/// Contact of the jaws with bone. When they close, they grip the body that is nearest to their tip, if it is within
/// `bite`. A gripped body is no longer part of the bone that they touch.
struct Grasp {
    double contact_stiffness, bite;

    struct State {
        bool is_closed = false;
    };
    enum class Happened { closed_on_nothing };

    static constexpr auto about() {
        return describe(
            "grasp", "Contact of the jaws; what they close on moves with them and is stopped by other bone.",
            param(&Grasp::contact_stiffness, {.id = "contact_stiffness",
                                              .help = "Stiffness of bone where the jaws touch it.",
                                              .unit = unit::N_per_mm,
                                              .min = 1.0_N_per_mm,
                                              .max = 10000.0_N_per_mm,
                                              .def = 200.0_N_per_mm,
                                              .source = "assumed"}),
            param(&Grasp::bite, {.id = "bite",
                                 .help = "The jaws hold bone that is at most this far from their tip when they close.",
                                 .unit = unit::mm,
                                 .min = 0.1_mm,
                                 .max = 10.0_mm,
                                 .def = 1.0_mm,
                                 .source = "assumed"}),
            event(Happened::closed_on_nothing,
                  {.id = "kerf.core.closed_on_nothing", .help = "The jaws closed, and no bone was within their bite."}),
            budget_us(5));
    }

    void resist(const Held<Forceps>&, const BoneQuery& bone, const State&, Channels& channels) const noexcept {
        constexpr std::size_t around = 6, rings = 4, tip_rings = 2;
        constexpr double behind[rings] = {jaw_radius, 4.0_mm, 15.0_mm, 35.0_mm};
        std::array<Vec3, 1 + rings * around> points{};  // the first one at the tip
        for (std::size_t ring = 0; ring < rings; ++ring)
            for (std::size_t i = 0; i < around; ++i) {
                const SinCos angle = sin_cos_exact(2.0 * pi * static_cast<double>(i) / around);
                points[1 + ring * around + i] = {jaw_radius * angle.cos, jaw_radius * angle.sin, -behind[ring]};
            }
        std::array<kerf_surface_point, points.size()> surface;
        bone.nearest(points, surface);
        // One channel for the tip, one for the shaft, each at the deepest point.
        const std::size_t first_of_shaft = 1 + tip_rings * around;
        const auto touch = [&](std::size_t first, std::size_t end, std::uint32_t id) {
            std::size_t deepest = first;
            for (std::size_t i = first; i < end; ++i)
                if (surface[i].body >= 0 &&
                    (surface[deepest].body < 0 || surface[i].distance < surface[deepest].distance))
                    deepest = i;
            const SurfacePoint s{surface[deepest]};
            if (!s.is_within(near_contact)) return;
            channels.contact({.id = id,
                              .at = points[deepest],
                              .along = -s.normal,
                              .stiffness = contact_stiffness,
                              .depth = -s.distance});
        };
        touch(0, first_of_shaft, 1);
        touch(first_of_shaft, points.size(), 2);
    }

    void commit(const Held<Forceps>& forceps, const BoneQuery& bone, const Advance&, State& state,
                Actions& actions) const noexcept {
        const bool is_closed = forceps.jaws >= 0.5;
        if (is_closed == state.is_closed) return;
        state.is_closed = is_closed;
        if (!is_closed) {
            actions.release();
            return;
        }
        const SurfacePoint nearest = bone.nearest({});
        if (nearest.body >= 0 && nearest.distance <= bite)
            actions.hold(nearest.body);
        else
            actions.event(Happened::closed_on_nothing);
    }
};

constexpr kerf_entry entry = PluginTables<Forceps, Grasp>::entry("kerf.core", KERF_CORE_VERSION, "Apache-2.0");

}  // namespace

const kerf_entry& core_instruments() noexcept { return entry; }

}  // namespace kerf
