// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// An awl's push along a way into the pedicle of L4, from where it has the entry's cortex behind it.
struct AwlWay {
    struct At {
        double depth, push;  ///< [m] of the tip; [N]
    };
    std::string wall{};            ///< what it breaks, for people; empty: it stays inside
    std::string remark{};          ///< where its thickness is from
    std::vector<At> pushes{};
    [[nodiscard]] double most() const noexcept;  ///< [N]
};

/// Along the planned axis first, then `aimed_wrong` beside it towards the canal, through walls of several thicknesses.
[[nodiscard]] std::vector<AwlWay> awl_ways();

/// [deg] [judgement]
inline constexpr double aimed_wrong = 20.0;

/// What surgeons pushed with, in 42 pedicles of cadavers [cors-2013]: safe ways and breaches on purpose [N].
inline constexpr double measured_safe_push = 90.0, measured_breach_push[] = {135.0, 155.0};

}  // namespace kerf::chart
