// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <string>
#include <vector>

#include "session/content_hash.h"
#include "session/record_checksum.h"
#include "session/recorded_rows.h"
#include "session/recorder.h"
#include "session/session_tables.h"

namespace kerf::test {

/// Runs statements of SQL on a file. Returns what went wrong; empty if nothing did.
inline std::string run_sql(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    const bool is_done = sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK &&
                         sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
    const std::string error = is_done ? "" : sqlite3_errmsg(database);
    sqlite3_close(database);
    return error;
}

/// Rows of a session's table, compressed or plain; -1 if they cannot be counted.
inline long long row_count(const std::string& path, const std::string& table) {
    sqlite3* database = nullptr;
    sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
    const auto count = session::recorded_row_count(database, table);
    sqlite3_close(database);
    return count ? static_cast<long long>(*count) : -1;
}

namespace detail {

inline std::string make_plain(sqlite3* database, const session::Table& table, std::size_t blocks_left) {
    std::vector<std::string> names;
    for (const session::TableColumn& column : table.columns) names.push_back(column.name);
    std::vector<std::vector<double>> all;
    session::RecordedRows rows(database, table, names);
    for (std::size_t left = blocks_left * session::max_block_rows; rows.next();) {
        if (left > 0 && left-- > 0) continue;
        std::vector<double>& row = all.emplace_back();
        for (std::size_t column = 0; column < names.size(); ++column) row.push_back(rows.number(column));
    }
    if (!rows.fault().empty()) return rows.fault();
    const std::string remove = "DELETE FROM blocks WHERE table_name = '" + table.name +
                               "' AND block >= " + std::to_string(blocks_left) + "; DELETE FROM " + table.name;
    sqlite3_exec(database, remove.c_str(), nullptr, nullptr, nullptr);
    sqlite3_stmt* insert = nullptr;
    if (sqlite3_prepare_v2(database, session::insert_sql(table).c_str(), -1, &insert, nullptr) != SQLITE_OK)
        return sqlite3_errmsg(database);
    for (const auto& row : all) {
        for (std::size_t column = 0; column < row.size(); ++column)
            sqlite3_bind_double(insert, static_cast<int>(column) + 1, row[column]);
        sqlite3_step(insert);
        sqlite3_reset(insert);
    }
    sqlite3_finalize(insert);
    return {};
}

}  // namespace detail

/// Turns all blocks of a session but the first `blocks_left` full ones into plain rows, as a killed run leaves its last
/// rows: SQL reads and changes them. A checksum is renewed. Returns what went wrong; empty if nothing did.
inline std::string make_rows_plain(const std::string& path, std::size_t blocks_left = 0) {
    sqlite3* database = nullptr;
    if (sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) != SQLITE_OK) return "not opened";
    sqlite3_exec(database, "BEGIN", nullptr, nullptr, nullptr);
    const auto tables = session::recorded_tables(database);
    std::string error;
    for (const char* name : {session::ticks_table, session::cuts_table})
        if (error.empty()) error = detail::make_plain(database, session::find_table(tables, name), blocks_left);
    if (const auto sum = session::record_checksum(database); sum && error.empty())
        sqlite3_exec(
            database,
            ("UPDATE session SET value='" + session::hex16(*sum) + "' WHERE key='" + session::record_checksum_key + "'")
                .c_str(),
            nullptr, nullptr, nullptr);
    sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr);
    sqlite3_close(database);
    return error;
}

}  // namespace kerf::test
