// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "bone/measure/line.h"
#include "bone/measure/path.h"

namespace kerf::bone {

/// A stretch of bone on a line, as distances from the line's point along its direction.
struct Stretch {
    double begin = 0.0, end = 0.0;  ///< [m]
    /// |cosine| between the line and the surface's normal at either end: 1 at right angles to the surface [–]
    double cosine_at_begin = 1.0, cosine_at_end = 1.0;
    bool is_complete = true;  ///< false: it continues beyond the data
};

/// The interface of a bone's surface to measures. Frame: the bone's, LPS [m].
class MeasuredSurface {
public:
    MeasuredSurface() = default;
    MeasuredSurface(const MeasuredSurface&) = delete;
    MeasuredSurface& operator=(const MeasuredSurface&) = delete;
    virtual ~MeasuredSurface() = default;

    /// Returns points of the surface in a region. They are close enough to have the surface's hull within the
    /// uncertainty of a contact. The order depends on the surface alone.   [worker]
    [[nodiscard]] virtual std::vector<Vec3> points_in(const Path& region) const = 0;

    /// Returns the stretches of bone on a line, between `low` and `high` [m] from its point, in ascending order. May
    /// miss stretches thinner than half of the spacing.   [worker]
    [[nodiscard]] virtual std::vector<Stretch> stretches_on(const Line& line, double low, double high) const = 0;

    /// Returns the signed distance of a point to the surface [m], negative inside. Nothing for a surface without any
    /// point, or for a point beyond the data.   [worker]
    [[nodiscard]] virtual std::optional<double> distance_to(Vec3 p) const = 0;

    /// Returns the standard uncertainty of a smooth wall's position along its normal [m].   [any] pure.
    [[nodiscard]] virtual double wall_uncertainty() const noexcept = 0;
    /// Returns the standard uncertainty of a contact [m], which may be a sharp edge or corner that the representation
    /// rounds.   [any] pure.
    [[nodiscard]] virtual double contact_uncertainty() const noexcept = 0;
};

/// Largest search distance of measures along a line, to either side [m].
inline constexpr double max_search_distance = 0.5;

}  // namespace kerf::bone
