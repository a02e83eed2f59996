// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// When the loop is called: always in time, or as late as measured, with or without the pauses of three ticks and more.
/// After a pause Kerf's loop lets its force fade, so the hand has to lean in again.
enum class Clock : std::uint8_t { in_time, without_pauses, measured };
inline constexpr int pause_periods = 3;

/// How late a machine calls the loop: draws from the lateness of a whole amputation on the clock. Each draw is the
/// largest of ten, so that late ticks are about ten times as frequent as measured. The sequence is always the same.
///
/// Source: 130 595 ticks of `kerf run procedures/amputation.yaml --live`, two shared cores, load 1.3, Linux 6.18, the
/// real-time class: 92 late ticks, 18 pauses of three ticks and more.
class Lateness {
public:
    /// Returns the lateness of the next tick [s], less than `limit`.
    [[nodiscard]] double next(double limit) noexcept;

private:
    /// Returns a number from 0 to 1, 1 excluded.
    [[nodiscard]] double draw() noexcept;

    std::uint32_t state_ = 21;
};

}  // namespace kerf::stability
