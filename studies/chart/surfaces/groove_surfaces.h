// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "bone/remesh/local_cutting.h"

/// The surface that a burr leaves, made in several ways. For training and research; not for diagnosis, planning or
/// deciding treatment.
namespace kerf::chart {

/// A straight groove by a ball burr in a slab of 24 × 10 × 6 mm with its top in the plane z = 0.
struct Groove {
    Vec3 from{}, to{};       ///< [m] of the tip
    double volume = 0.0;     ///< [m³] of bone, in closed form
    double radius = 2.0e-3;  ///< [m]

    [[nodiscard]] double depth() const noexcept { return -to.z; }
};
/// Its ends lie within the slab, 12 mm apart: a slot and a whole cap.
[[nodiscard]] Groove groove_within(double depth);
/// Entered across the end of the slab and 9 mm long: a slot and half of a cap.
[[nodiscard]] Groove groove_from_the_end(double depth);

/// What one way makes of a groove.
struct GrooveSurface {
    double removed = 0.0;                     ///< [m³]
    double rms = 0.0, farthest = 0.0;         ///< [m] of its walls from the exact swept surface
    double step_ms = 0.0;                     ///< of a step, on average
    std::size_t walls = 0, faces = 0;         ///< of the groove; of the whole surface
    double few_angle = 0.0, mid_angle = 0.0;  ///< [rad] least angle of the faces of its walls: 5 %, median
    int handed_over = 0;                      ///< steps that the second strategy got
    std::string flaw{};                       ///< empty: closed, no crossings
};

/// How long something took [µs]: on the processor where a strategy runs in this process, else by the clock.
using Clock = std::function<double(const std::function<void()>&)>;

/// Step by step through a strategy; what it declines goes to another one, if there is one.   [main]
[[nodiscard]] GrooveSurface surface_by_steps(const Groove& groove, const bone::StrategyCall& ask,
                                             const bone::StrategyCall& otherwise, double tolerance, double feed,
                                             const Clock& clock);
/// All of it in one request, the burr's outline in chords to 1 µm.   [main]
[[nodiscard]] GrooveSurface surface_at_once(const Groove& groove, const bone::StrategyCall& exact, const Clock& clock);
/// By the field: stamped step by step, its surface made once in the end. Its walls are the faces at least half of the
/// depth below the face of the slab.   [main]
[[nodiscard]] GrooveSurface surface_by_field(const Groove& groove, double spacing, double feed, const Clock& clock);

}  // namespace kerf::chart
