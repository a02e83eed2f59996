// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/solids.h"
#include "kerf/math.hpp"

namespace kerf::documents {

/// Straight lines through a bone, to measure it.
class Lines {
public:
    /// Pre: the bone outlives the lines.
    explicit Lines(const PhantomSource& bone) : bone_(bone) {}

    /// Returns how far the border of bone is from a point in a direction, to 5 µm [m]; +infinity beyond 120 mm.
    [[nodiscard]] double to_border(Vec3 from, Vec3 along) const;

    /// Both ends of the bone, or of the gap, around a point on a line.
    struct Chord {
        double behind = 0.0, ahead = 0.0;  ///< [m] from the point
        [[nodiscard]] double size() const noexcept { return behind + ahead; }
        [[nodiscard]] double middle() const noexcept { return 0.5 * (ahead - behind); }
    };
    [[nodiscard]] Chord across(Vec3 at, Vec3 along) const { return {to_border(at, -along), to_border(at, along)}; }

private:
    const PhantomSource& bone_;
};

}  // namespace kerf::documents
