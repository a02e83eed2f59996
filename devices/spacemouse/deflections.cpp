// SPDX-License-Identifier: Apache-2.0
#include "deflections.h"

#include <cstddef>
#include <utility>

#include "report.h"

namespace kerf::spacemouse {

namespace {

constexpr double max_age = 0.1;  // [s] of a deflection that is not zero
constexpr std::size_t along = 0, about = 3;

void put(Vec3 half, std::size_t at, kerf_device_state& state) noexcept {
    state.deflection[at] = half.x;
    state.deflection[at + 1] = half.y;
    state.deflection[at + 2] = half.z;
}

bool is_zero(std::size_t at, const kerf_device_state& state) noexcept {
    return state.deflection[at] == 0.0 && state.deflection[at + 1] == 0.0 && state.deflection[at + 2] == 0.0;
}

}  // namespace

bool Deflections::take(std::span<const std::uint8_t> report, double now, kerf_device_state& state) noexcept {
    const auto content = decode(report);
    if (!content) return false;
    if (content->translation) {
        put(*content->translation, along, state);
        translated_ = now;
    }
    if (content->rotation) {
        put(*content->rotation, about, state);
        rotated_ = now;
    }
    if (content->buttons) state.buttons = *content->buttons;
    return true;
}

bool Deflections::expire(double now, kerf_device_state& state) noexcept {
    bool has_changed = false;
    for (const auto& [at, time] : {std::pair(along, translated_), std::pair(about, rotated_)}) {
        if (now - time <= max_age || is_zero(at, state)) continue;
        put({}, at, state);
        has_changed = true;
    }
    return has_changed;
}

}  // namespace kerf::spacemouse
