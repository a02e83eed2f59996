// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/stability/touch_probe.h"

#include <algorithm>
#include <array>

#include "kerf/force.hpp"

namespace kerf::stability {

namespace {

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
        std::array<Vec3, KERF_MAX_CHANNELS> place{};
        std::array<kerf_surface_point, KERF_MAX_CHANNELS> surface{};
        const auto count = static_cast<std::size_t>(tick.force[points]);
        for (std::size_t i = 1; i < count; ++i)
            place[i].z = -probe_length * static_cast<double>(i) / static_cast<double>(count - 1);
        bone.nearest({place.data(), count}, {surface.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            if (surface[i].body < 0) continue;
            const Vec3 normal{surface[i].normal.x, surface[i].normal.y, surface[i].normal.z};
            const Vec6 along = rate_at(place[i], -normal);
            kerf_channel* touch = channels.add(KERF_CONTACT, static_cast<std::uint32_t>(i + 1));
            if (touch == nullptr) return;
            std::copy(along.begin(), along.end(), touch->d);
            touch->k = tick.force[stiffness];
            touch->delta = -surface[i].distance;
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
    sizeof(kerf_force),        sizeof(Touch::State),       alignof(Touch::State),     nullptr, 0, 5000,
    &ForceTable<Touch>::reset, &ForceTable<Touch>::resist, &ForceTable<Touch>::commit};
constexpr kerf_component components[] = {
    {sizeof(kerf_component), KERF_KIND_TOOL, "probe", "", nullptr, 0, 0, &tool, nullptr},
    {sizeof(kerf_component), KERF_KIND_FORCE, "touch", "", nullptr, 0, 0, nullptr, &force}};

}  // namespace

ToolSetup touch_probe(int points, double stiffness) {
    const double count = std::clamp(points, 1, static_cast<int>(KERF_MAX_CHANNELS));
    return {&components[0], &components[1], {count}, {count, stiffness}, {}};
}

}  // namespace kerf::stability
