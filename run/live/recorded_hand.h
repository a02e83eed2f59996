// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "run/live/live_hand.h"
#include "run/run_procedure.h"

namespace kerf::run {

/// The hand of a recorded run at a loop: it repeats the poses and requests of the record, tick by tick.
class RecordedHand final : public LiveHand {
public:
    /// Pre: `beginning` outlives this object.
    explicit RecordedHand(const RunBeginning& beginning) : beginning_(&beginning) {}

    /// Returns the number of missed periods before the next tick.
    [[nodiscard]] std::uint32_t missed() noexcept;

    void act(std::uint32_t missed, const TickResult& last, LoopInputs& inputs) noexcept override;
    [[nodiscard]] DeviceSample sample(const HapticLoop& loop) noexcept override;
    void feel(const TickResult& /*result*/, const HapticLoop& /*loop*/) noexcept override {}
    [[nodiscard]] std::optional<RunEnd> end() const noexcept override { return std::nullopt; }

private:
    const RunBeginning* beginning_;
    std::uint64_t tick_ = 0;  ///< the next one
    std::size_t next_input_ = 0, next_missed_ = 0, next_lost_ = 0;
    bool is_lost_ = false;
};

}  // namespace kerf::run
