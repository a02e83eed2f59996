// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/haptics/loop/haptic_loop.h"
#include "documents/hand_input.h"
#include "run/run_result.h"

namespace kerf::run {

/// Requests of a hand other than motion. The loop carries out at once what takes no time; the run does the rest, and
/// records all.
class LoopInputs {
public:
    virtual ~LoopInputs() = default;
    /// The rehearsal's inputs after a leg.   [haptic, nonblocking]
    virtual void leg(std::size_t leg) noexcept = 0;
    /// The next action of the step.   [haptic, nonblocking]
    virtual void next_action() noexcept = 0;
    /// [haptic, nonblocking]
    virtual void undo() noexcept = 0;
    /// Runs the drives of the tool in hand as configured, or stops them.   [haptic, nonblocking]
    virtual void run_drives(bool is_running) noexcept = 0;
    /// Releases the tool about its shaft, or grips it again.   [haptic, nonblocking]
    virtual void loosen(bool is_loose) noexcept = 0;
    /// An input of the recorded run with which this one begins, by its index there.   [haptic, nonblocking]
    virtual void repeat(std::size_t index, const documents::HandInput& input) noexcept = 0;
};

/// The hand at a loop on the clock: simulated, or at a device.
class LiveHand {
public:
    virtual ~LiveHand() = default;
    /// Returns whether no tick is to run in this period. No simulated time passes then, whatever the clock does.
    /// [haptic, nonblocking]
    [[nodiscard]] virtual bool is_paused() noexcept { return false; }
    /// Begins where a recorded hand has left the handle.   [main] before the first tick of this hand
    virtual void continue_at(const Pose& /*world_from_handle*/) {}
    /// Requests what is due before the next tick.   [haptic, nonblocking]
    /// @param missed  periods that passed without a tick
    /// @param last    result of the last tick
    virtual void act(std::uint32_t missed, const TickResult& last, LoopInputs& inputs) noexcept = 0;
    /// Returns the pose for the next tick.   [haptic, nonblocking]
    [[nodiscard]] virtual DeviceSample sample(const HapticLoop& loop) noexcept = 0;
    /// Lets a hand that cannot see whether its requests were carried out wait for the run, or continue (false).
    /// [haptic, nonblocking]
    virtual void wait(bool /*waits*/) noexcept {}
    /// Returns a number that changes where the hand would wait: after a leg of its path.   [haptic, nonblocking]
    [[nodiscard]] virtual std::size_t milestone() const noexcept { return 0; }
    /// Gets the force of a tick.   [haptic, nonblocking]
    virtual void feel(const TickResult& result, const HapticLoop& loop) noexcept = 0;
    /// Notices that the loop has taken a tool, which begins with its configured drives.   [haptic, nonblocking]
    virtual void take_tool() noexcept {}
    /// Notices that another step of the procedure runs.   [haptic, nonblocking]
    virtual void follow_step(std::size_t /*step*/) noexcept {}
    /// Returns the reason to end the run after this tick; nothing to continue.   [haptic, nonblocking]
    [[nodiscard]] virtual std::optional<RunEnd> end() const noexcept = 0;
    /// Ends the force after the last tick.   [haptic, nonblocking]
    virtual void rest() noexcept {}
};

}  // namespace kerf::run
