// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/measure/surface.h"
#include "core/field/cut/cut_field.h"
#include "core/field/grid/body.h"

namespace kerf::bone {

/// The remaining bone as the zero of its distance field.
///
/// A smooth wall is accurate to a twentieth of the spacing h (docs/limits.md). Marching cubes cut off a sharp edge by
/// up to half a spacing, so a contact has the standard uncertainty of an interval of one spacing: h / √12 ([gum-2008],
/// 4.3.7). Neither includes the accuracy of the scan.
class FieldSurface final : public MeasuredSurface {
public:
    /// Pre: both outlive it.
    FieldSurface(const Body& body, const CutField& cut) : body_(&body), cut_(&cut) {}

    [[nodiscard]] std::vector<Vec3> points_in(const Path& region) const override;
    /// Walks in steps of half a spacing, and finds each wall by bisection.
    [[nodiscard]] std::vector<Stretch> stretches_on(const Line& line, double low, double high) const override;
    /// Beyond the range of the field, this is the distance to the nearest vertex of the surface: too large by less than
    /// h²/8d.
    [[nodiscard]] std::optional<double> distance_to(Vec3 p) const override;
    /// Returns the distance along a line [m] at which it first enters the bone, between `low` and `high`; nothing if it
    /// does not. An entry through a face of the body's region is no surface and is skipped, and so is a line that
    /// begins in bone until it has left it. May miss bone thinner than half of the spacing.   [any] pure.
    [[nodiscard]] std::optional<double> entry_on(const Line& line, double low, double high) const;
    /// Returns the unit normal out of the bone at a point near its surface; zero where the field is flat.   [any] pure.
    [[nodiscard]] Vec3 normal_at(Vec3 p) const noexcept;
    [[nodiscard]] double wall_uncertainty() const noexcept override;
    [[nodiscard]] double contact_uncertainty() const noexcept override;

private:
    [[nodiscard]] double value_at(Vec3 p) const noexcept;
    [[nodiscard]] bool is_known(Vec3 p) const noexcept;
    /// Returns where a line crosses the surface between a point outside and a point inside, by bisection [m].
    [[nodiscard]] double wall_between(const Line& line, double outside, double inside) const noexcept;

    const Body* body_;
    const CutField* cut_;
};

}  // namespace kerf::bone
