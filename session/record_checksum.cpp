// SPDX-License-Identifier: Apache-2.0
#include "session/record_checksum.h"

#include <sqlite3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "session/content_hash.h"
#include "session/recorder.h"
#include "session/session_file.h"
#include "session/session_tables.h"

namespace kerf::session {

namespace {

/// Adds the length first, so that two texts differ from their concatenation.
void add_text(ContentHash& hash, std::string_view text) {
    hash.add(static_cast<std::uint64_t>(text.size()));
    hash.add(text);
}

void add_value(ContentHash& hash, const SessionQuery& row, int column) {
    const int type = row.type(column);
    hash.add(static_cast<std::uint8_t>(type));
    if (type == SQLITE_INTEGER) hash.add(row.integer(column));
    if (type == SQLITE_FLOAT) hash.add(row.number(column));
    if (type == SQLITE_TEXT || type == SQLITE_BLOB) add_text(hash, row.bytes_view(column));
}

/// Adds the statements of tables, indices and triggers. Returns the names of the tables that a run makes.
std::vector<std::string> add_statements(ContentHash& hash, SessionQuery& statements) {
    std::vector<std::string> ours, found;
    for (const Table& table : session_tables({})) ours.push_back(table.name);
    while (statements.next()) {
        for (int column = 0; column < 3; ++column) add_value(hash, statements, column);
        const std::string name = statements.text(1);
        if (std::find(ours.begin(), ours.end(), name) != ours.end()) found.push_back(name);
    }
    return found;
}

std::string value_of(const SessionHandle& database, const std::string& key) {
    SessionQuery query(database, "SELECT value FROM session WHERE key = '" + key + "'");
    return query.next() ? query.text(0) : std::string();
}

bool has_result(const SessionHandle& database) {
    SessionQuery query(database,
                       "SELECT 1 FROM session WHERE key IN ('result.verdict', 'result.score', 'hash', 'summary')");
    return query.next();
}

bool has_blocks(const SessionHandle& database) {
    SessionQuery query(database, "SELECT 1 FROM blocks LIMIT 1");
    return query.next();
}

}  // namespace

std::optional<std::uint64_t> record_checksum(const SessionHandle& database) {
    ContentHash hash;
    SessionQuery statements(database, "SELECT type, name, sql FROM sqlite_master ORDER BY type, name");
    const std::vector<std::string> tables = add_statements(hash, statements);
    if (statements.has_failed()) return std::nullopt;
    for (const std::string& table : tables) {
        const std::string rest =
            table == "session" ? std::string(" WHERE key IS NOT '") + record_checksum_key + "'" : std::string();
        SessionQuery rows(database, "SELECT rowid, * FROM \"" + table + "\"" + rest + " ORDER BY rowid");
        std::optional<std::int64_t> last;
        while (rows.next()) {
            const std::int64_t id = rows.integer(0);
            if (last && id <= *last) return std::nullopt;  // its pages form a cycle
            last = id;
            for (int column = 1; column < rows.columns(); ++column) add_value(hash, rows, column);
        }
        if (rows.has_failed()) return std::nullopt;
    }
    return hash.value();
}

RecordCheck check_record(const SessionHandle& database) {
    const std::string expected = value_of(database, record_checksum_key);
    if (expected.empty()) {
        SessionQuery version(database, "PRAGMA user_version");
        // Blocks came later than checksums: with any, the number of the schema was changed.
        const bool must_have_one =
            (version.next() && version.integer(0) >= first_schema_with_checksum) || has_blocks(database);
        // A run writes its verdict and its checksum in one transaction.
        const bool has_end = value_of(database, "state") == "finished" || has_result(database);
        return must_have_one && has_end ? RecordCheck::changed : RecordCheck::unknown;
    }
    const auto found = record_checksum(database);
    return found && hex16(*found) == expected ? RecordCheck::same : RecordCheck::changed;
}

}  // namespace kerf::session
