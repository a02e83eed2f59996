// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/field/bone_view.h"
#include "core/haptics/coupling.h"
#include "core/haptics/solve.h"

/// One tool in one body: the haptic loop's tick, from pose read to force out.
namespace kerf {

/// What the device reported at the start of a tick.
struct DeviceSample {
    Pose world_from_handle = identity_pose();  ///< where the hand wants the tool
};

/// What one tick came to. Wrenches: world frame. Bone newtons unless said otherwise.
struct TickResult {
    Pose world_from_tool = identity_pose();
    Vec6 rate{};           ///< of the tool, tool frame
    Vec6 bone_on_tool{};   ///< modelled, about the tip
    Vec6 coupled_on_hand{};   ///< what an unlimited coupling would carry, at the grip
    Vec6 limited_on_hand{};   ///< what it carried
    Vec6 commanded{};      ///< to the device [device newtons]
    double thrust = 0.0;   ///< [N] bone on tool, against the shaft
    double torque = 0.0;   ///< [N·m] about the shaft
    double power_hand = 0.0;  ///< [W] from the hand into the tool
    int iterations = 0;
    int closed_records = 0;   ///< read with Simulation::closed_record
    bool is_cutting = false;  ///< the plugin removed bone in this tick
    bool is_quarantined = false;  ///< the law was unsound or the solve failed: force released
    int event_count = 0;
    const char* events[KERF_MAX_ACTIONS]{};
};

/// A tool of a plugin, with its parameters: everything the loop needs to ask it.
struct ToolSetup {
    const kerf_component* tool = nullptr;
    const kerf_component* force = nullptr;
    std::vector<double> tool_parameters, force_parameters, drives;  ///< SI, declared order
};

/// A tool's outline as the plugin gives it.
struct ToolOutline {
    RevolutionSolid cutting;  ///< removes bone
    RevolutionSolid whole;
    double grip_z = -0.1;     ///< [m]
};
/// Asks the plugin; on failure `error` says why.   [main]
[[nodiscard]] bool outline_of(const ToolSetup& setup, ToolOutline& out, std::string& error);

class Simulation {
public:
    static constexpr double dt = 1e-3;  ///< [s] nominal, always

    /// Pre: `outline_of` succeeded for this setup. Starts with the tool at `start` and everything uncut.   [main]
    Simulation(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains, const Pose& start);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// One millisecond.   [haptic, nonblocking]
    TickResult tick(const DeviceSample& sample) noexcept;

    /// `coupling: direct`: the tool is where the device says, the law is evaluated at the device's rate, and nothing
    /// is solved. Shows where the papers' way fails, and prescribes a feed exactly in tests.   [haptic, nonblocking]
    TickResult tick_direct(const DeviceSample& sample) noexcept;

    /// Stamps the records closed since the last call into the exact field and makes room for coming cuts. In lock-step
    /// it follows every tick; it may allocate.   [worker]
    void after_tick();
    /// Closes and commits everything: both fields then hold the same bits.   [main]
    void finish();

    /// 0 … TickResult::closed_records − 1, of the last tick.
    [[nodiscard]] const CutRecord& closed_record(int i) const noexcept { return tracker_.closed(i); }
    [[nodiscard]] const CutField& exact() const noexcept { return exact_; }
    [[nodiscard]] CutField& exact() noexcept { return exact_; }
    [[nodiscard]] const CutField& committed() const noexcept { return committed_; }
    [[nodiscard]] const BoneView& bone() const noexcept { return view_; }
    [[nodiscard]] const Pose& world_from_tool() const noexcept { return world_from_tool_; }
    [[nodiscard]] const ToolOutline& outline() const noexcept { return outline_; }
    [[nodiscard]] const double* signals() const noexcept { return signals_; }
    [[nodiscard]] const CutTracker& tracker() const noexcept { return tracker_; }
    [[nodiscard]] std::uint64_t ticks() const noexcept { return tick_; }
    /// The plugin's state, as bytes.
    [[nodiscard]] const std::byte* state() const noexcept { return state_; }
    [[nodiscard]] std::size_t state_size() const noexcept { return setup_.force->force->state_size; }

private:
    [[nodiscard]] bool ask(kerf_law& law) noexcept;
    void commit(const Vec6& rate, const double* lambda, TickResult& result) noexcept;
    void report_wrench(const Vec6& bone_on_tool_in_tool, TickResult& result) const noexcept;
    [[nodiscard]] kerf_tick_in tick_in() const noexcept;
    Vec6 estimated_hand_rate(const Pose& world_from_handle) noexcept;

    const Body* body_;
    ToolSetup setup_;
    ToolOutline outline_;
    CouplingGains gains_;
    CutField committed_, exact_;
    CutTracker tracker_;
    BoneView view_;

    std::unique_ptr<std::byte[]> state_storage_;
    std::byte* state_ = nullptr;
    double signals_[KERF_MAX_SIGNALS]{};
    kerf_channel channels_[KERF_MAX_CHANNELS]{};
    std::uint32_t channel_count_ = 0;
    /// λ̄, by channel id: what `follow` goes with.
    struct Filtered {
        std::uint32_t id = 0;
        double lambda = 0.0;
    };
    Filtered filtered_[KERF_MAX_CHANNELS]{};
    std::uint32_t filtered_count_ = 0;
    [[nodiscard]] double filtered_lambda(std::uint32_t id) const noexcept;
    [[nodiscard]] Vec6 following(const Balance& balance) const noexcept;
    void filter_lambda(const Balance& balance, const Motion& motion) noexcept;

    Pose world_from_tool_;
    Pose last_handle_;
    Vec6 hand_rate_first_{}, hand_rate_{};  ///< two poles at 100 Hz, world frame
    Vec3 slip_{};                           ///< how far the coupling's anchor has slid, world frame [m]
    Quat rotation_slip_{1, 0, 0, 0};
    std::uint64_t tick_ = 0;
    std::vector<CutRecord> to_stamp_;
};

}  // namespace kerf
