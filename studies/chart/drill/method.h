// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "studies/chart/drill/scene.h"
#include "studies/chart/run.h"

/// Ways to make the force of a drill, one beside the other. For training and research; not for diagnosis, planning or
/// deciding treatment.
namespace kerf::chart {

struct Method {
    std::string id{};     ///< "M8"
    std::string title{};  ///< for people
    Knob knob = Knob::spacing;
    std::vector<Fineness> sweep{};  ///< coarse to fine
    bool is_as_printed = false;     ///< with the paper's own slips
    bool is_solved = false;         ///< the tool finds its own motion: only its thrust can be held against the law
    bool is_calibrated = false;     ///< its one constant is set in whole cortical bone
    int first_lag = 0;              ///< [ticks] after which its spindle turns
    /// Of solved methods: what is solved with.
    std::function<ToolSetup(const Scene&, const Fineness&)> setup{};
    /// Of solved methods: the same law at the rate of a prescribed motion, to replay theirs on a finer grid.
    std::function<std::unique_ptr<Run>(const Scene&, const Fineness&)> replay{};
    /// @param gain  on its force [–]; 1 where it is not calibrated
    std::function<std::unique_ptr<Run>(const Scene&, const Fineness&, double gain)> start{};
};

/// Whether its tool is pushed aside, so that no law of a straight way holds.
[[nodiscard]] inline bool walks(const Method& method, const Scene& scene) noexcept {
    return method.is_solved && scene.is_oblique;
}

}  // namespace kerf::chart
