// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A side wall of a lumbar pedicle at its isthmus, as micro-CT of six spines has it [irie-2021]. In the median 99.8 %
/// of a medial wall's area is bone, of a lateral one's under 64 % on every level: 100 and 64 % are taken, of its
/// volume.
struct PedicleWall {
    bool is_medial;    ///< towards the canal; else the lateral one
    int level;         ///< of L1 to L5
    double thickness;  ///< [m] in the mean
    [[nodiscard]] double bone() const noexcept { return is_medial ? 1.0 : 0.64; }  ///< [–]
    [[nodiscard]] std::string name() const;
};
/// Both sides on every level; the walls above and below, several times as thick, are left out.
[[nodiscard]] std::span<const PedicleWall> pedicle_walls() noexcept;

/// An awl's way into the phantom's pedicle, from where it has the entry's cortex behind it.
struct AwlWay {
    const PedicleWall* wall = nullptr;  ///< that it breaks; null: it stays inside
    double push = 0.0;                  ///< [N] the largest
};

/// Along the planned axis first, then `aimed_wrong` beside it through each of `pedicle_walls()`, to the side where that
/// is.
[[nodiscard]] std::vector<AwlWay> awl_ways();

/// [deg] [judgement]; from 17.5° on a tool slipped no more along the shell of foam pedicles [tolerance-angle].
inline constexpr double aimed_wrong = 20.0;

/// What surgeons pushed with, in 42 pedicles of cadavers [cors-2013]: safe ways and breaches on purpose [N].
inline constexpr double measured_safe_push = 90.0, measured_breach_push[] = {135.0, 155.0};

}  // namespace kerf::chart
