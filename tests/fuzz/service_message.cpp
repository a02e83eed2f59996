// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>
#include <string_view>

#include "devices/haply/arm_session.h"
#include "devices/haply/service_text.h"
#include "kerf/math.hpp"
#include "tests/fuzz/fuzz_target.h"

bool kerf::fuzz::reads(std::string_view input) {
    std::string fault;
    const auto state = haply::read_state(input, fault);
    require(state.has_value() == fault.empty(), "a message is read, or there is a reason");
    if (state)
        for (const haply::Arm& arm : state->arms)
            require(!arm.position || is_finite(*arm.position), "a position is of numbers");
    if (state)
        for (const haply::Grip& grip : state->grips)
            if (grip.rotation) {
                const Quat& q = *grip.rotation;
                require(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 1e-6,
                        "a rotation is a unit quaternion");
            }
    if (const auto event = haply::read_event(input)) static_cast<void>(haply::problem_of(*event));
    haply::ArmSession session("", {});
    const bool goes_on = session.take(input);
    require(goes_on || !session.problem().empty(), "a session goes on, or there is a reason");
    require(haply::read_state(session.command({0.1, 0.2, 0.3}), fault).has_value(), "a command is JSON");
    return state.has_value();
}
