// SPDX-License-Identifier: Apache-2.0
#include "app/motion_recorder.h"

#include <algorithm>
#include <cstddef>

#include "core/haptics/loop/device_report.h"
#include "devices/motion/motion_text.h"
#include "session/recorder.h"
#include "text/write_file.h"

namespace kerf::app {

MotionRecorder::MotionRecorder(double seconds) {
    constexpr double rows_per_second = 1100.0;  // a clock that was late catches up
    rows_.reserve(std::min(static_cast<std::size_t>(rows_per_second * seconds), motion::max_rows));
}

void MotionRecorder::take(double time, const kerf_device_state& state) {
    if ((state.flags & KERF_DEVICE_VALID) == 0 || !is_usable(state.device_from_handle)) return;
    if (!start_) start_ = time;
    const double since = time - *start_;
    if (!rows_.empty() && since <= rows_.back().time) return;
    rows_.push_back({since, state.device_from_handle, state.buttons});
}

std::string MotionRecorder::write(const std::string& file) const {
    const std::string text = motion::text_of(rows_, std::string(session::notice_line) + ".");
    std::string fault;
    if (!motion::parse_motion(text, fault)) return "the motion cannot be recorded: " + fault;
    return text::write_file(file, text);
}

}  // namespace kerf::app
