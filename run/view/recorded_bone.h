// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "run/view/viewed_run.h"
#include "session/report/read_run.h"

namespace kerf::run {

/// The bone that a run left, in the world frame.
struct RecordedBone {
    std::shared_ptr<const ViewedSurface> surface{};  ///< null: there is none
    std::string words{};                             ///< a clause for people: "the bone is as at the end"
};

/// Returns the surface that a session stores; for a session that does not locate it, that of `bone.stl` in its folder.
/// A file that is missing, damaged or too large gives no surface.   [main]
/// @param folder  of the session
[[nodiscard]] RecordedBone recorded_bone(const session::RecordedRun& run, const std::string& folder);

}  // namespace kerf::run
