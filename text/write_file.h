// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kerf::text {

/// Writes a whole file in parts. Readers see the old file or the new one, never half of it, also after a power cut. The
/// writer fills a temporary file `PATH.part` in the same folder, syncs it to disk, renames it and syncs the folder. It
/// keeps the first error; after that every call does nothing.   [main]
class FileWriter {
public:
    explicit FileWriter(std::string path);
    ~FileWriter();  ///< without `finish`: removes the temporary file and leaves the old file
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    void write(std::span<const unsigned char> bytes);
    void write(std::string_view text);

    /// Renames the temporary file to its path. Returns the error as text, empty on success.
    [[nodiscard]] std::string finish();

private:
    void fail(int error);

    std::string path_, temporary_, error_;
    int file_ = -1;
};

/// Writes a whole file with FileWriter. Returns the error as text, empty on success.   [main]
[[nodiscard]] std::string write_file(const std::string& path, std::string_view contents);
[[nodiscard]] std::string write_file(const std::string& path, std::span<const unsigned char> contents);

/// Renames a file that is on disk, and syncs the new name to disk. Returns the error as text, empty on success.
/// [main]
[[nodiscard]] std::string rename_into_position(const std::string& temporary, const std::string& path);

/// Identifies a file or folder, whatever its name. Two zeros: none.
struct FileIdentity {
    std::uint64_t device = 0, number = 0;
    friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

/// Returns the identity of the file or folder that a name leads to.   [any]
[[nodiscard]] FileIdentity identity_of(const std::string& path) noexcept;

/// Syncs a file's bytes, or a folder's names, to disk. Returns 0, or errno. Returns 0 for file systems without sync.
/// [main]
[[nodiscard]] int store_on_disk(const std::string& file_or_folder);

/// Folders made for a result. Destruction removes those that were not kept and are empty.   [main]
class MadeFolders {
public:
    MadeFolders() = default;
    ~MadeFolders();
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;

    /// Makes `folder` and its missing parents. Returns the error as text after removing the folders it made; empty on
    /// success.
    [[nodiscard]] std::string make(const std::string& folder);
    void keep() noexcept { made_.clear(); }

private:
    std::vector<std::string> made_;  ///< outermost first
};

/// Keeps other runs out of a folder during its lifetime. The system releases the lock when the process ends, so no
/// stale lock can block a later run. On file systems without locks it has no effect.
class OutputLock {
public:
    OutputLock() = default;
    ~OutputLock();
    OutputLock(const OutputLock&) = delete;
    OutputLock& operator=(const OutputLock&) = delete;

    /// Takes the lock. Returns the reason if it cannot, empty on success.   [main]
    [[nodiscard]] std::string take(const std::string& folder);

    /// Returns whether the name still leads to the locked folder: false if it was removed, renamed, replaced or
    /// unmounted. Pre: `take` has succeeded.   [main]
    [[nodiscard]] bool is_at(const std::string& folder) const;

private:
    int folder_ = -1;  ///< opened
};

/// Returns whether a process has locked a folder with an OutputLock.   [main]
[[nodiscard]] bool is_being_written(const std::string& folder);

}  // namespace kerf::text
