// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>
#include <string_view>

#include "devices/motion/motion_text.h"
#include "tests/fuzz/fuzz_target.h"

bool kerf::fuzz::reads(std::string_view input) {
    std::string error;
    const auto rows = motion::parse_motion(input, error);
    require(rows.has_value() == error.empty(), "a result comes, or else an error");
    for (const char c : error) require(c != '\n' && c != '\x1b', "an error can be printed");
    if (!rows) return false;
    require(!rows->empty(), "a motion has a row");
    double before = -1.0;
    for (const motion::MotionRow& row : *rows) {
        const Quat& q = row.device_from_handle.rotation;
        require(row.time > before, "times rise from 0 on");
        require(is_finite(row.device_from_handle), "a pose is finite");
        require(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 1e-11, "a rotation is normalised");
        before = row.time;
    }
    const std::string written = motion::text_of(*rows, "");
    const auto again = motion::parse_motion(written, error);
    require(again.has_value() && motion::text_of(*again, "") == written, "what was read can be written");
    const motion::Motion motion(*rows);
    require(motion.button_count() <= 32, "a button is a bit");
    require(motion.at(86'400'001).buttons == 0, "after the end no button is pressed");
    return true;
}
