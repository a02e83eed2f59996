// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/swept_ball.h"

#include <algorithm>
#include <cmath>

namespace kerf::chart {

namespace {

constexpr double straight = 5e-8;    // [m] what a merged stretch may bend
constexpr double longest = 0.05e-3;  // [m] of a merged stretch that is not exactly straight
constexpr double rounding = 1e-10;   // [m] what touches is not inside

double distance(Vec3 p, Vec3 a, Vec3 b) noexcept {
    const Vec3 way = b - a;
    const double size = dot(way, way);
    const double share = size > 0.0 ? std::clamp(dot(p - a, way) / size, 0.0, 1.0) : 0.0;
    return length(p - a - share * way);
}

}  // namespace

void SweptBall::go_to(Vec3 centre) {
    const Vec3 last = centre_;
    centre_ = centre;
    if (!has_begun_) {
        has_begun_ = true;
        stretches_.push_back({centre, centre});
        return;
    }
    if (length(centre - last) <= 0.0) return;
    Stretch& open = stretches_.back();
    const bool is_exact = distance(last, open.from, centre) <= 1e-15;
    const double allowed = length(centre - open.from) < longest ? straight : 1e-15;
    merged_.push_back(last);
    const bool is_straight = is_exact && merged_are_exact_;
    const bool goes_on = dot(centre - last, last - open.from) >= 0.0 &&
                         (is_straight || std::all_of(merged_.begin(), merged_.end(), [&](Vec3 one) {
                              return distance(one, open.from, centre) <= allowed;
                          }));
    if (goes_on) {
        open.to = centre;
        merged_are_exact_ = is_straight;
        if (is_straight) merged_.clear();
        return;
    }
    stretches_.push_back({last, centre});
    merged_.clear();
    merged_are_exact_ = true;
}

void SweptBall::look_ahead(Vec3 way) {
    const Vec3 ahead = normalized(way);
    near_.clear();
    for (const Stretch& one : stretches_) {
        // With d from a place on the stretch to the centre, a point of normal n lies inside if |d|² + 2 R n·d < 0.
        const double nearest = distance(centre_, one.from, one.to);
        double max_aside = 0.0, min_along = 1e300;
        for (const Vec3 end : {one.from, one.to}) {
            const Vec3 d = centre_ - end;
            const double along = dot(d, ahead);
            min_along = std::min(min_along, along);
            max_aside = std::max(max_aside, length(d - along * ahead));
        }
        const bool is_ahead = min_along < -rounding && nearest < 2.0 * radius_;
        const bool is_aside = max_aside > rounding && nearest * nearest < 2.0 * radius_ * max_aside;
        if (!is_ahead && !is_aside) continue;
        const Vec3 along = one.to - one.from;
        const double square = dot(along, along);
        near_.push_back({one.from, along, square > 0.0 ? 1.0 / square : 0.0});
    }
}

bool SweptBall::holds(Vec3 point) const noexcept {
    const double inside = radius_ - rounding;
    return std::any_of(near_.begin(), near_.end(), [&](const Near& one) {
        const Vec3 d = point - one.from;
        const double share = std::clamp(dot(d, one.way) * one.per_square, 0.0, 1.0);
        const Vec3 off = d - share * one.way;
        return dot(off, off) < inside * inside;
    });
}

}  // namespace kerf::chart
