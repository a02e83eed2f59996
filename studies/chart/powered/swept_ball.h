// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kerf/math.hpp"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// All that a ball has swept: capsules, one after the other. A motion that wobbles by less than 0.05 µm is taken as
/// straight.
class SweptBall {
public:
    explicit SweptBall(double radius) : radius_(radius) {}

    /// The ball comes to a centre, straight from the last one.
    void go_to(Vec3 centre);
    /// Only points ahead are asked about from now on, until the ball moves: on the ball around the last centre, with
    /// normals of less than 90° to `way`. What cannot hold any of them is left out.
    void look_ahead(Vec3 way);
    /// Whether the ball was there, and not only the surface of it.
    [[nodiscard]] bool holds(Vec3 point) const noexcept;

private:
    struct Stretch {
        Vec3 from, to;
    };
    double radius_;
    /// A stretch that may hold a point ahead, made ready to be asked often.
    struct Near {
        Vec3 from, way;
        double per_square;  ///< [1/m²] one over its length squared; 0: it has none
    };
    std::vector<Stretch> stretches_;
    std::vector<Near> near_;
    std::vector<Vec3> merged_;  ///< centres that the last stretch passes
    bool has_begun_ = false, merged_are_exact_ = true;
    Vec3 centre_{};
};

}  // namespace kerf::chart
