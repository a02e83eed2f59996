// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A wall of lumbar pedicles as micro-CT of six spines has it: its mean thickness [irie-2021]. Of the medial wall 99.8 % is bone (95.9 to 100), of the
/// lateral one under 64 % on every level: 100 and 64 % are taken.
struct PedicleWall {
    bool is_medial;    ///< towards the canal; else the lateral one
    int first, last;   ///< of the lumbar vertebrae that have it so thick
    double thickness;  ///< [m]
    [[nodiscard]] double bone() const noexcept { return is_medial ? 1.0 : 0.64; }  ///< [–] of its volume
    [[nodiscard]] int levels() const noexcept { return last - first + 1; }
    [[nodiscard]] std::string name() const;
};
/// All that were measured, of L1 to L5.
inline constexpr PedicleWall pedicle_walls[] = {{true, 1, 3, 0.8e-3},  {true, 4, 5, 1.3e-3},  {false, 1, 1, 0.6e-3}, {false, 2, 2, 0.7e-3},
                                                {false, 3, 3, 0.9e-3}, {false, 4, 4, 1.1e-3}, {false, 5, 5, 1.7e-3}};

/// An awl's push along a way into the phantom's pedicle, from where it has the entry's cortex behind it.
struct AwlWay {
    struct At {
        double depth, push;  ///< [m] of the tip; [N]
    };
    const PedicleWall* wall = nullptr;  ///< that it breaks; null: it stays inside
    std::vector<At> pushes{};
    [[nodiscard]] double most() const noexcept;  ///< [N]
};

/// Along the planned axis first, then `aimed_wrong` beside it through each of `pedicle_walls`, to the side where that is.
[[nodiscard]] std::vector<AwlWay> awl_ways();

/// [deg] [judgement]; from 17.5° on a tool slipped no more along the shell of foam pedicles [tolerance-angle].
inline constexpr double aimed_wrong = 20.0;

/// What surgeons pushed with, in 42 pedicles of cadavers [cors-2013]: safe ways and breaches on purpose [N].
inline constexpr double measured_safe_push = 90.0, measured_breach_push[] = {135.0, 155.0};

}  // namespace kerf::chart
