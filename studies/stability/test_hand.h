// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// A hand on a handle: what it adds to the device.
struct TestHand {
    const char* id;
    double mass;       ///< [kg]
    double damping;    ///< [N·s/m]
    double stiffness;  ///< [N/m]
};

inline constexpr TestHand no_hand{"none", 0.0, 0.0, 0.0};
/// The middle one is one fitted trial [van-beek-2015]; light and stiff bound what is reported of fingers and arms
/// [assumed].
inline constexpr std::array<TestHand, 4> test_hands{
    {no_hand, {"light", 0.05, 1.0, 50.0}, {"nominal", 0.554, 6.45, 135.0}, {"stiff", 1.0, 30.0, 2000.0}}};

}  // namespace kerf::stability
