// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/law/call_times.h"
#include "core/haptics/law/evaluate_law.h"
#include "core/haptics/law/law_fault.h"
#include "core/haptics/law/tool.h"
#include "core/plugin/law_memory.h"

namespace kerf {

/// The motion of the tool in one step of a tick, with the forces at that motion.
struct AppliedMotion {
    Vec6 rate{};                     ///< of the tool, tool frame [m/s, rad/s]
    const double* lambda = nullptr;  ///< of each channel [N]
    Vec6 following{};                ///< Σ follow λ̄ and the law's own wrench, tool frame [N, N·m]
    double dt = 0.0;                 ///< [s]
};

/// What the plugin's `commit` returned for an applied motion.
struct CommittedLaw {
    std::array<kerf_action, KERF_MAX_ACTIONS> action;  ///< the first `action_count` are set
    std::uint32_t action_count = 0;
    kerf_thread thread{};
    bool has_thread = false;
    bool is_sound = true;  ///< false: `LoopTools::fault` has the reason, and there are no actions
};

/// The tools of a loop. One of them is in hand: this class keeps its drives, the state and signals of its plugin and
/// the last evaluation of its law.
class LoopTools {
public:
    /// Takes up the first tool. Pre: there is at least one, and `outline_of` succeeded for each.   [main]
    explicit LoopTools(std::vector<Tool> tools);

    [[nodiscard]] std::size_t in_hand() const noexcept { return in_hand_; }
    [[nodiscard]] const ToolSetup& setup() const noexcept { return tools_[in_hand_].setup; }
    [[nodiscard]] const ToolOutline& outline() const noexcept { return tools_[in_hand_].outline; }

    /// Returns the cutting solid of each tool, then the cylinder over the thread of each: the order of the solid
    /// numbers in cut records.   [main]
    [[nodiscard]] std::vector<const ToolSolid*> cutting_solids() const;
    [[nodiscard]] const ToolSolid& solid(std::size_t number) const noexcept {
        return number < tools_.size() ? tools_[number].outline.cutting : tools_[number - tools_.size()].outline.crest;
    }
    /// Returns the number of the cylinder over the thread of the tool in hand.
    [[nodiscard]] std::size_t crest_number() const noexcept { return tools_.size() + in_hand_; }

    /// Takes up another tool. `begin` must follow.   [main] between ticks
    void take(std::size_t tool) noexcept;
    /// Starts the law of the tool in hand: default drives, zero signals, a new state.   [main] between ticks
    void begin(const kerf_bone_query& bone, double dt, std::uint64_t tick) noexcept;
    /// Sets a drive, clamped to its range. Ignores NaN and drives that the tool does not have. Returns whether the
    /// drive has changed.   [haptic, nonblocking]
    bool command_drive(std::size_t drive, double value) noexcept;

    /// Returns whether any drive of the tool in hand is commanded to run.   [haptic, nonblocking]
    [[nodiscard]] bool is_driven() const noexcept;

    /// Evaluates the law for a step of `dt` [s]. Returns false if it is unsound; `fault` then describes it.
    /// [haptic, nonblocking]
    [[nodiscard]] bool evaluate(const Surroundings& around, double dt, std::uint64_t tick) noexcept;
    /// Stores a fault of the law in hand. Always returns false.   [haptic, nonblocking]
    bool reject(LawFault fault) noexcept;
    /// Calls the plugin's `commit` with an applied motion, and returns its actions and thread. Keeps the signals of the
    /// last sound call.   [haptic, nonblocking]
    [[nodiscard]] CommittedLaw commit(const AppliedMotion& applied, const kerf_bone_query& bone,
                                      std::uint64_t tick) noexcept;

    /// Evaluates the law with another query of the bone, and stores nothing of it. Returns the plugin's status. [main]
    [[nodiscard]] kerf_status evaluate_with(const kerf_bone_query& bone, double dt, std::uint64_t tick,
                                            kerf_law& law) const noexcept;
    /// Returns the law as `evaluate` found it last.
    [[nodiscard]] const EvaluatedLaw& law() const noexcept { return law_; }
    /// Returns the last fault that was rejected.
    [[nodiscard]] const LawFault& fault() const noexcept { return fault_; }
    [[nodiscard]] const double* signals() const noexcept { return signals_; }
    /// Returns the plugin's state, as bytes.
    [[nodiscard]] const std::byte* state() const noexcept { return memory_->state(); }
    /// Returns one line of text for each law that was slower than it declares: see `over_budget`.   [main]
    [[nodiscard]] std::vector<std::string> laws_over_budget() const;

private:
    [[nodiscard]] kerf_tick_in tick_in(const kerf_bone_query& bone, double dt, std::uint64_t tick) const noexcept;

    std::vector<Tool> tools_;  ///< cut records identify a tool by its index here
    std::size_t in_hand_ = 0;
    std::array<double, KERF_MAX_DRIVES> drives_{};  ///< as commanded
    kerf_solid solid_{};                            ///< of the tool in hand
    std::unique_ptr<LawMemory> memory_;             ///< large enough for every law
    double signals_[KERF_MAX_SIGNALS]{};
    EvaluatedLaw law_;
    LawFault fault_;
    ClockScale clock_scale_;
    std::vector<CallTimes> resist_times_;  ///< of each tool
};

}  // namespace kerf
