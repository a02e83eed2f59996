// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "bone/surface/triangle_tree.h"

namespace kerf::bone {

/// Exact distance to a closed surface [m], negative inside. It is a pure function of the point; stored earlier results
/// only save work. No surface passes between two points if the sum of their distances exceeds the distance between
/// them. Then both lie on the same side.
class SignedDistance {
public:
    /// Pre: `tree` outlives it.
    explicit SignedDistance(const TriangleTree& tree) : tree_(&tree) {}

    /// Returns the distance, or ±`limit` [m] if the surface is farther than that.
    [[nodiscard]] double operator()(Vec3 p, double limit = HUGE_VAL) {
        constexpr double rounding_factor = 1.0 + 1e-9, rounding_margin = 1e-12;  // [–], [m] margins for rounding
        const Answer& last = answers_[(next_ + remembered - 1) % remembered];
        const double bound = last.is_exact
                                 ? (std::abs(last.distance) + length(p - last.at)) * rounding_factor + rounding_margin
                                 : HUGE_VAL;
        Answer answer{p, tree_->distance(p, std::min(limit, bound)), false};
        answer.is_exact = answer.distance < limit;
        const auto on_same_side = [&](const Answer& other) {
            return answer.distance + std::abs(other.distance) >
                   length(p - other.at) * rounding_factor + rounding_margin;
        };
        // The last result first, then earlier ones back to the previous row of samples.
        bool is_known = false;
        for (std::size_t back = 1; back <= remembered && !is_known; ++back) {
            const Answer& other = answers_[(next_ + remembered - back) % remembered];
            if (!std::isfinite(other.distance) || !on_same_side(other)) continue;
            if (std::signbit(other.distance)) answer.distance = -answer.distance;
            is_known = true;
        }
        if (!is_known && tree_->is_inside(p)) answer.distance = -answer.distance;
        answers_[next_] = answer;
        next_ = (next_ + 1) % remembered;
        return answer.distance;
    }

private:
    struct Answer {
        Vec3 at{};
        double distance = HUGE_VAL;  ///< −0 is inside
        bool is_exact = false;       ///< otherwise a lower bound
    };
    static constexpr std::size_t remembered = 12;  // slightly more than a row of a brick

    const TriangleTree* tree_;
    std::array<Answer, remembered> answers_{};
    std::size_t next_ = 0;
};

}  // namespace kerf::bone
