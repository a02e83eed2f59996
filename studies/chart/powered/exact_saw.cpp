// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/exact_saw.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/chart/along_edge.h"
#include "studies/chart/setting.h"

namespace kerf::chart {

using namespace literals;

namespace {

constexpr int phases = 64;  // of half an oscillation, from one turning point to the other

/// Aside and about what a motion may be for the feed alone to count.
constexpr double aside = 1e-6;  // [m/s]
constexpr double about = 1e-4;  // [rad/s]

}  // namespace

std::vector<std::string> StraightSaw::parameters() {
    return {"blade_length", "blade_height", "stroke",      "tooth_pitch", "blade_thickness",   "tooth_set",
            "stroke_rate",  "thrust_edge",  "thrust_chip", "edge_depth",  "reference_density", "set_share"};
}

StraightSaw::StraightSaw(const Values& values)
    : length(values.at("blade_length")),
      height(values.at("blade_height")),
      stroke(values.at("stroke")),
      pitch(values.at("tooth_pitch")),
      thickness(values.at("blade_thickness")),
      set(values.at("tooth_set")),
      rate(values.at("stroke_rate")),
      thrust{values.at("thrust_edge"), values.at("edge_depth"), values.at("thrust_chip")},
      set_share(values.at("set_share")),
      reference_density(values.at("reference_density")) {}

int StraightSaw::teeth() const noexcept { return static_cast<int>(length / pitch + 1e-9); }

double StraightSaw::chip_per_feed(double phase) const noexcept {
    const double speed = pi * rate * stroke * std::abs(std::cos(phase)), most = 0.5 / rate;
    return speed > 0.0 ? std::min(pitch / speed, most) : most;
}

std::optional<Vec6> ExactSaw::tick(const Pose& body_from_tool, const Vec6& rate) {
    const Vec3 v = linear(rate);
    if (std::hypot(v.x, v.y) > aside || length(angular(rate)) > about) is_straight_ = false;
    if (!is_straight_) return std::nullopt;
    const double feed = v.z;
    if (!(feed > 0.0)) return Vec6{};

    double chip_force[phases];  // [N/m] of a tooth in the reference tissue
    for (int k = 0; k < phases; ++k)
        chip_force[k] = force_per_width(feed * saw_.chip_per_feed(pi * ((k + 0.5) / phases - 0.5)), saw_.thrust);
    Vec3 force{}, torque{};
    const int teeth = saw_.teeth();
    for (int i = 0; i < teeth; ++i) {
        const double side = i % 2 == 0 ? 1.0 : -1.0, at_rest = (i - 0.5 * (teeth - 1)) * saw_.pitch;
        const double y = 0.25 * side * saw_.kerf();
        for (int k = 0; k < phases; ++k) {
            const double x = at_rest + 0.5 * saw_.stroke * std::sin(pi * ((k + 0.5) / phases - 0.5));
            const Vec3 at{x, y, 0.0};
            const int in = bone_->tissue_at(body_from_tool * at);
            if (in < 0) continue;
            const double m =
                resistance_of_density(bone_->tissues[static_cast<std::size_t>(in)].density, saw_.reference_density);
            const double f = m * saw_.kerf() * chip_force[k] / phases;
            const Vec3 on_tooth{0.0, -side * saw_.set_share * f, -f};
            force = force + on_tooth;
            torque = torque + cross(at, on_tooth);
        }
    }
    // What its strip, lengthened by a stroke, takes: bone under the edge, along the whole width of the kerf.
    const double half = 0.5 * (teeth * saw_.pitch + saw_.stroke);
    const auto is_bone = [&](double x, double y) {
        return bone_->surface(body_from_tool * Vec3{x, y, 0.0}) < 0.0 ? 0 : -1;
    };
    constexpr int looks = 200;
    for_gauss_points(-0.5 * saw_.kerf(), 0.5 * saw_.kerf(), [&](double y, double dy) {
        for_stretches<24>(
            -half, half, looks, [&](double x) { return is_bone(x, y); },
            [&](double from, double to, int) { volume_ += (to - from) * dy * feed * dt; });
    });
    return make_vec6(force, torque);
}

}  // namespace kerf::chart
