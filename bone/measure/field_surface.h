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
    [[nodiscard]] double wall_uncertainty() const noexcept override;
    [[nodiscard]] double contact_uncertainty() const noexcept override;

private:
    [[nodiscard]] double value_at(Vec3 p) const noexcept;

    const Body* body_;
    const CutField* cut_;
};

}  // namespace kerf::bone
