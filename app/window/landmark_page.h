// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/view/viewed_run.h"

/// All that the landmark page shows, and what a user picks on it. Plain values, so that the page knows no other part of
/// Kerf. Frame: LPS, metres.
namespace kerf::window {

/// A point on the bone's surface.
struct SurfacePoint {
    Vec3 position{}, normal{};  ///< [m]; unit, out of the bone
    std::string tissue{};       ///< just below the surface, for people
};

/// A point, or an axis from one point to another.
struct PickedLandmark {
    std::string id{};
    Vec3 at{};                 ///< [m] of an axis: where it begins
    std::optional<Vec3> to{};  ///< [m] where an axis ends; nothing: a point
};

/// What the page shows of a bone, and where its landmarks go.   [main]
class LandmarkSource {
public:
    virtual ~LandmarkSource() = default;

    [[nodiscard]] virtual const run::ViewedScene& scene() const noexcept = 0;
    [[nodiscard]] virtual std::shared_ptr<const run::ViewedSurface> surface() const = 0;
    /// Returns the file's name without its folder.
    [[nodiscard]] virtual std::string file_name() const = 0;
    /// Returns the landmarks of the file. Valid until the next `write`.
    [[nodiscard]] virtual const std::vector<PickedLandmark>& written() const = 0;
    /// Returns where a ray first meets the surface; nothing if it does not.
    /// @param direction  unit
    [[nodiscard]] virtual std::optional<SurfacePoint> surface_point(Vec3 from, Vec3 direction) const = 0;
    /// Returns why a landmark cannot have this name, for people; empty if it can. Picked ones are not compared.
    [[nodiscard]] virtual std::string problem_of_name(const std::string& id) const = 0;
    /// Returns one line about a landmark: its position, or its length and how much of it lies in bone.
    [[nodiscard]] virtual std::string description(const PickedLandmark& landmark) const = 0;
    /// Returns the lines that belong below `landmarks:`.
    [[nodiscard]] virtual std::string yaml(const std::vector<PickedLandmark>& picked) const = 0;
    /// Writes the landmarks into the file, all or none. Returns the reason if it cannot; empty on success, after which
    /// they are among `written`.
    [[nodiscard]] virtual std::string write(const std::vector<PickedLandmark>& picked) = 0;
};

}  // namespace kerf::window
