// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/field/spsc_ring.h"
#include "core/haptics/loop/loop_change.h"
#include "core/haptics/loop/tick_result.h"

/// What a loop on the clock and the run that records it exchange. The run repeats each tick of the loop: it has the
/// same bits, and makes everything that takes longer than a tick.
namespace kerf::run {

/// What the loop reports to the run, in order.
struct LoopMessage {
    enum class Kind : std::uint8_t {
        tick,        ///< a tick ran with `sample`
        changed,     ///< before the next tick, the posted change was taken over
        refused,     ///< before the next tick, the posted undo or redo was refused: the tool is in bone or has cut
        outdated,    ///< the posted change needs a new offer
        separation,  ///< the posted separation needs a new offer
        leg,         ///< the rehearsal's inputs after leg `index` are due
        action,      ///< the next action of the step, `index`, was requested
        drive,       ///< drive `index` was set to `value`
        regrip,      ///< the tool is loose about its shaft (`value` 1), or gripped again (0)
        undo,        ///< an undo was requested
        repeated,    ///< input `index` of the recorded run with which this one begins
        pause,       ///< before the next tick, the run was paused
        ended,       ///< the loop has ended, for the reason `index`, a `RunEnd`
    } kind;
    bool has_adopted = false;  ///< `tick`: after it, the loop took over the posted separation
    DeviceSample sample{};
    std::uint64_t bits = 0;  ///< `tick`: of its result, by `bits_of`
    std::size_t index = 0;
    double value = 0.0;
};

/// Returns a number that differs, almost surely, if force or pose of two results differ in a bit.
/// [haptic, nonblocking] pure.
[[nodiscard]] std::uint64_t bits_of(const TickResult& result) noexcept;

/// A value that one thread posts to another, and gets back when the other has taken it over.
template <class T>
class PostBox {
public:
    /// Posts a value. Pre: the last one is back.   [run]
    void post(T value) {
        value_ = std::move(value);
        is_out_.store(true, std::memory_order_release);
    }
    /// Returns the posted value, or null.   [haptic, nonblocking]
    [[nodiscard]] T* posted() noexcept { return is_out_.load(std::memory_order_acquire) ? &value_ : nullptr; }
    /// Gives the value back, with what it replaced.   [haptic, nonblocking]
    void give_back() noexcept { is_out_.store(false, std::memory_order_release); }
    /// Destroys the value that is back.   [run]
    void empty() { value_ = {}; }
    [[nodiscard]] bool is_out() const noexcept { return is_out_.load(std::memory_order_acquire); }

private:
    T value_{};
    std::atomic<bool> is_out_{false};
};

/// A change with the step that runs from then on.
struct PostedChange {
    LoopChange change;
    std::size_t step = 0;
    std::uint64_t adopted = 0;  ///< number of separations that the run had made when it posted the change
    // As in the recorded run with which this one begins:
    std::uint64_t due = 0;    ///< number of ticks before which the loop does not take it over
    bool is_refused = false;  ///< the loop refused it
};

/// A separation, with the number of changes that the run had made when it posted it.
struct PostedSeparation {
    Offer offer;
    std::uint64_t changes = 0;
};

struct LoopLink {
    static constexpr std::size_t capacity = 1 << 15;  // messages: the run may be half a minute behind

    SpscRing<LoopMessage> messages{capacity};  ///< from the loop to the run
    PostBox<PostedChange> change;
    PostBox<PostedSeparation> separation;
    std::atomic<std::uint64_t> separation_due{0};  ///< number of ticks after which the loop takes it over
    std::atomic<bool> is_busy{false};      ///< changes of the run wait for an earlier one, or a step for its tool
    std::atomic<bool> should_stop{false};  ///< the run has ended
    std::atomic<bool> is_overrun{false};   ///< the run is `capacity` messages behind: the loop has ended
};

}  // namespace kerf::run
