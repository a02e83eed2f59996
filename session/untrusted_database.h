// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

struct sqlite3;

namespace kerf::session {

/// An untrusted database of SQLite, opened for reading. Nothing is written to it or to its folder, which may be
/// read-only. A link is followed first: SQLite's files belong to its target. Rows in the -wal file of a killed run are
/// read, too. A query whose work is out of proportion to the file's size is stopped and fails.
class UntrustedDatabase {
public:
    UntrustedDatabase() = default;
    ~UntrustedDatabase();
    UntrustedDatabase(const UntrustedDatabase&) = delete;
    UntrustedDatabase& operator=(const UntrustedDatabase&) = delete;

    /// Opens the file that `path` leads to. Returns the reason if it cannot, for people, with `path` as it is written:
    /// a run still writes it, one of SQLite's files next to it is not a regular file or may not be read, or the system
    /// refuses it. Never waits, as a read from a FIFO would. `is_own`: the run that wrote it reads it, and still has
    /// its folder locked. Pre: `path` leads to a regular file.   [main]
    [[nodiscard]] std::string open(const std::string& path, bool is_own = false);

    [[nodiscard]] sqlite3* handle() const noexcept { return database_; }
    [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }  ///< including the -wal file

private:
    static int is_over(void* self);

    sqlite3* database_ = nullptr;
    std::uint64_t bytes_ = 0;
    std::int64_t steps_left_ = 0;
};

}  // namespace kerf::session
