// SPDX-License-Identifier: Apache-2.0
#include "documents/implant_plan.h"

#include <algorithm>
#include <cmath>

#include "documents/solids.h"
#include "documents/turn_about.h"
#include "kerf/exact_math.hpp"

namespace kerf::documents {

namespace {

constexpr int around = 16;                              // samples of a ring
constexpr double free_share = 0.9, beside_share = 1.2;  // [–] of a hole's diameter: free of metal; in the metal

/// A ring about the axis of a hole.
class Rings {
public:
    explicit Rings(const ImplantHole& hole)
        : hole_(&hole), along_(normalized(hole.to - hole.from)), turn_(quat_between({0, 0, 1}, along_)) {}
    [[nodiscard]] Vec3 at(double from_start, double radius, int index) const {
        constexpr double sixteenth = 0.39269908169872414;  // [rad]
        const SinCos angle = sin_cos_exact(sixteenth * index);
        return hole_->from + from_start * along_ + rotate(turn_, {radius * angle.cos, radius * angle.sin, 0.0});
    }

private:
    const ImplantHole* hole_;
    Vec3 along_;
    Quat turn_;
};

}  // namespace

Pose planned_pose(Vec3 entry, Vec3 along, Vec3 up) noexcept {
    const Quat z_along = quat_between({0, 0, 1}, along);
    const Vec3 x = normalized(up - dot(up, along) * along);
    return {entry, turn_about(along, rotate(z_along, {1, 0, 0}), x) * z_along};
}

std::optional<NamedHole> named_hole(const std::string& axis, const std::vector<Implant>& implants) {
    std::optional<NamedHole> found;
    for (const Implant& implant : implants) {
        if (!axis.starts_with(implant.id + ".")) continue;
        if (found && found->implant->id.size() > implant.id.size()) continue;  // an id may hold a point, too
        found = NamedHole{&implant, nullptr, axis.substr(implant.id.size() + 1)};
        for (const ImplantHole& hole : implant.holes)
            if (hole.id == found->name) found->hole = &hole;
    }
    return found;
}

LandmarkAxis axis_of(const ImplantHole& hole, const Pose& frame_from_implant, const std::string& name) {
    return {name, frame_from_implant * hole.from, frame_from_implant * hole.to, 0.0};
}

HoleInMetal hole_in_metal(const ImplantHole& hole, const std::function<double(Vec3)>& distance) {
    HoleInMetal found;
    const Rings rings(hole);
    const double long_way = length(hole.to - hole.from), radius = 0.5 * hole.diameter;
    const int steps = std::max(1, static_cast<int>(std::ceil(16.0 * long_way / hole.diameter)));
    bool is_begun = false;
    for (int s = 0; s <= steps; ++s) {
        const double at = long_way * s / steps;
        int in_metal = 0;
        for (int i = 0; i < around; ++i) {
            in_metal += distance(rings.at(at, beside_share * radius, i)) < 0.0;
            for (int ring = 0; ring <= 4 && !found.blocked; ++ring)
                if (const Vec3 p = rings.at(at, 0.25 * ring * free_share * radius, i); distance(p) < 0.0)
                    found.blocked = p;
        }
        if (in_metal <= around / 2) continue;
        if (!is_begun) found.first = at;
        is_begun = true;
        found.last = at;
    }
    return found;
}

double fitting_spacing(const Implant& implant, double spacing) noexcept {
    constexpr double samples = 6.0;
    double narrowest = HUGE_VAL;
    for (const ImplantHole& hole : implant.holes) narrowest = std::min(narrowest, hole.diameter);
    for (const PhantomPart& part : implant.solids.parts) {
        if (const auto* box = std::get_if<BoxSolid>(&part.solid))
            narrowest = std::min({narrowest, box->size.x, box->size.y, box->size.z});
        if (const auto* tube = std::get_if<TubeSolid>(&part.solid)) narrowest = std::min(narrowest, 2.0 * tube->radius);
        if (const auto* tube = std::get_if<EllipticTubeSolid>(&part.solid))
            narrowest = std::min({narrowest, tube->width, tube->height});
    }
    constexpr double finest = 0.05e-3;  // [m]
    return std::min(spacing, std::max(finest, narrowest / samples));
}

}  // namespace kerf::documents
