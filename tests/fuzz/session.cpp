// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "session/read_session.h"
#include "session/report/read_run.h"
#include "session/report/report.h"
#include "tests/fuzz/scratch_file.h"

bool kerf::fuzz::reads(std::string_view input) {
    static const ScratchFolder folder;
    std::string error;
    const std::string path = folder.hold("session.db", input);
    const auto run = session::read_run(path, error);
    require(run.has_value() == error.empty(), "a run comes, or else an error");
    if (run) require(!session::report_html(run->summary, run->drawn).empty(), "a run has a page");
    const auto inputs = session::read_session(path, error);
    require(inputs.has_value() == error.empty(), "inputs come, or else an error");
    if (!inputs) return run.has_value();
    require(!inputs->device_from_handle.empty(), "a session has ticks");
    for (const Pose& pose : inputs->device_from_handle) require(is_finite(pose.position), "the hand was somewhere");
    return true;
}
