// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/edge_law.hpp"
#include "studies/chart/exact_bone.h"
#include "studies/chart/named_setup.h"
#include "studies/chart/powered/exact_cut.h"
#include "studies/chart/powered/swept_ball.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A round burr and its law, docs/models/burr.md; all SI. Tool frame: the ball's tip is the origin.
struct BallBurr {
    double radius, neck_radius, blades, speed;
    EdgeCoefficients thrust, cutting;
    double reference_density;

    /// Out of the parameters of `round_burr` and `burr_cutting`.
    explicit BallBurr(const Values& values);
    [[nodiscard]] static std::vector<std::string> parameters();  ///< those that it needs
};

/// The law of a round burr, integrated over the part of its ball that is in bone and moves into it:
///
///     F = −N/(2π) ∫∫ m (f_n(t) n + f_t(t) e) R dθ dφ,    t = v·n / (N u),    v·n > 0
///     dV/dt = ∫∫ v·n R² sin θ dθ dφ
///
/// θ from the tip. Bone is that of the scene without all that the ball has swept before. Along each meridian borders
/// are found by bisection; 96 meridians, closer to each other where v·n changes its sign.
class ExactBurr : public ExactCut {
public:
    /// The bone must outlive this.
    ExactBurr(const ExactBone& bone, const BallBurr& burr) : bone_(&bone), burr_(burr), swept_(burr.radius) {}

    [[nodiscard]] std::optional<Vec6> tick(const Pose& body_from_tool, const Vec6& rate) override;
    [[nodiscard]] double volume() const noexcept override { return volume_; }

private:
    const ExactBone* bone_;
    BallBurr burr_;
    SweptBall swept_;
    double volume_ = 0.0;
};

}  // namespace kerf::chart
