// SPDX-License-Identifier: Apache-2.0
#include "app/window/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace kerf::window {

namespace {

constexpr double field_of_view = 0.52;  // [rad] of the picture's height

/// Returns `v` turned about a unit axis.
Vec3 turned(Vec3 v, Vec3 axis, double angle) {
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1.0 - std::cos(angle)) * dot(axis, v) * axis;
}

/// Returns the part of `up` across `towards`, as a unit vector; any one if there is none.
Vec3 upright(Vec3 towards, Vec3 up) {
    const Vec3 across = up - dot(up, towards) * towards;
    if (length(across) > 1e-3) return normalized(across);
    const Vec3 other = std::abs(towards.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return normalized(other - dot(other, towards) * towards);
}

}  // namespace

void Camera::see(Vec3 target, double radius, Vec3 towards, Vec3 up) {
    target_ = target;
    towards_ = length(towards) > 1e-9 ? normalized(towards) : Vec3{0, 1, 0};
    up_ = upright(towards_, up);
    distance_ = std::max(radius, 1e-3) / std::sin(0.5 * field_of_view);
}

void Camera::orbit(double right, double up) {
    towards_ = normalized(turned(towards_, up_, -right));
    const Vec3 axis = cross(up_, towards_);
    towards_ = normalized(turned(towards_, axis, up));
    up_ = upright(towards_, turned(up_, axis, up));
}

void Camera::pan(double right, double up) {
    target_ = target_ - height_at_target() * (right * this->right() + up * up_);
}

void Camera::zoom(double factor) { distance_ = std::clamp(distance_ * factor, 5e-3, 3.0); }

double Camera::height_at_target() const { return 2.0 * distance_ * std::tan(0.5 * field_of_view); }

Vec3 Camera::direction_through(double right, double up, double aspect) const {
    const double half = std::tan(0.5 * field_of_view);
    return normalized(half * aspect * right * this->right() + half * up * up_ - towards_);
}

std::optional<glm::vec2> Camera::shown_at(Vec3 point, double aspect) const {
    const Vec3 d = point - eye();
    const double depth = -dot(d, towards_), half = depth * std::tan(0.5 * field_of_view);
    if (depth <= 1e-6) return std::nullopt;
    return glm::vec2(static_cast<float>(dot(d, right()) / (half * aspect)), static_cast<float>(dot(d, up_) / half));
}

glm::mat4 Camera::view_from_world() const {
    return glm::inverse(glm::mat4(glm::vec4(single(right()), 0), glm::vec4(single(up_), 0),
                                  glm::vec4(single(towards_), 0), glm::vec4(single(eye()), 1)));
}

glm::mat4 Camera::clip_from_view(double aspect) const {
    const double near = std::max(1e-3, 0.05 * distance_), far = distance_ + 1.0;
    return glm::perspective(static_cast<float>(field_of_view), static_cast<float>(aspect), static_cast<float>(near),
                            static_cast<float>(far));
}

glm::mat4 matrix_of(const Pose& pose) {
    const Vec3 x = rotate(pose.rotation, {1, 0, 0}), y = rotate(pose.rotation, {0, 1, 0}),
               z = rotate(pose.rotation, {0, 0, 1});
    return {glm::vec4(single(x), 0), glm::vec4(single(y), 0), glm::vec4(single(z), 0),
            glm::vec4(single(pose.position), 1)};
}

}  // namespace kerf::window
