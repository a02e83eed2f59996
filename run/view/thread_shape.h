// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/law/tool.h"
#include "run/view/facets.h"

/// Tools with a screw thread.
namespace kerf::run {

/// The ridge of a right-hand thread around a core, with straight flutes. Tool frame.
struct ThreadRidge {
    std::vector<kerf_profile_point> core;    ///< from the front of the thread backwards
    double crest = 0.0, crest_at_tip = 0.0;  ///< [m] radius at the back end of the thread, and at the tip
    double tip = 0.0;                        ///< [m] z of the tip
    double lead = 0.0;                       ///< [m] per turn
    std::uint32_t starts = 1;                ///< number of parallel ridges
    double root = 0.0, flank = 0.0;          ///< [m] along the axis: between two ridges, and of each flank
    std::uint32_t flutes = 0;
    double flute_length = 0.0;  ///< [m] from the tip
    std::size_t columns = 0;    ///< of points around it: fewer on a long and fine thread

    [[nodiscard]] double pitch() const noexcept { return lead / starts; }
    [[nodiscard]] double front() const noexcept { return core.front().z; }
    [[nodiscard]] double back() const noexcept { return core.back().z; }
    [[nodiscard]] double core_at(double z) const noexcept;
    /// Returns the radius over the crests at z [m]: the ridge rises from the core in its first turn, and falls to it in
    /// its last half turn.
    [[nodiscard]] double crest_at(double z) const noexcept;
};

/// Returns the ridge of a tool. Pre: the tool has a thread.   [main]
[[nodiscard]] ThreadRidge ridge_of(const Tool& tool);

/// Returns the first `count` points of a tool with a thread: its thread, and solids of revolution before and behind it.
/// `socket` [m] is the depth of a hexagonal socket in its end; 0: none.   [main]
[[nodiscard]] Facets threaded_facets(const Tool& tool, std::size_t count, double socket);

}  // namespace kerf::run
