// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "conformance/subject.h"
#include "core/haptics/scene/simulation.h"

namespace kerf::conformance {

/// Above the bone, where tests begin [m].
inline constexpr double above = 0.5e-3;

/// A block of bone whose face is z = 0, as large as a tool needs.
struct RigSettings {
    double thickness = 0.0;          ///< [m]; 0: more than the tool goes deep
    double density = 1850.0;         ///< [kg/m³]
    double spacing = 0.25e-3;        ///< [m]
    Quat turn{1, 0, 0, 0};           ///< of bone and tool together against the grid
    double period = Simulation::dt;  ///< [s]
    bool is_running = true;          ///< its drives at their defaults, or turned as it is fed; else at rest
};

/// A tool with its law in a block of bone, in a simulation of the host. The tool is fed as it declares: along its axis
/// with its tip in front, turning if it is fed so; or across its axis, lying on the face with its x into the bone.
/// [main]
class ToolRig {
public:
    /// The subject must outlive it.
    ToolRig(const Subject& subject, const RigSettings& settings);
    ToolRig(const ToolRig&) = delete;
    ToolRig& operator=(const ToolRig&) = delete;

    [[nodiscard]] bool is_fed_sideways() const noexcept { return setup_.tool->tool->feed == KERF_FEED_SIDE; }
    /// How deep a tool is fed so that it cuts with its full width [m].
    [[nodiscard]] double working_depth() const noexcept;
    [[nodiscard]] Simulation& simulation() noexcept { return simulation_; }
    [[nodiscard]] const ToolOutline& outline() const noexcept { return outline_; }

    /// Stays above the bone until a motor has come to its speed.
    void run_up();
    /// One tick with the tool led to a pose of the block.
    TickResult lead(const Pose& block_from_tool);
    /// One tick with the tool led to a depth: of its tip, or of its side where it is widest [m].
    TickResult lead(double depth, double aside = 0.0, double tilt = 0.0);
    /// How deep the tool is now [m].
    [[nodiscard]] double depth();
    /// The force of the bone against the feed [N].
    [[nodiscard]] double thrust(const TickResult& tick) const noexcept;
    /// The volume below the face that its cutting part sweeps on its way to `depth` [m³]; `with_crests`: with the
    /// cylinder over its thread, as crests that are not turned shear the bone between them.
    [[nodiscard]] double swept(double depth, bool with_crests = false) const;
    /// Leads the tool straight from one depth to the other at `speed` [m/s], and returns the ticks.
    std::vector<TickResult> feed(double from, double to, double speed);
    /// One tick with a hand of 10 kg on the bone's side that pushes straight down with `push` [N].
    TickResult push(double push);
    /// Sets all drives to this fraction of their defaults [–].
    void drive(double fraction);
    /// Bone that is removed by now [m³].
    [[nodiscard]] double removed();
    /// Of a tick: along the shaft, and across it along x and y of the block [N], on the tool.
    [[nodiscard]] Vec3 force_in_block(const TickResult& tick) const noexcept;
    [[nodiscard]] double period() const noexcept { return settings_.period; }

private:
    [[nodiscard]] Pose placed(const Pose& in_block) const noexcept;
    [[nodiscard]] Pose fed_to(double depth, double tilt = 0.0, double aside = 0.0) const noexcept;
    [[nodiscard]] double half_length() const noexcept;

    RigSettings settings_;
    ToolSetup setup_;
    ToolOutline outline_;
    kerf_profile_point widest_{};                    ///< of what cuts
    double hand_depth_ = -above, hand_speed_ = 0.0;  ///< [m], [m/s]
    Body body_;
    Simulation simulation_;
};

}  // namespace kerf::conformance
