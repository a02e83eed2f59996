// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/field/cut/cut_log.h"
#include "studies/chart/drill/method.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// M8: the lip integral on Kerf's distance fields. Distances are asked for at a few nodes of each edge; between them
/// they are taken as straight, so borders are found where that line is zero, and stretches are integrated as a whole.
/// The cut is read with lag and gap, as Kerf's edges do.
class LipRun : public Run {
public:
    /// `fineness.points`: nodes per lip; the chisel edge has a quarter of them per half, at least 2.
    LipRun(const Scene& scene, const CuttingLaw& law, const Fineness& fineness);

    Felt tick(const Pose& next) override;
    void command_spindle(double revolutions_per_second) override { spindle_ = revolutions_per_second; }
    double removed_volume() override;

private:
    struct Node {
        double s, surface;
        double border[KERF_MAX_TISSUES];
    };
    [[nodiscard]] Node sample_at(int edge, double s) const;
    [[nodiscard]] Engaged engaged() const;
    [[nodiscard]] double min_gap(const Engaged& engaged) const;
    [[nodiscard]] Vec6 wrench(double rate, const Engaged& engaged, double gap) const;

    Scene scene_;
    CuttingLaw law_;
    int nodes_;
    Body body_;
    ToolSolid solid_;
    CutField committed_, exact_;
    CutTracker tracker_;
    std::vector<double> resistance_;  ///< of each material
    Pose pose_;
    double spindle_, angle_ = 0.0;
    std::uint64_t tick_ = 0;
};

}  // namespace kerf::chart
