// SPDX-License-Identifier: Apache-2.0
#include "run/staying_implant_body.h"

#include <algorithm>
#include <cmath>

#include "core/field/cut/tool_solid.h"
#include "kerf/exact_math.hpp"
#include "kerf/units.hpp"

namespace kerf::run {

namespace {

using namespace literals;

/// Returns the angle of (x, y) as a fraction of a turn, −0.5 … 0.5, to within 0.001, with the same bits on every
/// machine.
double turn_fraction(double x, double y) noexcept {
    const double a = std::abs(x), b = std::abs(y), most = std::max(a, b);
    if (most == 0.0) return 0.0;
    const double t = std::min(a, b) / most;
    double share = t * (0.125 + 0.0434 * (1.0 - t));  // within an octant: atan t ≈ t (π/4 + 0.273 (1 − t))
    if (b > a) share = 0.25 - share;
    if (x < 0.0) share = 0.5 - share;
    return y < 0.0 ? -share : share;
}

/// The crests of a thread with their width.
class Ridge {
public:
    Ridge(const ToolOutline& implant, double spacing)
        : flank_(sin_cos_exact(25.0_deg)),
          outer_(implant.thread_radius),
          lead_(implant.thread_lead),
          from_(implant.profile[implant.thread_count > 2 ? 1 : 0].z),
          to_(implant.profile[implant.thread_count - 1].z),
          overlap_(spacing) {
        core_ = outer_;
        for (std::uint32_t i = 1; i < implant.thread_count; ++i)
            if (implant.profile[i].radius > 0.0) core_ = std::min(core_, implant.profile[i].radius);
    }
    /// Returns the distance to its surface [m], negative inside. Far away it is a lower bound.
    [[nodiscard]] double distance(Vec3 p) const {
        const double r = std::sqrt(p.x * p.x + p.y * p.y);
        const double along = p.z - lead_ * turn_fraction(p.x, p.y);
        const double distance_along = std::abs(along - lead_ * std::round(along / lead_));
        const double half = std::min(0.45 * lead_, crest + std::max(0.0, outer_ - r) * flank_.sin / flank_.cos);
        return std::max(
            {flank_.cos * (distance_along - half), r - outer_, core_ - overlap_ - r, p.z - from_, to_ - p.z});
    }

private:
    static constexpr double crest = 0.1_mm;  // half of its width
    SinCos flank_;
    double outer_, core_ = 0.0, lead_, from_, to_, overlap_;
};

}  // namespace

Body staying_implant_body(const ToolOutline& implant, const std::string& id, double spacing) {
    const ToolSolid core({implant.profile.begin(), implant.profile.begin() + implant.stay_count});
    const Ridge ridge(implant, spacing);
    const double radius = std::max(core.largest_radius(), implant.thread_radius), margin = 6.0 * spacing;
    const Vec3 low{-radius - margin, -radius - margin, implant.profile[implant.stay_count - 1].z - margin},
        high{radius + margin, radius + margin, implant.profile.front().z + margin};
    Body body;
    body.id = id;
    body.surface = LevelSet::build(Grid::covering(low, high, spacing),
                                   [&](Vec3 p) { return std::min(core.distance(p), ridge.distance(p)); });
    body.materials.push_back({.id = "metal", .density = 0.0, .border = {}});
    return body;
}

}  // namespace kerf::run
