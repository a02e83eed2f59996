// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/options.h"

/// The files that a run reads, and whether they have changed.
namespace kerf::app {

/// Identifies a file's content without reading it: another file under the same name, or another content, differs.
struct FileState {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::int64_t written_ns = 0, changed_ns = 0;  ///< since 1970
    bool operator==(const FileState&) const = default;
};

using FileStates = std::map<std::string, FileState>;  ///< by path

/// Returns the states of all files that a run reads and that exist: plugins; the procedure, its anatomy and patches,
/// and the YAML files in their folders; what these documents name: surfaces, scans with their slices or their separate
/// voxels, label maps, markups; a session that is replayed or continued.   [main]
/// @param plugins   folders
[[nodiscard]] FileStates watched_files(const RunOptions& options, const std::vector<std::string>& plugins);

/// Returns the first file that is new, removed or different; empty if none is.   [any] pure.
[[nodiscard]] std::string first_change(const FileStates& before, const FileStates& now);

}  // namespace kerf::app
