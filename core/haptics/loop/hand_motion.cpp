// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/hand_motion.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "kerf/exact_math.hpp"

namespace kerf {

namespace {

constexpr double filter_hz = 50.0;
constexpr double leap = 20e-3;  // [m] maximum motion of a hand between two ticks

bool is_pose(const Pose& p) noexcept {
    constexpr double max_distance = 10.0;  // [m]
    if (!is_finite(p) || !(dot(p.position, p.position) < max_distance * max_distance)) return false;
    const auto& q = p.rotation;
    return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 1e-3;
}

}  // namespace

bool HandMotion::take(const DeviceSample& sample, double dt) noexcept {
    const Pose& handle = sample.world_from_handle;
    const bool is_there = !sample.is_lost && is_pose(handle);
    const bool has_leapt = is_there && (was_missing_ || sample.missed >= missed_ticks_of_pause ||
                                        length(handle.position - pose_.position) > leap);
    was_missing_ = !is_there;
    if (!is_there || has_leapt) {
        if (is_there) pose_ = handle;
        first_pole_ = rate_ = Vec6{};
        return false;
    }
    const Vec3 turned_by = rotate(pose_.rotation, small_rotation_vector(conjugate(pose_.rotation) * handle.rotation));
    dt *= 1.0 + sample.missed;
    const Vec6 raw = make_vec6((1.0 / dt) * (handle.position - pose_.position), (1.0 / dt) * turned_by);
    pose_ = handle;
    const double weight = 1.0 - exp_exact(-2.0 * pi * filter_hz * dt);
    for (std::size_t i = 0; i < 6; ++i) {
        first_pole_[i] += weight * (raw[i] - first_pole_[i]);
        rate_[i] += weight * (first_pole_[i] - rate_[i]);
    }
    return true;
}

}  // namespace kerf
