// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

/// Writes a whole file, piece by piece. Readers see the old file or the new one, never half of it, also after a power
/// cut: a temporary file `PATH.part` is written beside it, stored on disk, renamed, and the folder is stored on disk.
/// The first error is kept; after it every call does nothing.   [main]
class FileWriter {
public:
    explicit FileWriter(std::string path);
    ~FileWriter();  ///< without `finish`: the temporary file is removed, and the old file stays
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    void write(std::span<const unsigned char> bytes);
    void write(std::string_view text);

    /// Puts the file in its place. Returns what went wrong, for people; empty if nothing did.
    [[nodiscard]] std::string finish();

private:
    void fail(int error);

    std::string path_, temporary_, error_;
    int file_ = -1;
};

/// Writes a whole file with FileWriter. Returns what went wrong, for people; empty if nothing did.   [main]
[[nodiscard]] std::string write_file(const std::string& path, std::string_view contents);
[[nodiscard]] std::string write_file(const std::string& path, std::span<const unsigned char> contents);

/// Renames a file that is stored on disk, and stores the new name on disk. Returns what went wrong, for people; empty
/// if nothing did.   [main]
[[nodiscard]] std::string put_in_place(const std::string& temporary, const std::string& path);

/// Stores a file's bytes, or a folder's names, on disk. Returns 0, or errno. What knows no such order is taken as
/// stored.   [main]
[[nodiscard]] int store_on_disk(const std::string& file_or_folder);

/// Folders that were made for a result. Those that were not kept are removed again, if nothing is in them.   [main]
class MadeFolders {
public:
    MadeFolders() = default;
    ~MadeFolders();
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;

    /// Makes `folder` and those above it, as far as they are missing. Returns what went wrong, for people, having
    /// removed what it made; empty if the folder is there.
    [[nodiscard]] std::string make(const std::string& folder);
    void keep() noexcept { made_.clear(); }

private:
    std::vector<std::string> made_;  ///< outermost first
};

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

}  // namespace kerf
