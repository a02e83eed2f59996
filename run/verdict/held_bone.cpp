// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/held_bone.h"

#include <algorithm>
#include <cmath>

#include "kerf/units.hpp"

namespace kerf::run {

namespace {

bool is_bone(const Body& body, const CutField& cut, Vec3 point) {
    const LocatedPoint place = locate(body, point);
    return uncut_distance(body, place) < 0.0 && cut.at(place) < 0.0;
}

}  // namespace

HeldBone HeldBone::around(const ToolOutline& implant, const Pose& body_from_implant, const Body& body,
                          const CutField& cut) {
    constexpr int directions = 16;
    HeldBone held;
    if (!implant.has_thread()) return held;
    const double step = body.grid().spacing, radius = implant.thread_radius + step;
    for (double z = implant.crest.tip_z(); z >= implant.crest.end_z(); z -= step)
        for (int i = 0; i < directions; ++i) {
            const double angle = 2.0 * pi * i / directions;
            const Vec3 point = body_from_implant * Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
            if (is_bone(body, cut, point)) held.points_.push_back(point);
        }
    return held;
}

double HeldBone::part_left(const Body& body, const CutField& cut) const {
    if (points_.empty()) return 1.0;
    const auto left = std::count_if(points_.begin(), points_.end(), [&](Vec3 p) { return is_bone(body, cut, p); });
    return static_cast<double>(left) / static_cast<double>(points_.size());
}

}  // namespace kerf::run
