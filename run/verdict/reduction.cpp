// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/reduction.h"

#include <algorithm>
#include <cmath>

#include "documents/fracture.h"

namespace kerf::run {

namespace {

Pose pose_of(std::size_t body, std::span<const Pose> world_from_body) noexcept {
    return body < world_from_body.size() ? world_from_body[body] : identity_pose();
}

template <class Landmark>
const Landmark* find(const std::vector<Landmark>& landmarks, const std::string& id) noexcept {
    const auto found = std::find_if(landmarks.begin(), landmarks.end(), [&](const Landmark& l) { return l.id == id; });
    return found != landmarks.end() ? &*found : nullptr;
}

}  // namespace

std::optional<Reduction> reduction_of(const documents::Anatomy& anatomy, std::span<const Pose> world_from_body) {
    if (!anatomy.fracture) return {};
    const Pose rest_from_fragment = inverse(pose_of(0, world_from_body)) * pose_of(1, world_from_body);
    const Quat& q = rest_from_fragment.rotation;
    const Vec3 at = anatomy.fracture->at;
    return Reduction{length(rest_from_fragment * at - at),
                     2.0 * std::atan2(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z), std::abs(q.w))};
}

std::optional<double> angle_between(const documents::Anatomy& anatomy, std::span<const Pose> world_from_body,
                                    const std::string& one, const std::string& other) {
    const auto direction = [&](const std::string& id) {
        const documents::LandmarkAxis* axis = find(anatomy.axes, id);
        if (axis == nullptr) return Vec3{};
        const std::size_t body = documents::body_at(anatomy, 0.5 * (axis->from + axis->to));
        return rotate(pose_of(body, world_from_body).rotation, normalized(axis->to - axis->from));
    };
    const Vec3 a = direction(one), b = direction(other);
    if (a == Vec3{} || b == Vec3{}) return {};
    return std::atan2(length(cross(a, b)), dot(a, b));
}

std::optional<double> tip_apex_distance(const documents::Anatomy& anatomy, std::span<const Pose> world_from_body,
                                        Vec3 tip_in_world, const std::string& apex, const std::string& neck) {
    const documents::LandmarkPoint* point = find(anatomy.points, apex);
    const documents::LandmarkAxis* axis = find(anatomy.axes, neck);
    if (point == nullptr || axis == nullptr) return {};
    const Vec3 away =
        inverse(pose_of(documents::body_at(anatomy, point->at), world_from_body)) * tip_in_world - point->at;
    const Vec3 from_behind{0, 1, 0}, across = cross(from_behind, normalized(axis->to - axis->from));
    if (length(across) < 1e-3) return {};  // a neck that points to the front
    const auto seen_along = [&](Vec3 view) { return length(away - dot(away, view) * view); };
    return seen_along(from_behind) + seen_along(normalized(across));
}

std::optional<double> measured_at_end(const documents::Limit& limit, const documents::Anatomy& anatomy,
                                      std::span<const Pose> world_from_body, Vec3 tip_in_world) {
    if (limit.quantity == "axes_angle") return angle_between(anatomy, world_from_body, limit.landmark, limit.other);
    if (limit.quantity == "tip_apex")
        return tip_apex_distance(anatomy, world_from_body, tip_in_world, limit.landmark, limit.other);
    if (const auto reduction = reduction_of(anatomy, world_from_body)) {
        if (limit.quantity == "reduction_offset") return reduction->offset;
        if (limit.quantity == "reduction_angle") return reduction->angle;
    }
    return {};
}

}  // namespace kerf::run
