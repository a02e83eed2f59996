// SPDX-License-Identifier: Apache-2.0
#include "conformance/tool_rig.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "conformance/law_walk.h"
#include "conformance/parameter_sets.h"

namespace kerf::conformance {

namespace {

constexpr int ticks_to_run_up = 600;  // at 1 kHz
constexpr double force_scale = 0.01;  // [–] of the hand's device

ToolOutline made(const ToolSetup& setup) {
    ToolOutline outline;
    std::string error;
    if (!outline_of(setup, outline, error)) throw std::runtime_error(error);
    outline.handling.bending = {};  // the law alone is asked about
    return outline;
}

ToolSetup set_up(const Subject& subject, bool is_running) {
    ToolSetup setup = subject.setup();
    if (!is_running) setup.drives = drives_at_rest(*subject.tool);
    return setup;
}

double box_distance(Vec3 p, Vec3 low, Vec3 high) {
    const Vec3 c = 0.5 * (low + high), half = 0.5 * (high - low);
    const Vec3 q{std::abs(p.x - c.x) - half.x, std::abs(p.y - c.y) - half.y, std::abs(p.z - c.z) - half.z};
    const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

Body block(const RigSettings& settings, double half_x, double half_y, double thickness) {
    const Vec3 low{-half_x, -half_y, -thickness}, high{half_x, half_y, 0.0};
    Vec3 least = rotate(settings.turn, low), most = least;
    for (const double x : {low.x, high.x})
        for (const double y : {low.y, high.y})
            for (const double z : {low.z, high.z}) {
                const Vec3 p = rotate(settings.turn, Vec3{x, y, z});
                least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
                most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
            }
    const double margin = 6.0 * settings.spacing;
    Grid grid =
        Grid::covering(least - Vec3{margin, margin, margin}, most + Vec3{margin, margin, margin}, settings.spacing);
    grid.origin = grid.origin + settings.spacing * Vec3{0.31, 0.17, 0.73};
    const Quat back = conjugate(settings.turn);
    Body body;
    body.id = "block";
    body.surface = LevelSet::build(grid, [=](Vec3 p) { return box_distance(rotate(back, p), low, high); });
    body.materials.push_back({"cortical", settings.density, {}});
    return body;
}

kerf_profile_point widest_of(const ToolOutline& outline) {
    const std::size_t count = std::max<std::size_t>(outline.cutting_count, 2);
    kerf_profile_point widest = outline.profile.front();
    for (std::size_t i = 0; i < std::min(count, outline.profile.size()); ++i)
        if (outline.profile[i].radius > widest.radius) widest = outline.profile[i];
    return widest;
}

}  // namespace

ToolRig::ToolRig(const Subject& subject, const RigSettings& settings)
    : settings_(settings),
      setup_(set_up(subject, settings.is_running)),
      outline_(made(setup_)),
      full_depth_(-widest_of(outline_).z),
      radius_(widest_of(outline_).radius),
      body_([&] {
          const double across = outline_.whole.is_prism() ? 6e-3 : radius_ + 4e-3;
          return block(settings, radius_ + 4e-3, across,
                       settings.thickness > 0.0 ? settings.thickness : working_depth() + 4e-3);
      }()),
      simulation_(body_, setup_, outline_, gains_for(*find_device("premium-1.5-6dof"), force_scale),
                  placed(at_depth(-above)), settings.period) {}

double ToolRig::working_depth() const noexcept { return std::min(full_depth_ + 1e-3, 6e-3); }

Pose ToolRig::placed(const Pose& in_block) const noexcept {
    return {rotate(settings_.turn, in_block.position), settings_.turn * in_block.rotation};
}

void ToolRig::run_up() {
    const auto ticks = static_cast<int>(std::lround(ticks_to_run_up * Simulation::dt / settings_.period));
    for (int i = 0; i < ticks; ++i) static_cast<void>(lead(-above));
}

TickResult ToolRig::lead(const Pose& block_from_tool) { return simulation_.tick_direct({placed(block_from_tool)}); }

TickResult ToolRig::lead(double depth, double aside, double tilt) { return lead(at_depth(depth, tilt, {aside, 0, 0})); }

std::vector<TickResult> ToolRig::feed(double from, double to, double speed) {
    const auto count = std::max(1, static_cast<int>(std::lround(std::abs(to - from) / (speed * settings_.period))));
    std::vector<TickResult> ticks;
    for (int i = 1; i <= count; ++i) ticks.push_back(lead(from + (to - from) * i / count));
    return ticks;
}

TickResult ToolRig::push(double push) {
    constexpr double mass = 0.1, damping = 2.0;  // [kg], [N·s/m] of hand and handle, on the device's side
    const TickResult tick = simulation_.tick({placed(at_depth(hand_depth_))});
    const Vec3 shaft = rotate(settings_.turn, Vec3{0, 0, -1});
    const double force =
        push * force_scale + dot(linear(tick.command.wrench), shaft) - damping * hand_speed_;  // along the shaft
    hand_speed_ += settings_.period * force / mass;
    hand_depth_ += settings_.period * hand_speed_;
    return tick;
}

void ToolRig::drive(double fraction) {
    const kerf_tool& tool = *setup_.tool->tool;
    for (std::uint32_t i = 0; i < tool.drive_count; ++i)
        simulation_.command_drive(i, std::clamp(fraction * tool.drives[i].def, tool.drives[i].min, tool.drives[i].max));
}

double ToolRig::removed() {
    simulation_.finish();
    return simulation_.present().removed();
}

Vec3 ToolRig::force_in_block(const TickResult& tick) const noexcept {
    return rotate(conjugate(settings_.turn), linear(tick.bone_on_tool));
}

}  // namespace kerf::conformance
