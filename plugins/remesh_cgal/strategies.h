// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "kerf/strategy.hpp"

namespace kerf::remesh_cgal {

/// The library, its version and the flags that affect results.
inline constexpr const char* kernel = "CGAL " KERF_CGAL_VERSION ", assertions on, no fused multiply-add";

/// Resolution of a tool of revolution, which all strategies cut as a prism with many sides.
struct Facets {
    double tolerance = 0.0;

protected:
    template <class Strategy>
    static constexpr auto tolerance_of() {
        return remesh_tolerance(&Strategy::tolerance,
                                "Distance that the sides of a turned tool may be off its surface.",
                                "chosen: below the play of a tool's bearing");
    }
};

struct Exact : Facets {
    static constexpr auto about() {
        return describe("exact", "The whole mesh at once, in exact arithmetic: the reference, and what ends a session.",
                        remeshes_whole(kernel), tolerance_of<Exact>());
    }
    [[nodiscard]] RemeshAnswer remesh(const RemeshJob& job) const;
};

/// Cuts with rounded points first, which is fast. If the host requests the cut again, it is exact.
struct Local : Facets {
    static constexpr auto about() {
        return describe("local", "The faces near each cut, one stretch after the other, with rounded points.",
                        remeshes_patches(kernel), tolerance_of<Local>());
    }
    [[nodiscard]] RemeshAnswer remesh(const RemeshJob& job) const;
};

struct WholeRounded : Facets {
    static constexpr auto about() {
        return describe("whole_rounded",
                        "The whole mesh for each stretch, with rounded points: what `local` is measured against.",
                        remeshes_whole(kernel), tolerance_of<WholeRounded>());
    }
    [[nodiscard]] RemeshAnswer remesh(const RemeshJob& job) const;
};

}  // namespace kerf::remesh_cgal
