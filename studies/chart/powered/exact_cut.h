// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "kerf/force.hpp"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// The law of a powered cutter along its motion, tick by tick, out of exact geometry: no grid, no points of a plugin.
class ExactCut {
public:
    virtual ~ExactCut() = default;
    /// Bone on tool about its tip, tool frame [N, N·m], while it leaves a pose at `rate` [m/s, rad/s, tool frame];
    /// engagement as at that pose. Nothing: no exact law is known for this motion.
    [[nodiscard]] virtual std::optional<Vec6> tick(const Pose& body_from_tool, const Vec6& rate) = 0;
    /// [m³] taken so far, as the flow of bone through the cutting surface.
    [[nodiscard]] virtual double volume() const noexcept = 0;
};

}  // namespace kerf::chart
