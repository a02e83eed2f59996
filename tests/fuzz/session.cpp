// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "core/session/read_session.h"
#include "tests/fuzz/scratch_file.h"

bool kerf::fuzz::reads(std::string_view input) {
    static const ScratchFolder folder;
    std::string error;
    const auto inputs = read_session(folder.hold("session.db", input), error);
    require(inputs.has_value() == error.empty(), "inputs come, or else an error");
    if (!inputs) return false;
    require(!inputs->device_from_handle.empty(), "a session has ticks");
    for (const Pose& pose : inputs->device_from_handle) require(is_finite(pose.position), "the hand was somewhere");
    return true;
}
