// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/window/start_page.h"

/// The attempts of learners: FOLDER/LEARNER/PROCEDURE/001, 002 …, one folder for each. Nothing in it has a date.
namespace kerf::app {

/// Makes the folder of the next attempt. Each call makes a new one, also if other processes call it at the same time.
/// Returns an empty text with the reason in `error` if it cannot.   [main]
/// @param learner    a code; empty: the folder `no-code`
/// @param procedure  its id
[[nodiscard]] std::string make_attempt_folder(const std::string& folder, const std::string& learner,
                                              const std::string& procedure, std::string& error);

/// Removes the folder of an attempt that was ended before it wrote a file; leaves any other.   [main]
void remove_empty_attempt(const std::string& attempt);

/// Returns the attempts of a learner, by procedure, newest first. An attempt without a readable summary has no result.
/// [main]
[[nodiscard]] std::vector<window::StartAttempt> read_attempts(const std::string& folder, const std::string& learner);

}  // namespace kerf::app
