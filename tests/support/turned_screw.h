// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/haptics/loop/coupling.h"
#include "tests/support/drill_rig.h"

/// The screw of the implant plugin as the host loads it: its parts are found by name. The bone is a block with a pilot
/// hole along z; its face is z = 0.
namespace kerf::test {

/// A driver upright above `entry` that has turned by `angle` [rad] about its shaft, its tip `depth` [m] below.
inline Pose turned_at(double depth, double angle, Vec3 entry = {0, 0, 0}) {
    Pose pose = at_depth(depth, 0.0, entry);
    pose.rotation = pose.rotation * quat_from_rotation_vector({0, 0, std::remainder(angle, 2.0 * pi)});
    return pose;
}

/// A tool of the plugin with some parameters set, of the tool or of the law [SI]. Throws on a name that neither has.
inline ToolSetup threaded(const std::string& tool, const std::map<std::string, double>& set = {}) {
    constexpr const char* law = "screw_insertion";
    ToolSetup setup;
    setup.tool = plugins().find("kerf.implant", KERF_KIND_TOOL, tool);
    setup.force = plugins().find("kerf.implant", KERF_KIND_FORCE, law);
    if (setup.tool == nullptr || setup.force == nullptr) throw std::runtime_error("no implant plugin in lib/kerf");
    std::size_t known = 0;
    for (const auto& info : plugins().catalog()) {
        if (info.plugin != "kerf.implant" || (info.id != tool && info.id != law)) continue;
        (info.id == tool ? setup.tool_parameters : setup.force_parameters) = values(info.parameters, set);
        for (const auto& parameter : info.parameters) known += set.contains(parameter.id) ? 1 : 0;
    }
    if (known != set.size()) throw std::runtime_error("a parameter is set that neither tool nor law has");
    if (const std::string why = bind_law(setup); !why.empty()) throw std::runtime_error(why);
    return setup;
}

inline ToolSetup screw_setup(const std::map<std::string, double>& set = {}) { return threaded("pedicle_screw", set); }

/// A parameter of the tool or of the law, by name [SI].
inline double parameter(const ToolSetup& setup, std::string_view id) {
    for (const auto& [component, given] :
         {std::pair(setup.tool, &setup.tool_parameters), std::pair(setup.force, &setup.force_parameters)})
        for (std::uint32_t i = 0; i < component->param_count; ++i)
            if (component->params[i].id == id) return (*given)[i];
    throw std::runtime_error("no parameter " + std::string(id));
}

/// A signal of the law after the last tick, by name [SI].
inline double signal(const Simulation& simulation, std::string_view id) {
    const kerf_force& force = *simulation.setup().force->force;
    for (std::uint32_t i = 0; i < force.signal_count; ++i)
        if (force.signals[i].id == id) return simulation.signals()[i];
    throw std::runtime_error("no signal " + std::string(id));
}

/// A block of 16 × 16 mm of one density [kg/m³] with a pilot hole through it.
inline Body pilot_block(double density, double thickness, double hole_radius) {
    const Vec3 low{-8e-3, -8e-3, -thickness}, high{8e-3, 8e-3, 0};
    Body body = block(low, high, 0.5e-3, {0.31, 0.17, 0.73});
    body.materials[0].density = density;
    body.surface = LevelSet::build(body.surface.grid(), [=](Vec3 p) {
        return std::max(box_distance(p, low, high), hole_radius - std::sqrt(p.x * p.x + p.y * p.y));
    });
    return body;
}

struct ScrewScene {
    double density;  ///< [kg/m³]
    std::map<std::string, double> set{};
    double thickness = 55e-3;  ///< [m]
    double hole_radius = 0.0;  ///< [m]; 0: as wide as the core's tip
};

/// A driver that turns the screw by a prescribed angle and lets it go along the shaft as it will.
class TurnedScrew {
public:
    explicit TurnedScrew(const ScrewScene& scene)
        : setup_(screw_setup(scene.set)),
          rig_(pilot_block(scene.density, scene.thickness,
                           scene.hole_radius > 0.0 ? scene.hole_radius : 0.5 * parameter(setup_, "tip_core_diameter")),
               setup_, at_depth(-0.2e-3)),
          advance_(parameter(setup_, "starts") * parameter(setup_, "pitch") / (2.0 * pi)) {}

    /// Turns by `by` [rad] at `speed` [rad/s].
    void turn(double by, double speed) {
        const auto ticks = static_cast<int>(std::ceil(std::abs(by) / (speed * Simulation::dt) - 1e-9));
        for (int i = 0; i < ticks; ++i) {
            angle_ += by / ticks;
            depth_ += advance_ * by / ticks + yielding();
            tick();
        }
    }
    /// Rests for so many seconds.
    void rest(double seconds) {
        for (double t = 0.5 * Simulation::dt; t < seconds; t += Simulation::dt) tick();
    }
    /// Puts the tip into its hole and turns until the thread has turned by `turns` in bone.
    void insert(double turns, double speed) {
        const double wanted = 2.0 * pi * turns, step = 0.02;
        for (int i = 0; i < 100'000 && turned() < wanted - step; ++i) turn(step, speed);
        if (wanted > turned()) turn(wanted - turned(), speed);
    }
    /// Turns on until the head's force is `clamp` [N]; at most 40 rad.
    void tighten(double clamp, double speed) {
        for (int i = 0; i < 4000 && this->clamp() < clamp; ++i) turn(0.01, speed);
    }

    [[nodiscard]] double torque() const { return signal(rig_, "torque"); }  ///< [N·m] against the turn
    [[nodiscard]] double turned() const { return signal(rig_, "turned"); }  ///< [rad] since the thread met bone
    [[nodiscard]] double clamp() const { return signal(rig_, "clamp"); }    ///< [N] under the head
    [[nodiscard]] double slip() const { return signal(rig_, "slip"); }      ///< [m] of the thread in bone
    [[nodiscard]] double angle() const noexcept { return angle_; }          ///< [rad] of the driver
    [[nodiscard]] double depth() const noexcept { return depth_; }          ///< [m] of the tip
    [[nodiscard]] double advance() const noexcept { return advance_; }      ///< [m] along the shaft for one radian
    [[nodiscard]] bool has_seen(std::string_view event) const {
        return std::find(events_.begin(), events_.end(), event) != events_.end();
    }
    [[nodiscard]] Pose pose() const { return turned_at(depth_, angle_); }
    [[nodiscard]] Rig& rig() noexcept { return rig_; }

private:
    /// [m] along the shaft in this tick, towards where nothing pulls: against a stiffness like that of bone and thread
    /// together, at 2 mm/s at most.
    [[nodiscard]] double yielding() const {
        constexpr double stiffness = 3e7, fastest = 2e-3;  // [N/m], [m/s]
        return std::clamp(-along_ / stiffness, -fastest * Simulation::dt, fastest * Simulation::dt);
    }
    void tick() {
        const TickResult result = rig_.tick_direct({pose()});
        along_ = linear(result.bone_on_tool).z;
        for (std::size_t e = 0; e < result.event_count; ++e) events_.emplace_back(result.events[e]);
    }

    ToolSetup setup_;
    Rig rig_;
    double advance_;
    double depth_ = -0.2e-3, angle_ = 0.0;
    double along_ = 0.0;  ///< [N] of bone on the screw in the last tick, upwards
    std::vector<std::string> events_;
};

/// A hand on a premium device that turns the driver of a screw evenly and pushes with 10 N.
class HandOnDriver {
public:
    static constexpr double push = 10.0;  ///< [N]

    HandOnDriver(const Body& body, const ToolSetup& setup, double period = Simulation::dt)
        : HandOnDriver(body, setup, test::outline(setup), period) {}

    /// Turns the driver by `speed` × a tick [rad/s]; follows the screw, at 20 mm/s at most.
    TickResult tick(double speed) { return simulation_.tick(next(speed)); }
    /// The same without the tick: where the handle is next.
    DeviceSample next(double speed) {
        constexpr double approach = 20e-3;  // [m/s]
        depth_ = std::min(depth_ + approach * period_,
                          push / spring_.stiffness.along - simulation_.world_from_tool().position.z);
        angle_ += speed * period_;
        handle_ = turned_at(depth_, angle_);
        return {handle_};
    }
    [[nodiscard]] Simulation& simulation() noexcept { return simulation_; }
    [[nodiscard]] const Simulation& simulation() const noexcept { return simulation_; }
    [[nodiscard]] double angle() const noexcept { return angle_; }         ///< [rad] of the driver
    [[nodiscard]] const Pose& handle() const noexcept { return handle_; }  ///< world frame
    [[nodiscard]] Vec3 grip() const noexcept { return {0, 0, grip_z_}; }   ///< [m] tool frame
    [[nodiscard]] const Spring& spring() const noexcept { return spring_; }

private:
    HandOnDriver(const Body& body, const ToolSetup& setup, const ToolOutline& outline, double period)
        : handle_(at_depth(-1e-3)),
          grip_z_(outline.handling.grip_z),
          period_(period),
          spring_(combined_spring(in_hands(gains()), one_hand, grip_z_, outline.handling.bending)),
          simulation_(body, setup, outline, in_hands(gains()), handle_, period) {}

    Pose handle_;
    double grip_z_, period_;
    Spring spring_;
    Simulation simulation_;
    double depth_ = -1e-3, angle_ = 0.0;
};

}  // namespace kerf::test
