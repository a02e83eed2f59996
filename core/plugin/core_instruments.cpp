// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/core_instruments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

#include "kerf/exact_math.hpp"
#include "kerf/force.hpp"
#include "kerf/units.hpp"

namespace kerf {

namespace {

using namespace literals;

constexpr double jaw_radius = 1.5_mm, jaw_length = 40.0_mm, near_contact = 0.3_mm;

constexpr kerf_param force_parameters[] = {
    {"contact_stiffness", "Stiffness of bone where the jaws touch it.", dimension::force_per_length, "N/mm",
     1.0_N_per_mm, 10000.0_N_per_mm, 200.0_N_per_mm, "assumed"},
    {"bite", "The jaws hold bone that is no farther from their tip when they close.", dimension::length, "mm", 0.1_mm,
     10.0_mm, 1.0_mm, "assumed"},
};
constexpr kerf_drive drives[] = {{"jaws", "0: open; 1: closed.", dimension::none, "", 0.0, 1.0, 0.0, 0.0}};

/// The still jaws touch; closing, they hold what is at their tip. What is held is no obstacle to them: the core sees to
/// that.
struct Grasp {
    struct State {
        bool is_closed = false;
    };
    enum : std::size_t { contact_stiffness, bite, force_parameter_count };
    enum : std::size_t { drive_count = 1, signal_count = 0 };
    enum Event : std::size_t { closed_on_nothing, event_count };
    static constexpr std::size_t around = 6, rings = 4, tip_rings = 2;

    static bool closes(const Tick& tick) noexcept { return tick.drive[0] >= 0.5; }

    static void resist(const Tick& tick, const BoneQuery& bone, const State&, Channels& channels) noexcept {
        constexpr double behind[rings] = {jaw_radius, 4.0_mm, 15.0_mm, 35.0_mm};
        std::array<Vec3, 1 + rings * around> points{};  // the first at the tip
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
            const kerf_surface_point& s = surface[deepest];
            if (s.body < 0 || s.distance > near_contact || s.normal == Vec3{}) return;
            kerf_channel* c = channels.add(KERF_CONTACT, id);
            if (c == nullptr) return;
            const Vec6 d = rate_at(points[deepest], -s.normal);
            std::copy(d.begin(), d.end(), c->d);
            c->k = tick.force[contact_stiffness];
            c->delta = -s.distance;
        };
        touch(0, first_of_shaft, 1);
        touch(first_of_shaft, points.size(), 2);
    }

    static void commit(const Tick& tick, const BoneQuery& bone, const Advance&, State& state, std::span<double>,
                       Actions& actions) noexcept {
        const bool is_closed = closes(tick);
        if (is_closed == state.is_closed) return;
        state.is_closed = is_closed;
        if (!is_closed) {
            actions.release();
            return;
        }
        const Vec3 tip{};
        kerf_surface_point nearest;
        bone.nearest({&tip, 1}, {&nearest, 1});
        if (nearest.body >= 0 && nearest.distance <= tick.force[bite])
            actions.hold(nearest.body);
        else
            actions.event(closed_on_nothing);
    }
};

constexpr kerf_event events[] = {
    {"kerf.core.closed_on_nothing", "The jaws closed, and no bone was within their bite."}};
static_assert(std::size(events) == Grasp::event_count);

kerf_status shape(const double*, kerf_tool_shape* out) {
    constexpr kerf_profile_point points[] = {{0.0, 0.0},
                                             {-0.5 * jaw_radius, 0.85 * jaw_radius},
                                             {-jaw_radius, jaw_radius},
                                             {-jaw_length, jaw_radius},
                                             {-80.0_mm, 4.0_mm}};
    if (out->profile_capacity < std::size(points)) return KERF_CAPACITY;
    std::copy(std::begin(points), std::end(points), out->profile);
    out->profile_count = std::size(points);
    out->cutting_count = 3;  // they cut nothing
    out->grip_z = -80.0_mm;
    return KERF_OK;
}

constexpr kerf_tool forceps{sizeof(kerf_tool), drives, std::size(drives), &shape};
constexpr kerf_force grasp{sizeof(kerf_force),
                           sizeof(Grasp::State),
                           alignof(Grasp::State),
                           nullptr,
                           0,
                           events,
                           Grasp::event_count,
                           5000,
                           &ForceTable<Grasp>::begin,
                           &ForceTable<Grasp>::resist,
                           &ForceTable<Grasp>::commit};
constexpr kerf_component components[] = {
    {sizeof(kerf_component), KERF_KIND_TOOL, "forceps",
     "Forceps, closed and opened by hand, that hold a piece of bone.", nullptr, 0, 0, &forceps, nullptr, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "grasp",
     "Contact of the jaws; what they close on moves with them and is stopped by other bone.", force_parameters,
     std::size(force_parameters), 0, nullptr, &grasp, nullptr},
};
constexpr kerf_entry entry{KERF_MAGIC,  KERF_ABI_VERSION,  sizeof(kerf_entry), std::size(components), KERF_LAYOUT_INIT,
                           "kerf.core", KERF_CORE_VERSION, "Apache-2.0",       __VERSION__,           components};

}  // namespace

const kerf_entry& core_instruments() noexcept { return entry; }

}  // namespace kerf
