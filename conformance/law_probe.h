// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "conformance/law_walk.h"

namespace kerf::conformance {

/// The response of a law to a steady motion of its tool.
struct Response {
    Vec6 wrench{};                  ///< on the tool, about its tip, tool frame; mean over the last half of the ticks
    double cutting = 0.0;           ///< [N] sum of λ over the cut channels, as that
    double loaded = 0.0;            ///< [N] sum of λ over all channels, as that
    int cut_ticks = 0;              ///< in which it requested a cut of its region
    int ticks = 0;                  ///< in all
    std::vector<double> signals{};  ///< of the last tick

    [[nodiscard]] Vec3 force() const noexcept { return linear(wrench); }
    [[nodiscard]] Vec3 torque() const noexcept { return angular(wrench); }
};

/// A law whose motor runs at its speed after a run-up in air, moved through exact bone from that state again and again.
/// [main]
class LawProbe {
public:
    explicit LawProbe(const Subject& subject, const WalkSettings& settings = {});
    LawProbe(const LawProbe&) = delete;
    LawProbe& operator=(const LawProbe&) = delete;

    /// Why it cannot be probed; empty if it can.
    [[nodiscard]] const std::string& refusal() const noexcept { return refusal_; }
    /// Moves the tool from `from` at a steady rate in its own frame.
    [[nodiscard]] Response move(const Pose& from, const Vec6& rate, int ticks = 40);
    /// Evaluates the law once, at a pose, in the state after the run-up. Returns whether it succeeded.
    bool evaluate(const Pose& at);
    [[nodiscard]] LawWalk& law() noexcept { return law_; }
    /// The rate of the tool that is fed as it declares, at `speed` [m/s].
    [[nodiscard]] Vec6 feed(double speed) const;
    /// How it is moved in solid bone at `speed` [m/s]: as it is fed, then across its feed in four directions unless it
    /// is turned, fed to one side, or declares that it does not resist that.
    [[nodiscard]] std::vector<std::pair<std::string, Vec6>> motions(double speed) const;
    /// A motion at `probe_speed` in solid bone, of 26, that the force helps more than any other.
    struct Help {
        double newtons = 0.0;  ///< that it helps with; 0: bone resists each motion
        double largest = 0.0;  ///< [N] of all forces
        Vec3 force{}, along{};
    };
    [[nodiscard]] Help largest_help();
    [[nodiscard]] bool is_threaded() const noexcept { return law_.outline().has_thread(); }

private:
    LawWalk law_;
    std::string refusal_;
    std::vector<unsigned char> ready_;
};

/// The force against a steady motion [N].   [any]
[[nodiscard]] double against(const Response& response, const Vec6& rate);
/// The drives of a tool at a fraction of their defaults, within their ranges.   [any]
[[nodiscard]] std::vector<double> drives_at(const kerf_component& tool, double fraction);
/// The 26 directions to the faces, edges and corners of a cube, unit.   [any]
[[nodiscard]] const std::array<Vec3, 26>& all_directions();
/// "(1.2, 0, -3) N"
[[nodiscard]] std::string in_newtons(Vec3 force);
/// "+x −y", of a direction in the tool's frame.
[[nodiscard]] std::string name_of_direction(Vec3 direction);
/// Rotates force and torque.
[[nodiscard]] Vec6 rotated(Quat by, const Vec6& wrench);

/// Returns the settings of a walk through bone without end.
[[nodiscard]] inline WalkSettings solid_bone(const PlaneBone::Settings& bone = {}) {
    WalkSettings settings;
    settings.bone = bone;
    settings.bone.shape = PlaneBone::Shape::endless;
    return settings;
}

inline constexpr double probe_speed = 0.5e-3;  ///< [m/s] slow enough for any motor

}  // namespace kerf::conformance
