// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace kerf::session {

/// One connection to an SQLite file. It keeps the first error; after that every call does nothing and returns false. So
/// a long list of statements needs one check at its end.   [one thread at a time]
class SqliteDatabase {
public:
    SqliteDatabase() = default;
    ~SqliteDatabase() { close(); }
    SqliteDatabase(const SqliteDatabase&) = delete;
    SqliteDatabase& operator=(const SqliteDatabase&) = delete;

    bool open(const std::string& path);
    void close() noexcept;
    /// Makes `close` leave the -wal file as it is, without merging or removing it.
    void keep_files_on_close() noexcept;
    bool run(const std::string& sql);
    /// Runs a statement that may fail without harm: its error is not kept.
    bool try_run(const std::string& sql);

    /// Rolls back an open transaction and clears the error, for one more try. Returns the error.
    std::string recover();

    [[nodiscard]] bool is_good() const noexcept { return handle_ != nullptr && error_.empty(); }
    [[nodiscard]] const std::string& error() const noexcept { return error_; }
    [[nodiscard]] sqlite3* handle() const noexcept { return handle_; }
    void fail(const std::string& error);  ///< sets an error, as a failed statement does

private:
    friend class SqliteStatement;
    bool check(int code);

    sqlite3* handle_ = nullptr;
    std::string error_;
};

/// One prepared INSERT, filled from left to right: `insert << a << b; insert.run();`
class SqliteStatement {
public:
    SqliteStatement() = default;
    SqliteStatement(SqliteDatabase& database, const std::string& sql) { prepare(database, sql); }
    ~SqliteStatement();
    SqliteStatement(const SqliteStatement&) = delete;
    SqliteStatement& operator=(const SqliteStatement&) = delete;

    void prepare(SqliteDatabase& database, const std::string& sql);
    void finalize() noexcept;

    SqliteStatement& operator<<(double value);
    SqliteStatement& operator<<(std::int64_t value);
    SqliteStatement& operator<<(std::string_view text);                 ///< copied
    SqliteStatement& operator<<(std::span<const unsigned char> bytes);  ///< must live until run()
    SqliteStatement& null();
    bool run();

private:
    SqliteDatabase* database_ = nullptr;
    sqlite3_stmt* statement_ = nullptr;
    int column_ = 0;
};

}  // namespace kerf::session
