// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kerf/edge_law.hpp"
#include "studies/chart/exact_bone.h"
#include "studies/chart/named_setup.h"
#include "studies/chart/powered/exact_cut.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A straight blade that moves to and fro along its edge, docs/models/reciprocating-saw.md; all SI. Tool frame: origin
/// in the middle of the toothed edge, x along the blade, z out of that edge.
struct StraightSaw {
    double length, height, stroke, pitch, thickness, set, rate;
    EdgeCoefficients thrust;
    double set_share, reference_density;

    /// Out of the parameters of `reciprocating_blade` and `reciprocating_cutting`.
    explicit StraightSaw(const Values& values);
    [[nodiscard]] static std::vector<std::string> parameters();                   ///< those that it needs
    [[nodiscard]] double kerf() const noexcept { return thickness + 2.0 * set; }  ///< [m]
    [[nodiscard]] int teeth() const noexcept;
    /// Chip thickness for each metre a second of feed [s] at a phase of the oscillation: what the feed has gained since
    /// the tooth before passed, at most half a cycle ago.
    ///
    ///     min(p/|V|, 1/(2u)),   V = π u S cos φ
    [[nodiscard]] double chip_per_feed(double phase) const noexcept;
};

/// The law of a straight saw that is fed along its z and does not turn: over all teeth and the true oscillation,
///
///     F = 1/(2π) ∫ Σ_i m(x_i + (S/2) sin φ) w f(t(φ)) dφ
///
/// each tooth against the feed, and by its fraction to the side that it is set away from. Any other motion ends it: it
/// says nothing from there on, as what the blade then meets depends on how it has cut before.
class ExactSaw : public ExactCut {
public:
    /// The bone must outlive this.
    ExactSaw(const ExactBone& bone, const StraightSaw& saw) : bone_(&bone), saw_(saw) {}

    [[nodiscard]] std::optional<Vec6> tick(const Pose& body_from_tool, const Vec6& rate) override;
    [[nodiscard]] double volume() const noexcept override { return volume_; }

private:
    const ExactBone* bone_;
    StraightSaw saw_;
    bool is_straight_ = true;
    double volume_ = 0.0;
};

}  // namespace kerf::chart
