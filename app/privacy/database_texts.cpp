// SPDX-License-Identifier: Apache-2.0
#include "app/privacy/database_texts.h"

#include <sqlite3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "app/privacy/byte_search.h"
#include "app/privacy/text_search.h"
#include "session/packed_column.h"
#include "session/recorder.h"
#include "session/sqlite_reason.h"
#include "session/untrusted_database.h"

namespace kerf::app::privacy {
namespace {

/// Whether a text has the form of `pattern`: 0 is a digit, f a hexadecimal digit.
bool has_form(std::string_view text, std::string_view pattern) {
    const auto fits = [](char want, char got) {
        const bool is_hex = is_digit(got) || (got >= 'a' && got <= 'f');
        return want == '0' ? is_digit(got) : want == 'f' ? is_hex : want == got;
    };
    return text.size() == pattern.size() && std::equal(pattern.begin(), pattern.end(), text.begin(), fits);
}

/// Whether a row of a session's envelope is one that Kerf writes itself: the start of the run, by its own clock, or its
/// random number. Neither identifies the person whose bone it is. Any other text in their place is searched.
bool is_written_by_kerf(const std::string& key, const std::string& value) {
    return (key == "start" && has_form(value, "0000-00-00T00:00:00Z")) ||
           (key == "uuid" && has_form(value, "ffffffff-ffff-ffff-ffff-ffffffffffff"));
}

/// Whether a row of a session's table `blocks` contains only numbers, whose bytes resemble text by chance.
bool is_packed_column(sqlite3_stmt* row, session::ColumnUnpacker& unpacker, std::vector<std::uint64_t>& cells) {
    constexpr int rows_column = 2, differences_column = 4, data_column = 5;
    if (sqlite3_column_count(row) != data_column + 1) return false;
    const auto rows = static_cast<std::uint64_t>(sqlite3_column_int64(row, rows_column));
    if (rows > session::max_block_rows || sqlite3_column_type(row, data_column) != SQLITE_BLOB) return false;
    cells.resize(rows);
    const std::span<const unsigned char> bytes(static_cast<const unsigned char*>(sqlite3_column_blob(row, data_column)),
                                               static_cast<std::size_t>(sqlite3_column_bytes(row, data_column)));
    const int differences = sqlite3_column_int(row, differences_column);
    return unpacker.unpack(bytes, differences, session::NumberFormat::float64, cells) ||
           unpacker.unpack(bytes, differences, session::NumberFormat::float32, cells);
}

}  // namespace

std::string texts_of_database(const std::string& file, std::string& fault, PrivacyReport& report) {
    session::UntrustedDatabase database;
    if (report.error = database.open(file); !report.error.empty()) return {};
    sqlite3* const raw = database.handle();
    const auto check = [&](int code) {
        if (code == SQLITE_OK || code == SQLITE_DONE || !fault.empty()) return;
        fault = session::outside_reason(raw, code);
        if (fault.empty()) fault = "it is damaged";
    };
    std::string all;
    const auto each_row = [&](const std::string& sql, const auto& take) {
        sqlite3_stmt* statement = nullptr;
        int code = sqlite3_prepare_v2(raw, sql.c_str(), -1, &statement, nullptr);
        while (code == SQLITE_OK || code == SQLITE_ROW)
            if (code = sqlite3_step(statement); code == SQLITE_ROW) take(statement);
        check(code);
        sqlite3_finalize(statement);
    };
    ByteSearch among_bytes(report, ", among bytes");
    session::ColumnUnpacker unpacker;
    std::vector<std::uint64_t> cells;
    std::vector<std::string> tables;
    const auto text_of = [](sqlite3_stmt* row, int column) {
        const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row, column));
        return bytes == nullptr ? std::string()
                                : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
    };
    bool is_session = false;
    each_row("PRAGMA application_id",
             [&](sqlite3_stmt* row) { is_session = sqlite3_column_int64(row, 0) == session::session_application_id; });
    if (fault.empty())
        each_row("SELECT name, sql FROM sqlite_master WHERE type = 'table' AND sql LIKE 'CREATE TABLE %'",
                 [&](sqlite3_stmt* row) {
                     tables.push_back(text_of(row, 0));
                     all += text_of(row, 1) + "\n";
                 });
    for (const std::string& table : tables) {
        std::string quoted;
        for (const char c : table) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
        each_row("SELECT * FROM \"" + quoted + "\"", [&](sqlite3_stmt* row) {
            if (is_session && table == "envelope" && sqlite3_column_count(row) == 2 &&
                is_written_by_kerf(text_of(row, 0), text_of(row, 1)))
                return;
            const bool is_numbers = is_session && table == "blocks" && is_packed_column(row, unpacker, cells);
            for (int column = 0; column < sqlite3_column_count(row); ++column)
                if (const int type = sqlite3_column_type(row, column); type == SQLITE_TEXT)
                    all += text_of(row, column) + "\n";
                else if (type == SQLITE_BLOB && !is_numbers)
                    among_bytes.take(text_of(row, column) + '\0');
        });
    }
    among_bytes.end();
    return all;
}

}  // namespace kerf::app::privacy
