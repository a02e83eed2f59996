// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "run/view/viewed_run.h"

namespace kerf::window {

/// An eye that turns about a target. Lengths in [m], world frame.
class Camera {
public:
    /// Sees a sphere whole, from this direction.
    /// @param towards  from the target to the eye
    void see(Vec3 target, double radius, Vec3 towards, Vec3 up);
    /// Turns the eye about the target, so that the near side of the bone moves by angles [rad] to the right and
    /// upwards.
    void orbit(double right, double up);
    /// Moves the target in the picture's plane, by fractions of the picture's height.
    void pan(double right, double up);
    /// Moves the target, and the eye with it.
    void follow(Vec3 target) noexcept { target_ = target; }
    /// Moves the eye nearer; `factor` < 1.
    void zoom(double factor);
    /// Moves target and eye, so that the target is here.
    void centre(Vec3 target) { target_ = target; }

    [[nodiscard]] Vec3 eye() const { return target_ + distance_ * towards_; }
    [[nodiscard]] Vec3 target() const { return target_; }
    [[nodiscard]] Vec3 right() const { return cross(up_, towards_); }
    [[nodiscard]] Vec3 up() const { return up_; }
    [[nodiscard]] Vec3 towards() const { return towards_; }
    /// Returns the length [m] that the height of the picture covers at the target.
    [[nodiscard]] double height_at_target() const;
    /// Returns the unit direction from the eye through a point of the picture, given from −1 to 1 to the right and
    /// upwards.
    [[nodiscard]] Vec3 direction_through(double right, double up, double aspect) const;
    /// Returns the point of the picture, as above, that shows a point; nothing if that is not before the eye.
    [[nodiscard]] std::optional<glm::vec2> shown_at(Vec3 point, double aspect) const;
    [[nodiscard]] glm::mat4 view_from_world() const;
    [[nodiscard]] glm::mat4 clip_from_view(double aspect) const;

private:
    Vec3 target_{};
    Vec3 towards_{0, 1, 0}, up_{0, 0, 1};  ///< orthogonal units
    double distance_ = 0.3;
};

[[nodiscard]] inline glm::vec3 single(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
/// Returns a pose as a matrix.
[[nodiscard]] glm::mat4 matrix_of(const Pose& pose);

}  // namespace kerf::window
