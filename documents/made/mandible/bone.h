// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/loft.h"
#include "documents/made/anatomy_text.h"
#include "documents/made/dimension.h"
#include "documents/made/mandible/frame.h"

namespace kerf::documents {

/// A point of the alveolar crest of the right side [mm].
struct CrestPoint {
    Vec3 at{}, along{};         ///< `along` leads to the chin
    double from_midline = 0.0;  ///< along the crest
    LoftFrame body{};           ///< below it [m]
};

/// The bone of a lower jaw without teeth [mm].
class MandibleBone {
public:
    explicit MandibleBone(const DimensionValues& values);

    /// Returns the solids, as parts of a phantom.
    [[nodiscard]] std::string parts() const;
    /// Returns the canals that are removed. Its teeth come before them.
    [[nodiscard]] std::string canal_parts() const;

    /// The canal of the nerve from the mental foramen to the ramus, on a side: −1 right, 1 left.
    [[nodiscard]] WrittenLoft canal(double side) const;
    /// Where its branch to the mental foramen leaves the bone; `part` 1 lies outside.
    [[nodiscard]] Vec3 mental(double side, double part) const;

    /// Returns the crest from the midline back.
    [[nodiscard]] const std::vector<CrestPoint>& crest() const noexcept { return crest_; }
    [[nodiscard]] const MandibleFrame& frame() const noexcept { return frame_; }
    /// Returns how sharply the path of the body bends, and the sharpest of the other paths, in radii of their
    /// curvature: half of the section there [–]. From 1 on, sections cross.
    [[nodiscard]] double bend_of_body() const noexcept { return bend_of_body_; }
    [[nodiscard]] double bend_of_others() const;
    /// Where the posterior border touches the condyle of the right side.
    [[nodiscard]] Vec3 condylion() const;

private:
    [[nodiscard]] double mm(const char* name) const { return 1e3 * v_[name]; }
    [[nodiscard]] double ramus_x(double height) const;
    [[nodiscard]] double notch_height() const;
    [[nodiscard]] WrittenLoft body() const;
    [[nodiscard]] WrittenLoft ramus() const;
    [[nodiscard]] std::string angle() const;
    [[nodiscard]] WrittenLoft neck() const;
    [[nodiscard]] WrittenLoft coronoid() const;
    [[nodiscard]] std::string condyle() const;
    [[nodiscard]] std::string notch() const;
    [[nodiscard]] std::vector<CrestPoint> crest_of(const LoftSolid& body) const;
    /// Returns the axis of the canal at a distance from the midline along the crest.
    [[nodiscard]] Vec3 canal_below(double from_midline) const;

    DimensionValues v_;
    MandibleFrame frame_;
    Vec3 condyle_at_{}, condyle_half_{};
    double ramus_middle_ = 0.0;  ///< |x| of the ramus at half its height
    std::vector<CrestPoint> crest_{};
    double bend_of_body_ = 0.0;
};

}  // namespace kerf::documents
