// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "bone/measure/line.h"
#include "bone/measure/path.h"

namespace kerf {

/// A stretch of bone on a line, counted from the line's point along its direction.
struct Stretch {
    double begin = 0.0, end = 0.0;  ///< [m]
    /// |cosine| between the line and the surface's normal at either end: 1 straight through [–]
    double cosine_at_begin = 1.0, cosine_at_end = 1.0;
    bool is_complete = true;  ///< false: it goes on beyond what was read of the bone
};

/// The surface of a bone, however it is represented, as measures see it. Frame: the bone's, LPS [m].
class MeasuredSurface {
public:
    MeasuredSurface() = default;
    MeasuredSurface(const MeasuredSurface&) = delete;
    MeasuredSurface& operator=(const MeasuredSurface&) = delete;
    virtual ~MeasuredSurface() = default;

    /// Returns points of the surface that lie in a region, close enough to each other that their hull is that of the
    /// surface to within the uncertainty of a contact. The order follows from the surface alone.   [worker]
    [[nodiscard]] virtual std::vector<Vec3> points_in(const Path& region) const = 0;

    /// Returns the stretches of bone on a line, between `low` and `high` [m] from its point, in ascending order.
    /// Thinner ones than half of the spacing may be missed.   [worker]
    [[nodiscard]] virtual std::vector<Stretch> stretches_on(const Line& line, double low, double high) const = 0;

    /// Returns the signed distance of a point to the surface [m], negative inside. Nothing for a surface without any
    /// point, or where a point lies beyond what was read.   [worker]
    [[nodiscard]] virtual std::optional<double> distance_to(Vec3 p) const = 0;

    /// Returns the standard uncertainty of a smooth wall's position along its normal [m].   [any] pure.
    [[nodiscard]] virtual double wall_uncertainty() const noexcept = 0;
    /// Returns the same at a contact, which may be a sharp edge or corner that the representation rounds [m]. [any]
    /// pure.
    [[nodiscard]] virtual double contact_uncertainty() const noexcept = 0;
};

/// The farthest that measures look along a line to either side [m].
inline constexpr double farthest_look = 0.5;

}  // namespace kerf
