// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "studies/chart/run.h"

/// One marker of the chart. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

struct Cost {
    double median = 0.0, p999 = 0.0, longest = 0.0;  ///< [µs] per tick, on the processor
};

struct Measured {
    double force_error =
        0.0;  ///< [–] RMS|F − F_ref| / RMS|F_ref|, all grids together; of a method that `walks`, of the thrust
    double worst_grid = 0.0;    ///< [–] of the grid on which it is largest
    double volume_error = 0.0;  ///< [–] |V − V_exact| / V_exact, mean of the grids
    double peak_step = 0.0;  ///< [–] largest step from tick to tick beside the reference's own, of the largest |F_ref|
    double off_lateral = 0.0;  ///< [N] largest force across the shaft where the reference has none over 1 N
    double reference = 0.0;    ///< [N] RMS|F_ref|
    double gain = 1.0;         ///< [–] its calibration
    double same_hand =
        0.0;  ///< [–] RMS of how far its thrust is from what the same hand feels on the finest grid, of that one's RMS
    double same_hand_turn = 0.0;    ///< [–] the same of means over a turn of the spindle
    double apart = 0.0;             ///< [m] how far its tip comes from where that hand leads it there, at most
    double off_none = 0.0;          ///< [N] largest force where the reference has less than 1 mN
    double torque_error = 0.0;      ///< [–] RMS(T − T_ref) / RMS T_ref about the scene's line; 0: it has none
    double torque_reference = 0.0;  ///< [N·m] RMS T_ref
    double exact_share = 1.0;       ///< [–] of the ticks whose reference is exact; that of the others is a replay
    double exact_error = 0.0;       ///< [–] `force_error` of these ticks alone
    Cost cost;
    bool is_finite = true;  ///< every force was; those that were not count in nothing else
};

/// What one run felt, tick by tick, and what it should have felt.
struct Track {
    std::vector<Felt> felt;
    std::vector<Vec6> reference;  ///< as `Felt::wrench`
    std::vector<bool> is_compared;
    std::vector<bool> is_exact;                   ///< the reference of the tick; empty: all are
    double volume = 0.0, volume_reference = 0.0;  ///< [m³]
};

/// A line of the tool, about which a torque is compared.
struct TorqueLine {
    Vec3 at{}, along{};  ///< tool frame [m], unit

    /// Of a wrench about the tip [N·m].   [any] pure.
    [[nodiscard]] double torque(const Vec6& wrench) const noexcept {
        return dot(along, angular(wrench) - cross(at, linear(wrench)));
    }
};

/// Sums the errors of runs on several grids.
class ErrorSum {
public:
    /// @param thrust_alone  the reference is right along the shaft only
    explicit ErrorSum(bool thrust_alone, std::optional<TorqueLine> line = {})
        : thrust_alone_(thrust_alone), line_(line) {}

    void add(const Track& track);
    /// Pre: a track was added.
    [[nodiscard]] Measured measured() const;

private:
    /// Σ of squares of differences and of references.
    struct Squares {
        double wrong = 0.0, right = 0.0;
        [[nodiscard]] double ratio() const noexcept;
    };
    bool thrust_alone_;
    std::optional<TorqueLine> line_;
    Measured measured_;
    Squares all_, exact_, torque_;
    double ticks_ = 0.0, exact_ticks_ = 0.0;
    int tracks_ = 0;
    std::vector<double> costs_;
};

}  // namespace kerf::chart
