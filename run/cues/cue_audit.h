// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/run_observer.h"
#include "run/scene.h"

/// What a hand can feel of an operation on a device.
namespace kerf::run {

/// Smallest relative change of a force that a hand notices, 7 % over 2.5 N to 10 N [pang-1991].
inline constexpr double just_noticeable = 0.07;  // [–]

/// Returns the distance between two forces of a device in just-noticeable differences:
///     n = |ln(max(a, f) / max(b, f))| / ln(1 + 0.07)
/// with the friction f of the device: a force below it is not felt. All in newtons.   [any] pure
[[nodiscard]] double noticeable_steps(double a, double b, double friction) noexcept;

/// The cues of one step.
struct StepCues {
    std::string step{};                ///< id
    double time_in_bone = 0.0;         ///< [s] with a force of the bone
    double below_friction = 0.0;       ///< [–] of that time: the device's force is below its own friction
    double saturated = 0.0;            ///< [–] of that time: the device's limits cut the force by more than 0.1 %
    std::optional<double> contrast{};  ///< just-noticeable differences between the densest tissue and the next one
    std::optional<double> exit{};      ///< the same for the last breakthrough: before and after the far wall
};

/// Watches a run, and sums up what its device makes felt.
class CueAudit final : public RunObserver {
public:
    /// Pre: the scene outlives this object and was made for the device.
    explicit CueAudit(const Scene& scene);

    void on_tick(const session::TickRow& row) override;
    /// Returns the cues of the steps in which the tool was in bone.   [main] after the run
    [[nodiscard]] std::vector<StepCues> cues() const;

private:
    struct OfStep {
        std::uint64_t in_bone = 0, below_friction = 0, saturated = 0;
        std::vector<std::vector<float>> by_tissue;  ///< [N] device newtons, where the tool is fed
        std::vector<float> before_exit;             ///< [N] of the last stretch in the densest tissue
        std::vector<float> after_exit;              ///< [N] beyond it
        double wall_end = 0.0;                      ///< [m] depth of the tip when it was last in the densest tissue
        std::optional<double> exit;                 ///< of the last breakthrough that is complete
    };
    void follow_wall(const session::TickRow& row, double force, OfStep& step) const;
    [[nodiscard]] std::optional<double> contrast_of(const OfStep& step) const;
    [[nodiscard]] std::optional<double> exit_of(const OfStep& step) const;

    const Scene& scene_;
    std::size_t densest_;  ///< of the bone's tissues
    std::vector<OfStep> steps_;
};

}  // namespace kerf::run
