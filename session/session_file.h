// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "session/untrusted_database.h"

struct sqlite3;
struct sqlite3_stmt;

namespace kerf::session {

/// A connection, and the first reason outside of its file why a query failed. A connection alone notes none.
struct SessionHandle {
    // Implicit: most callers have a connection alone.
    SessionHandle(sqlite3* connection, std::string* first_reason = nullptr)
        : database(connection), outside_reason(first_reason) {}

    sqlite3* database;
    std::string* outside_reason;  ///< may be null
};

/// One SELECT, read row by row. After a failure there are no more rows.
class SessionQuery {
public:
    SessionQuery(const SessionHandle& session, const std::string& sql);
    ~SessionQuery();
    SessionQuery(const SessionQuery&) = delete;
    SessionQuery& operator=(const SessionQuery&) = delete;

    bool next();
    [[nodiscard]] bool has_failed() const noexcept;
    [[nodiscard]] int columns() const;
    [[nodiscard]] int type(int column) const;  ///< SQLITE_INTEGER, SQLITE_FLOAT …
    [[nodiscard]] bool is_number(int column) const;
    [[nodiscard]] bool is_null(int column) const;
    [[nodiscard]] double number(int column) const;
    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] std::string text(int column) const;
    [[nodiscard]] std::vector<unsigned char> bytes(int column) const;
    [[nodiscard]] std::string_view bytes_view(int column) const;  ///< valid until the next row

private:
    void note_failure();

    SessionHandle session_;
    sqlite3_stmt* statement_ = nullptr;
    int code_ = 0;
};

/// An untrusted session file, opened for reading as an UntrustedDatabase.
class SessionFile {
public:
    /// Opens the file. Returns the reason if it cannot, for people: no session, another schema, tables that compute
    /// their rows, or a reason of UntrustedDatabase::open().   [main]
    [[nodiscard]] std::string open(const std::string& path, const std::vector<std::string>& tables,
                                   bool is_own = false);

    [[nodiscard]] SessionHandle handle() noexcept { return {database_.handle(), &outside_reason_}; }
    /// Returns why the file cannot be read now, for people, if the reason is not in its contents: a full disk, a limit,
    /// a lock. Empty if no query failed for such a reason: then a failure is damage.
    [[nodiscard]] std::string outside_reason() const;
    [[nodiscard]] std::uint64_t bytes() const noexcept {
        return database_.bytes();
    }  ///< including the -wal file; no sound session contains more text

private:
    [[nodiscard]] std::string refusal_of_contents(const std::vector<std::string>& tables);

    std::string path_, outside_reason_;
    UntrustedDatabase database_;
};

}  // namespace kerf::session
