// SPDX-License-Identifier: Apache-2.0
#include "conformance/tool_rig.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "conformance/law_walk.h"
#include "conformance/parameter_sets.h"
#include "kerf/units.hpp"

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
    const auto first = outline.profile.begin() + static_cast<std::ptrdiff_t>(outline.cutting_first);
    const auto count = std::max<std::size_t>(outline.cutting_count, 2);
    return *std::max_element(first, first + static_cast<std::ptrdiff_t>(count),
                             [](const auto& a, const auto& b) { return a.radius < b.radius; });
}

/// The part of a circle's area that lies deeper than `r` − `depth` on one side [m²].
double segment_area(double r, double depth) {
    if (depth <= 0.0 || r <= 0.0) return 0.0;
    const double h = std::min(depth, r);
    return r * r * std::acos(1.0 - h / r) - (r - h) * std::sqrt(2.0 * r * h - h * h);
}

}  // namespace

ToolRig::ToolRig(const Subject& subject, const RigSettings& settings)
    : settings_(settings),
      setup_(set_up(subject, settings.is_running)),
      outline_(made(setup_)),
      widest_(widest_of(outline_)),
      body_([&] {
          const double along = widest_.radius + 4e-3, deep = working_depth() + 4e-3;
          const double across = is_fed_sideways() ? half_length() : outline_.whole.is_prism() ? 6e-3 : along;
          return block(settings, along, across, settings.thickness > 0.0 ? settings.thickness : deep);
      }()),
      simulation_(body_, setup_, outline_, gains_for(*find_device("premium-1.5-6dof"), force_scale),
                  placed(fed_to(-above)), settings.period) {}

double ToolRig::working_depth() const noexcept {
    return is_fed_sideways() ? std::min(0.6 * widest_.radius, 2e-3) : std::min(1e-3 - widest_.z, 6e-3);
}

/// Half of the length along the shaft of the bone under a tool that lies on it: what cuts, and no more.
double ToolRig::half_length() const noexcept {
    return std::max(0.4 * (outline_.cutting.tip_z() - outline_.cutting.end_z()), 0.5e-3);
}

Pose ToolRig::fed_to(double depth, double tilt, double aside) const noexcept {
    if (!is_fed_sideways()) {
        const double turn = settings_.is_running ? depth * turn_of_feed(setup_, outline_) : 0.0;
        return at_depth(depth, tilt, {aside, 0, 0}) * Pose{{}, quat_from_rotation_vector({0, 0, turn})};
    }
    // Its x into the bone, its shaft along the block's y, its cutting part in the middle.
    const Quat lying = quat_from_rotation_vector({0, tilt, 0}) * Quat{0.5, -0.5, 0.5, 0.5};
    const double middle = 0.5 * (outline_.cutting.tip_z() + outline_.cutting.end_z());
    return {Vec3{aside, 0, widest_.radius - depth} - rotate(lying, {0, 0, middle}), lying};
}

double ToolRig::depth() {
    const Pose block_from_tool{rotate(conjugate(settings_.turn), simulation_.world_from_tool().position), {}};
    return block_from_tool.position.z * -1.0 + (is_fed_sideways() ? widest_.radius : 0.0);
}

double ToolRig::thrust(const TickResult& tick) const noexcept {
    return is_fed_sideways() ? force_in_block(tick).z : tick.thrust;
}

double ToolRig::swept(double depth, bool with_crests) const {
    constexpr int pieces = 2000;
    const double bore = outline_.cutting.bore(), tip = outline_.cutting.tip_z(), end = outline_.cutting.end_z();
    const auto radius_at = [&](double z) {
        for (const ToolSolid::Gap& gap : outline_.cutting.gaps())
            if (z < gap.front && z > gap.back) return 0.0;
        double radius = 0.0;
        for (std::uint32_t p = outline_.cutting_first; p + 1 < outline_.cutting_first + outline_.cutting_count; ++p) {
            const auto &a = outline_.profile[p], &b = outline_.profile[p + 1];
            if (z > a.z || z < b.z) continue;
            radius = std::max(radius, a.radius + (b.radius - a.radius) * (a.z - z) / (a.z - b.z));
        }
        if (with_crests && outline_.has_thread() && z <= outline_.profile[outline_.thread_count > 2 ? 1 : 0].z)
            radius = std::max(radius, outline_.thread_radius);
        return radius;
    };
    double sum = 0.0;
    if (is_fed_sideways()) {
        const double middle = 0.5 * (tip + end), half = std::min(half_length(), 0.5 * (tip - end)),
                     dz = 2.0 * half / pieces;
        for (int i = 0; i < pieces; ++i) {
            const double radius = radius_at(middle - half + (i + 0.5) * dz), deep = depth - (widest_.radius - radius);
            sum += dz * (outline_.whole.is_prism() ? std::max(0.0, deep) * outline_.cutting.thickness()
                                                   : segment_area(radius, deep));
        }
        return sum;
    }
    double widest = 0.0;
    const double ds = depth / pieces;
    for (int i = 0; i < pieces; ++i) {
        widest = std::max(widest, radius_at(-(i + 0.5) * ds));
        if (widest > 0.0)
            sum += ds * (outline_.whole.is_prism() ? 2.0 * widest * outline_.cutting.thickness()
                                                   : pi * (widest * widest - bore * bore));
    }
    return sum;
}

Pose ToolRig::placed(const Pose& in_block) const noexcept {
    return {rotate(settings_.turn, in_block.position), settings_.turn * in_block.rotation};
}

void ToolRig::run_up() {
    const auto ticks = static_cast<int>(std::lround(ticks_to_run_up * Simulation::dt / settings_.period));
    for (int i = 0; i < ticks; ++i) static_cast<void>(lead(-above));
}

TickResult ToolRig::lead(const Pose& block_from_tool) { return simulation_.tick_direct({placed(block_from_tool)}); }

TickResult ToolRig::lead(double depth, double aside, double tilt) { return lead(fed_to(depth, tilt, aside)); }

std::vector<TickResult> ToolRig::feed(double from, double to, double speed) {
    const auto count = std::max(1, static_cast<int>(std::lround(std::abs(to - from) / (speed * settings_.period))));
    std::vector<TickResult> ticks;
    for (int i = 1; i <= count; ++i) ticks.push_back(lead(from + (to - from) * i / count));
    return ticks;
}

TickResult ToolRig::push(double push) {
    constexpr double mass = 0.1, damping = 2.0;  // [kg], [N·s/m] of hand and handle, on the device's side
    const TickResult tick = simulation_.tick({placed(fed_to(hand_depth_))});
    const Vec3 down = rotate(settings_.turn, Vec3{0, 0, -1});
    const double force = push * force_scale + dot(linear(tick.command.wrench), down) - damping * hand_speed_;
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
