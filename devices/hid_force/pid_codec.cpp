// SPDX-License-Identifier: Apache-2.0
#include "pid_codec.h"

#include <algorithm>
#include <cmath>

namespace kerf::hid_force {

namespace {

Report begin(const Message& message) noexcept {
    Report report{.bytes = {}, .size = std::min(message.size, max_report), .kind = message.kind};
    report.bytes[0] = message.id;
    return report;
}

bool is_of(const Message& message, std::span<const std::uint8_t> report) noexcept {
    return message.exists() && report.size() >= message.size && report[0] == message.id;
}

void put(Report& report, const Choice& choice) noexcept { put(report, choice.spot, choice.value); }

/// Returns the value at a fraction of a range: 0 is its minimum, 1 its maximum.
std::int64_t at(const Spot& spot, double fraction) noexcept {
    return spot.min + std::llround(fraction * static_cast<double>(spot.max - spot.min));
}

}  // namespace

void put(Report& report, const Spot& spot, std::int64_t value) noexcept {
    if (!spot.exists()) return;
    const auto bits = static_cast<std::uint64_t>(std::clamp(value, spot.min, spot.max));
    for (std::uint32_t i = 0; i < spot.bits; ++i) {
        const std::uint32_t bit = spot.bit + i;
        if (bit / 8 >= report.size) return;
        const auto mask = static_cast<std::uint8_t>(1u << bit % 8);
        std::uint8_t& byte = report.bytes[bit / 8];
        byte = static_cast<std::uint8_t>((bits >> i & 1u) != 0 ? byte | mask : byte & ~mask);
    }
}

std::int64_t get(std::span<const std::uint8_t> report, const Spot& spot) noexcept {
    if (!spot.exists() || (spot.bit + spot.bits + 7) / 8 > report.size()) return 0;
    std::uint64_t bits = 0;
    for (std::uint32_t i = 0; i < spot.bits; ++i) {
        const std::uint32_t bit = spot.bit + i;
        bits |= std::uint64_t{report[bit / 8] >> bit % 8 & 1u} << i;
    }
    const std::uint64_t sign = std::uint64_t{1} << (spot.bits - 1);
    if (spot.min < 0 && (bits & sign) != 0) bits |= ~(sign | (sign - 1));
    return static_cast<std::int64_t>(bits);
}

Report control_report(const PidLayout& layout, const Choice& choice) noexcept {
    Report report = begin(layout.control.message);
    put(report, choice);
    return report;
}

Report gain_report(const PidLayout& layout, double fraction) noexcept {
    Report report = begin(layout.gain.message);
    put(report, layout.gain.gain, at(layout.gain.gain, std::clamp(fraction, 0.0, 1.0)));
    return report;
}

Report create_report(const PidLayout& layout) noexcept {
    Report report = begin(layout.create.message);
    put(report, layout.create.constant_force);
    return report;
}

Report effect_report(const PidLayout& layout, std::int64_t block) noexcept {
    constexpr double east = 0.25;  // of the full circle, from north by east
    const auto& effect = layout.effect;
    Report report = begin(effect.message);
    put(report, effect.block, block);
    put(report, effect.constant_force);
    put(report, effect.duration, effect.duration_counts);
    put(report, effect.gain, effect.gain.max);
    // With a direction the bits of the axes count for nothing, and some devices then want them clear.
    put(report, effect.direction_enable.exists() ? effect.direction_enable : effect.axis_enable, 1);
    if (effect.direction.exists()) put(report, effect.direction, at(effect.direction, east));
    return report;
}

Report force_report(const PidLayout& layout, std::int64_t block, double fraction) noexcept {
    const Spot& magnitude = layout.force.magnitude;
    const double sound = std::isfinite(fraction) ? std::clamp(fraction, -1.0, 1.0) : 0.0;
    const auto full = static_cast<double>(std::min(magnitude.max, -magnitude.min));
    Report report = begin(layout.force.message);
    put(report, layout.force.block, block);
    put(report, magnitude, std::llround(-sound * full));
    return report;
}

Report operation_report(const PidLayout& layout, std::int64_t block, const Choice& operation) noexcept {
    Report report = begin(layout.operation.message);
    put(report, layout.operation.block, block);
    put(report, operation);
    put(report, layout.operation.loops, 1);
    return report;
}

Report free_report(const PidLayout& layout, std::int64_t block) noexcept {
    Report report = begin(layout.free.message);
    put(report, layout.free.block, block);
    return report;
}

BlockLoad read_block_load(const PidLayout& layout, std::span<const std::uint8_t> report) noexcept {
    using Status = BlockLoad::Status;
    const auto& load = layout.load;
    if (!is_of(load.message, report)) return {};
    const auto is = [&](const Choice& choice) { return choice.exists() && get(report, choice.spot) == choice.value; };
    if (is(load.full)) return {.status = Status::full};
    if (is(load.error)) return {.status = Status::error};
    if (!is(load.success)) return {};
    const std::int64_t block = get(report, load.block);
    // A block that another report cannot name would be cut there, and another effect would play.
    for (const Spot& spot : {load.block, layout.effect.block, layout.force.block, layout.operation.block})
        if (block < std::max<std::int64_t>(spot.min, 1) || block > spot.max) return {.status = Status::error};
    return {.status = Status::success, .block = block};
}

std::optional<std::int64_t> read_axis(const PidLayout& layout, std::span<const std::uint8_t> report) noexcept {
    if (!is_of(layout.axis.message, report)) return std::nullopt;
    const Spot& spot = layout.axis.value;
    const std::int64_t counts = get(report, spot);
    if (counts < spot.min || counts > spot.max) return std::nullopt;
    return counts;
}

bool is_safety_switch_closed(const PidLayout& layout, std::span<const std::uint8_t> report) noexcept {
    return is_of(layout.state.message, report) && get(report, layout.state.safety) == 1;
}

std::optional<Hindrance> read_state(const PidLayout& layout, std::span<const std::uint8_t> report,
                                    bool has_safety_switch) noexcept {
    const auto& state = layout.state;
    if (!is_of(state.message, report)) return std::nullopt;
    const auto is = [&](const Spot& spot, std::int64_t value) { return spot.exists() && get(report, spot) == value; };
    if (is(state.paused, 1)) return Hindrance::paused;
    if (is(state.power, 0)) return Hindrance::power;
    if (has_safety_switch && is(state.safety, 0)) return Hindrance::safety_switch;
    if (is(state.enabled, 0)) return Hindrance::disabled;
    return Hindrance::none;
}

}  // namespace kerf::hid_force
