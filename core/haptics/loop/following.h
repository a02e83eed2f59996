// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/haptics/law/solve.h"

namespace kerf {

/// What follows a law without working against the tool's rate: reaction torque, lateral imbalance.
///
/// It goes with λ̄, a filtered λ kept by the channels' ids: taken with λ itself it diverges from μ = 1.1 on (R1).
class Following {
public:
    /// `own` and Σ follow λ̄ for the balance's channels, tool frame. The coupling alone holds what follows; more than it
    /// can carry has no balance, so at most half of that is given.   [haptic, nonblocking]
    [[nodiscard]] Vec6 wrench(const Balance& balance, const Vec6& own) const noexcept;
    /// λ̄ ← λ̄ + α(λ − λ̄), α = 1/(1 + μ²), μ = max |follow|/|d| in the coupling's own norm. A channel that is gone is
    /// forgotten.   [haptic, nonblocking]
    void update(const Balance& balance, const Motion& motion) noexcept;
    void forget() noexcept { count_ = 0; }

private:
    struct Filtered {
        std::uint32_t id = 0;
        double lambda = 0.0;
    };
    [[nodiscard]] double lambda_of(std::uint32_t id) const noexcept;

    std::array<Filtered, most_channels> filtered_{};
    std::size_t count_ = 0;
};

}  // namespace kerf
