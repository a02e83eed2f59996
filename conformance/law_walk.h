// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "conformance/plane_bone.h"
#include "conformance/subject.h"
#include "conformance/words.h"
#include "core/haptics/law/channel.h"
#include "core/haptics/watch/watch.h"
#include "core/plugin/guarded_memory.h"

namespace kerf::conformance {

/// Memory of a law that crashes when it is misused, so that the crash names what was done.
struct Guards {
    bool inputs = false;      ///< they cannot be written to
    bool input_ends = false;  ///< nothing behind them can be touched
    bool output_ends = false;
    bool state_end = false;
};

/// What a call of a law called that it must not.
struct Offence {
    const char* function = nullptr;  ///< null: nothing
    std::string call, where;         ///< "resist", "at tick 812, …"
};

/// How a law is walked.
struct WalkSettings {
    PlaneBone::Settings bone{};
    double dt = 1e-3;                                                                    ///< [s]
    std::optional<std::vector<double>> tool_parameters{}, force_parameters{}, drives{};  ///< none: the defaults
    Guards guards{};                  ///< which memory crashes when it is misused
    bool is_watched = false;          ///< `offence` tells what its calls called
    bool keeps_state = false;         ///< `state_before_resist` is kept
    unsigned char state_fill = 0xa5;  ///< of the state's bytes before it begins
};

/// A law called by hand, without a simulation: along a path in exact bone that nothing removes, with the motion
/// prescribed. So each call can be repeated, reordered and watched.   [main]
class LawWalk {
public:
    explicit LawWalk(const Subject& subject, const WalkSettings& settings = {});
    ~LawWalk();
    LawWalk(const LawWalk&) = delete;
    LawWalk& operator=(const LawWalk&) = delete;

    /// Why it cannot be walked; empty if it can.
    [[nodiscard]] const std::string& refusal() const noexcept { return refusal_; }

    /// Calls `begin`, at `pose`.
    void begin(const Pose& pose);
    /// Commits in air until a motor has come to its speed.
    void run_up();
    /// Calls `resist` where the tool is.
    kerf_status resist();
    /// Calls `resist` where the tool is, in another bone, without leaving a trace of it here.
    kerf_status resist_in(PlaneBone& bone);
    /// Calls `commit` for the motion from where the tool is to `next`, and moves it there.
    kerf_status commit(const Pose& next);
    /// Puts the tool somewhere else without a motion.
    void place(const Pose& pose) noexcept;

    /// What the last `resist` returned.
    [[nodiscard]] const kerf_law& law() const noexcept { return *law_; }
    [[nodiscard]] std::span<const kerf_channel> channels() const noexcept {
        return {law_->channel, law_->count < KERF_MAX_CHANNELS ? law_->count : KERF_MAX_CHANNELS};
    }
    /// What the last `commit` returned.
    [[nodiscard]] const kerf_commit_out& committed() const noexcept { return *out_; }
    [[nodiscard]] const kerf_thread& thread() const noexcept { return *thread_; }
    /// Whether it still writes its thread where it was told to.
    [[nodiscard]] bool has_kept_thread() const noexcept { return out_->thread == thread_; }
    [[nodiscard]] std::span<const double> signals() const noexcept {
        return {out_->signal, subject_.force->force->signal_count};
    }
    [[nodiscard]] std::span<unsigned char> state() noexcept {
        return {static_cast<unsigned char*>(state_), subject_.force->force->state_size};
    }
    /// What the state was before the last `resist`. Pre: `keeps_state`.
    [[nodiscard]] std::span<const unsigned char> state_before_resist() const noexcept { return state_before_; }
    [[nodiscard]] PlaneBone& bone() noexcept { return bone_; }
    [[nodiscard]] const ToolOutline& outline() const noexcept { return outline_; }
    [[nodiscard]] const Subject& subject() const noexcept { return subject_; }
    [[nodiscard]] const Pose& pose() const noexcept { return pose_; }
    [[nodiscard]] std::uint64_t tick() const noexcept { return tick_; }
    [[nodiscard]] double dt() const noexcept { return settings_.dt; }
    /// The force on the tool of the law in hand at a rate of the tool, tool frame [N, N·m].
    [[nodiscard]] Vec6 force_at(const Vec6& rate) const noexcept;
    /// The rate of the tool from where it is to `next`, tool frame.
    [[nodiscard]] Vec6 rate_to(const Pose& next) const noexcept;

    /// Moves inputs and outputs to other memory; what was there before cannot be touched any more. Pre: input and
    /// output ends are guarded.
    void move_memory();
    /// Moves the state to other memory; what was there before is overwritten.
    void move_state();
    /// The first call of this kind in any call of the law so far. Pre: `is_watched`.
    [[nodiscard]] const Offence& offence(Forbidden kind) const noexcept {
        return offences_[static_cast<std::size_t>(kind)];
    }
    /// All numbers that the law has returned, as one.   [any]
    void add_to(std::uint64_t& hash) const noexcept;

    /// "at tick 812, the tip 0.43 mm below the face"
    [[nodiscard]] std::string where() const;

private:
    void allocate();
    void fill_outputs() noexcept;
    void before_call() noexcept;
    void after_call(const char* call);

    Subject subject_;
    WalkSettings settings_;
    ToolSetup setup_;
    ToolOutline outline_;
    std::string refusal_;
    PlaneBone bone_, air_;
    std::unique_ptr<GuardedMemory> guarded_;
    std::vector<std::unique_ptr<GuardedMemory>> retired_;
    std::vector<std::unique_ptr<std::byte[]>> plain_;
    std::unique_ptr<std::byte[]> plain_state_;
    std::vector<std::unique_ptr<std::byte[]>> kept_states_;
    GuardedMemory guarded_state_;
    std::vector<unsigned char> state_before_;
    std::array<Offence, static_cast<std::size_t>(Forbidden::count)> offences_;
    kerf_solid solid_{};
    kerf_tick_in in_{};
    void* state_ = nullptr;
    kerf_law* law_ = nullptr;
    kerf_commit_out* out_ = nullptr;
    kerf_thread* thread_ = nullptr;  ///< where it leaves one
    Pose pose_ = identity_pose();
    std::uint64_t tick_ = 0;
};

/// A tool that points straight down, its tip `depth` below z = 0, tilted by `tilt` about y.
[[nodiscard]] Pose at_depth(double depth, double tilt = 0.0, Vec3 aside = {0, 0, 0});

/// In, sideways, turning, out, and in again askew: about 1200 poses.
[[nodiscard]] std::vector<Pose> eventful_path();
/// Straight in and out again, 600 poses.
[[nodiscard]] std::vector<Pose> short_path();

/// Like `short_path`, with 80 poses far apart.
[[nodiscard]] std::vector<Pose> coarse_path();

/// What is not finite in the law in hand, or unsound in its channels; empty if nothing is.   [any]
[[nodiscard]] std::string fault_of_numbers(const LawWalk& law);
[[nodiscard]] std::string fault_of_channels(const LawWalk& law);

/// Walks a law along a path, and calls `after_resist` and `after_commit`, if given, at each pose, until one returns
/// false. Fails the test where a call of the law fails, and skips it where the tool cannot be made.
using AtPose = std::function<bool(LawWalk&)>;
void walk(Examination& exam, const WalkSettings& settings, const std::vector<Pose>& path, const AtPose& after_resist,
          const AtPose& after_commit = {});

}  // namespace kerf::conformance
