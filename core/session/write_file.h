// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kerf {

/// Writes a whole file: readers see the old one or the new one, never half of it (a temporary file beside it, then
/// a rename). Returns what went wrong, for people; empty if nothing did.   [main]
[[nodiscard]] std::string write_file(const std::string& path, std::string_view contents);
[[nodiscard]] std::string write_file(const std::string& path, std::span<const unsigned char> contents);

/// Keeps other runs out of a folder as long as it lives. The system lets go of it when the process ends, however that
/// happens, so nothing stale can block a later run. File systems that know no locks are written to without one.
class OutputLock {
public:
    OutputLock() = default;
    ~OutputLock();
    OutputLock(const OutputLock&) = delete;
    OutputLock& operator=(const OutputLock&) = delete;

    /// Returns why not, for people; empty when it is ours.   [main]
    [[nodiscard]] std::string take(const std::string& folder);

private:
    int folder_ = -1;  ///< opened
};

/// Whether somebody holds a folder with an OutputLock.   [main]
[[nodiscard]] bool is_being_written(const std::string& folder);

/// Makes `folder` ready for a run's files, and ours alone while `lock` lives. A folder that exists is emptied only if
/// it holds a session of ours (session.db) and nothing that no run writes; an empty one is taken as it is; anything
/// else is left alone and refused. Returns why, for people; empty when the folder is ready.   [main]
[[nodiscard]] std::string prepare_output(const std::string& folder, OutputLock& lock);

}  // namespace kerf
