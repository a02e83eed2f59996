// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Times of one tick on the clock. Nothing of them enters a result, a record or a hash.
namespace kerf::run {

/// Returns the time of CLOCK_MONOTONIC [ns].   [haptic] no system call: the kernel's page is read
[[nodiscard]] std::int64_t monotonic_time() noexcept;
/// Returns the processor time of the calling thread [ns].   [haptic] a system call
[[nodiscard]] std::int64_t thread_time() noexcept;

/// The parts of a tick of a run, in their order.
enum class TickPart : std::uint8_t {
    change,  ///< the loop takes over changes that the run has prepared: a tool, bodies
    inputs,  ///< inputs of the hand other than motion
    hand,    ///< the pose is read, the force is sent
    motion,  ///< from the pose to the force
};
inline constexpr std::size_t tick_part_count = 4;

/// Returns a few words for people: "motion and force".   [any]
[[nodiscard]] const char* to_text(TickPart part) noexcept;

/// Measures the parts of a tick [ns].
class TickParts {
public:
    /// Starts a tick.   [haptic]
    void begin() noexcept {
        times_ = {};
        last_ = monotonic_time();
    }
    /// Adds the time since the last call to a part.   [haptic]
    void end_of(TickPart part) noexcept {
        const std::int64_t now = monotonic_time();
        times_[static_cast<std::size_t>(part)] += now - last_;
        last_ = now;
    }
    [[nodiscard]] TickPart longest() const noexcept;
    [[nodiscard]] std::int64_t time_of(TickPart part) const noexcept { return times_[static_cast<std::size_t>(part)]; }

private:
    std::array<std::int64_t, tick_part_count> times_{};
    std::int64_t last_ = 0;
};

/// One tick on the clock; times are of CLOCK_MONOTONIC [ns].
struct TickTrace {
    std::uint64_t tick = 0;      ///< ticks before it
    std::int64_t due = 0;        ///< the time at which it was due, before periods were skipped
    std::int64_t begun = 0;      ///< its pose was read
    std::int64_t done = 0;       ///< its force was out, and the rest of the tick was done
    std::int64_t computed = 0;   ///< processor time of its thread between the two [ns]
    std::uint32_t missed = 0;    ///< periods without a tick before it
    TickPart longest{};          ///< the part that took longest
    std::int64_t part_time = 0;  ///< the time of that part [ns]

    [[nodiscard]] std::int64_t response() const noexcept { return done - due; }
};

}  // namespace kerf::run
