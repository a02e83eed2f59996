// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "pid_layout.h"

/// Reports of devices with force feedback, as pure functions of a layout.
namespace kerf::hid_force {

/// A report for the device: its id, then its data.
struct Report {
    std::array<std::uint8_t, max_report> bytes{};
    std::size_t size = 0;  ///< [bytes]
    hid::ReportKind kind = hid::ReportKind::output;

    [[nodiscard]] std::span<const std::uint8_t> data() const noexcept { return {bytes.data(), size}; }
};

/// Writes a value, clamped to the range of its spot. Does nothing if the report has no such spot.
void put(Report& report, const Spot& spot, std::int64_t value) noexcept;
/// Returns a value, with the sign that its range has; 0 if the report has no such spot or is too short.
[[nodiscard]] std::int64_t get(std::span<const std::uint8_t> report, const Spot& spot) noexcept;

[[nodiscard]] Report control_report(const PidLayout& layout, const Choice& choice) noexcept;
/// @param fraction  [–] of the full gain, 0 to 1
[[nodiscard]] Report gain_report(const PidLayout& layout, double fraction) noexcept;
[[nodiscard]] Report create_report(const PidLayout& layout) noexcept;
/// Sets a constant force of `effect_duration` along the axis. Its direction is a quarter of the circle, so from the
/// positive end of the axis.
[[nodiscard]] Report effect_report(const PidLayout& layout, std::int64_t block) noexcept;
/// The class states where a force comes from: with the direction of `effect_report`, a positive magnitude makes the
/// counts of the axis fall. So the magnitude has the other sign.
/// @param fraction  [–] of the full torque, -1 to 1, positive where the counts rise; a value that is no number counts
/// as
///                  0
///
/// Source: Microsoft, DirectX 9, "Effect Direction"; `FFBoard/Src/EffectsCalculator.cpp` of OpenFFBoard negates it,
/// too.
[[nodiscard]] Report force_report(const PidLayout& layout, std::int64_t block, double fraction) noexcept;
[[nodiscard]] Report operation_report(const PidLayout& layout, std::int64_t block, const Choice& operation) noexcept;
[[nodiscard]] Report free_report(const PidLayout& layout, std::int64_t block) noexcept;

/// The answer to the creation of an effect.
struct BlockLoad {
    enum class Status : std::uint8_t { pending, success, full, error };
    Status status = Status::pending;
    std::int64_t block = 0;
};
/// Reads the block load report. A block outside the range that its layout states is an error.
[[nodiscard]] BlockLoad read_block_load(const PidLayout& layout, std::span<const std::uint8_t> report) noexcept;

/// Returns the counts of the axis; nothing if the report is another one or the counts are out of range.
[[nodiscard]] std::optional<std::int64_t> read_axis(const PidLayout& layout,
                                                    std::span<const std::uint8_t> report) noexcept;

/// Why a device makes no force at the moment, by its own report.
enum class Hindrance : std::uint8_t { none, paused, disabled, safety_switch, power };
/// Returns whether a report states that the safety switch is closed.
[[nodiscard]] bool is_safety_switch_closed(const PidLayout& layout, std::span<const std::uint8_t> report) noexcept;
/// Returns the hindrance; nothing if the report is another one.
/// @param has_safety_switch  whether the device has reported it closed. OpenFFBoard declares one and has none: it
/// always
///                           reports it open
[[nodiscard]] std::optional<Hindrance> read_state(const PidLayout& layout, std::span<const std::uint8_t> report,
                                                  bool has_safety_switch) noexcept;

}  // namespace kerf::hid_force
