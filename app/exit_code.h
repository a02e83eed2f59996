// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf::app {

/// Exit codes of every program of Kerf; scripts depend on them.
enum ExitCode : int {
    exit_pass = 0,
    exit_not_passed = 1,  ///< fail, incomplete or invalid; or a rehearsal with an unexpected result
    exit_bad_input = 2,
    exit_fault = 3,  ///< the machine or the program failed, or the user interrupted it
};

}  // namespace kerf::app
