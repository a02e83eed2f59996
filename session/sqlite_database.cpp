// SPDX-License-Identifier: Apache-2.0
#include "session/sqlite_database.h"

#include <sqlite3.h>

#include <utility>

#include "session/sqlite_reason.h"

namespace kerf::session {

bool SqliteDatabase::check(int code) {
    if (code == SQLITE_OK || code == SQLITE_DONE || code == SQLITE_ROW) return error_.empty();
    if (!error_.empty()) return false;
    if (code == SQLITE_NOMEM) {
        error_ = "out of memory";  // short enough to need no heap
        return false;
    }
    error_ = outside_reason(handle_, code);
    if (error_.empty()) error_ = handle_ != nullptr ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
    return false;
}

bool SqliteDatabase::open(const std::string& path) {
    const bool is_open = check(sqlite3_open_v2(
        path.c_str(), &handle_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr));
    if (is_open) sqlite3_busy_timeout(handle_, 2000 /* ms */);
    return is_open && run("PRAGMA temp_store=MEMORY");  // a run needs no disk but that of its folder
}

void SqliteDatabase::close() noexcept {
    sqlite3_close(handle_);
    handle_ = nullptr;
}

void SqliteDatabase::keep_files_on_close() noexcept {
    if (handle_ != nullptr) sqlite3_db_config(handle_, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

std::string SqliteDatabase::recover() {
    std::string error = std::move(error_);
    error_.clear();
    if (handle_ != nullptr && sqlite3_get_autocommit(handle_) == 0) run("ROLLBACK");
    error_.clear();  // the error may have ended the transaction already, so a failed rollback does not matter
    return error;
}

bool SqliteDatabase::run(const std::string& sql) {
    if (!is_good()) return false;
    return check(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr));
}

bool SqliteDatabase::try_run(const std::string& sql) {
    return is_good() && sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
}

void SqliteDatabase::fail(const std::string& error) {
    if (error_.empty()) error_ = error;
}

SqliteStatement::~SqliteStatement() { finalize(); }

void SqliteStatement::prepare(SqliteDatabase& database, const std::string& sql) {
    finalize();
    database_ = &database;
    if (!database.is_good()) return;
    database.check(
        sqlite3_prepare_v2(database.handle_, sql.c_str(), static_cast<int>(sql.size()), &statement_, nullptr));
}

void SqliteStatement::finalize() noexcept {
    sqlite3_finalize(statement_);
    statement_ = nullptr;
}

SqliteStatement& SqliteStatement::operator<<(double value) {
    if (statement_ != nullptr) database_->check(sqlite3_bind_double(statement_, ++column_, value));
    return *this;
}

SqliteStatement& SqliteStatement::operator<<(std::int64_t value) {
    if (statement_ != nullptr) database_->check(sqlite3_bind_int64(statement_, ++column_, value));
    return *this;
}

SqliteStatement& SqliteStatement::operator<<(std::string_view text) {
    if (statement_ != nullptr)
        database_->check(
            sqlite3_bind_text(statement_, ++column_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
    return *this;
}

SqliteStatement& SqliteStatement::operator<<(std::span<const unsigned char> bytes) {
    if (statement_ != nullptr)
        database_->check(sqlite3_bind_blob64(statement_, ++column_, bytes.data(), bytes.size(), SQLITE_STATIC));
    return *this;
}

SqliteStatement& SqliteStatement::null() {
    if (statement_ != nullptr) database_->check(sqlite3_bind_null(statement_, ++column_));
    return *this;
}

bool SqliteStatement::run() {
    if (statement_ == nullptr || !database_->is_good()) return false;  // a row after a lost one would leave a gap
    const int step_code = sqlite3_step(statement_);
    const bool is_done = database_->check(step_code);
    sqlite3_reset(statement_);
    column_ = 0;
    return is_done;
}

}  // namespace kerf::session
