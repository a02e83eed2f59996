// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "run/device/mouse_hand.h"
#include "run/live/live_hand.h"
#include "run/scene.h"

namespace kerf::run {

/// A hand whose aim a mouse moves. It ends no run: the steps, the time limit or an observer do.
class LiveMouse final : public LiveHand {
public:
    /// Pre: `box` outlives this object, which reads it.   [main]
    /// @param rehearsal  it gives the angles after which a wrist regrips; nothing else of it counts
    LiveMouse(MouseBox& box, const Scene& scene, const documents::Rehearsal& rehearsal, const Pose& world_from_tool);

    [[nodiscard]] bool is_paused() noexcept override;
    void continue_at(const Pose& world_from_handle) override;
    void act(std::uint32_t missed, const TickResult& last, LoopInputs& inputs) noexcept override;
    [[nodiscard]] DeviceSample sample(const HapticLoop& /*loop*/) noexcept override {
        return {.world_from_handle = hand_.reported()};
    }
    void feel(const TickResult& result, const HapticLoop& loop) noexcept override;
    void take_tool() noexcept override;
    void follow_step(std::size_t step) noexcept override;
    [[nodiscard]] std::optional<RunEnd> end() const noexcept override { return std::nullopt; }

private:
    MouseBox* box_;
    struct Step {
        double feed = 0.0, regrip = 0.0;  ///< [m/s], [rad]
    };
    std::vector<Step> steps_;
    Arm arm_;
    MouseHand hand_;
    MouseTotals totals_;             ///< newest
    std::uint32_t actions_, undos_;  ///< carried out
    bool is_driving_ = true;         ///< the drives of the tool in hand are as configured; false: they are off
    bool is_loose_ = false;
    bool has_begun_ = true;  ///< false: drives and grip are as another hand has left them
};

}  // namespace kerf::run
