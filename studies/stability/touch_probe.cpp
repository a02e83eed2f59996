// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/touch_probe.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

#include "kerf/force.hpp"

namespace kerf::stability {

namespace {

constexpr std::size_t most_points = 1000;

struct Touch {
    struct State {};
    enum : std::size_t {
        points,
        stiffness,
        force_parameter_count,
        tool_parameter_count = 1,
        drive_count = 0,
        signal_count = 0
    };

    static void resist(const Tick& tick, const BoneQuery& bone, const State&, Channels& channels) noexcept {
        std::array<Vec3, most_points> place{};
        std::array<kerf_surface_point, most_points> surface{};
        const auto count = static_cast<std::size_t>(tick.force[points]);
        for (std::size_t i = 1; i < count; ++i)
            place[i].z = -probe_length * static_cast<double>(i) / static_cast<double>(count - 1);
        bone.nearest({place.data(), count}, {surface.data(), count});
        const std::size_t groups = std::min<std::size_t>(count, KERF_MAX_CHANNELS);
        for (std::size_t g = 0; g < groups; ++g) {
            Vec6 along{};
            double depth = 0.0, met = 0.0;
            for (std::size_t i = g * count / groups; i < (g + 1) * count / groups; ++i) {
                if (surface[i].body < 0) continue;
                const Vec6 d = rate_at(place[i], -surface[i].normal);
                for (std::size_t k = 0; k < 6; ++k) along[k] += d[k];
                depth -= surface[i].distance;
                met += 1.0;
            }
            if (met == 0.0) continue;
            kerf_channel* touch = channels.add(KERF_CONTACT, static_cast<std::uint32_t>(g + 1));
            for (std::size_t k = 0; k < 6; ++k) touch->d[k] = along[k] / met;
            touch->k = met * tick.force[stiffness];
            touch->delta = depth / met;
        }
    }
    static void commit(const Tick&, const BoneQuery&, const Advance&, State&, std::span<double>, Actions&) noexcept {}
};

kerf_status shape(const double* points, kerf_tool_shape* out) {
    const kerf_profile_point profile[] = {{0.0, 0.0}, {-0.5e-3, 0.5e-3}, {-probe_length, 0.5e-3}};
    std::copy(std::begin(profile), std::end(profile), out->profile);
    out->profile_count = 3;
    out->cutting_count = 2;
    out->grip_z = *points > 1.0 ? -0.5 * probe_length : -probe_length;
    return KERF_OK;
}

constexpr kerf_tool tool{sizeof(kerf_tool), nullptr, 0, &shape};
constexpr kerf_force force{
    sizeof(kerf_force),        sizeof(Touch::State),       alignof(Touch::State),     nullptr, 0, nullptr, 0, 5000,
    &ForceTable<Touch>::begin, &ForceTable<Touch>::resist, &ForceTable<Touch>::commit};
constexpr kerf_component components[] = {
    {sizeof(kerf_component), KERF_KIND_TOOL, "probe", "", nullptr, 0, 0, &tool, nullptr, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "touch", "", nullptr, 0, 0, nullptr, &force, nullptr}};

}  // namespace

ToolSetup touch_probe(int points, double stiffness) {
    const double count = std::clamp(points, 1, static_cast<int>(most_points));
    return {&components[0], &components[1], {count}, {count, stiffness}, {}};
}

}  // namespace kerf::stability
