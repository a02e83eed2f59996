// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/haptics/law/solve.h"

namespace kerf {

/// Loads that follow a law without resisting the tool's rate: reaction torque and lateral imbalance.
///
/// They follow λ̄, a filtered λ stored by channel id. With λ itself the loads diverge from tick to tick if μ (see
/// `update`) is 1.1 or more.
class Following {
public:
    /// Returns `own` + Σ follow λ̄ over the balance's channels, about the tip, tool frame [N, N·m]. Only the coupling
    /// carries this load, and a load above its limits has no balance. So the result is scaled down to half of the
    /// coupling's limits if it is larger.   [haptic, nonblocking]
    [[nodiscard]] Vec6 wrench(const Balance& balance, const Vec6& own) const noexcept;
    /// Updates λ̄ ← λ̄ + α(λ − λ̄), with α = 1/(1 + μ²). μ is the maximum of |follow|/|d| over the channels, in a norm
    /// that weighs forces and torques by the coupling's inverse drag. Forgets channels that are absent from the
    /// balance. [haptic, nonblocking]
    void update(const Balance& balance, const Motion& motion) noexcept;
    void forget() noexcept { count_ = 0; }

private:
    struct Filtered {
        std::uint32_t id = 0;
        double lambda = 0.0;
    };
    [[nodiscard]] double lambda_of(std::uint32_t id) const noexcept;

    std::array<Filtered, max_balance_channels> filtered_{};
    std::size_t count_ = 0;
};

}  // namespace kerf
