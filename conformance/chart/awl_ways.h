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

/// Along the planned axis first, then 20° beside it towards the canal [judgement], through walls of several thicknesses.
[[nodiscard]] std::vector<AwlWay> awl_ways();

/// What surgeons pushed with, in 42 pedicles of cadavers (CORS 2013, abstract): safe ways and breaches on purpose [N].
inline constexpr double measured_safe_push = 90.0, measured_breach_push[] = {135.0, 155.0};

}  // namespace kerf::chart
