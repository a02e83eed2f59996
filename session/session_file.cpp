// SPDX-License-Identifier: Apache-2.0
#include "session/session_file.h"

#include <sqlite3.h>

#include <cstddef>

#include "session/recorder.h"
#include "session/sqlite_reason.h"
#include "text/file_kind.h"
#include "text/regular_file.h"

namespace kerf::session {

namespace {

std::int64_t pragma(const SessionHandle& database, const char* sql) {
    SessionQuery query(database, sql);
    return query.next() ? query.integer(0) : -1;
}

/// Returns whether a table's rows are computed when they are read: a view, a virtual table or a computed column. Such
/// statements come from the author of the file and may never end.
bool computes(const SessionHandle& database, const std::string& table) {
    SessionQuery sorts(database, "PRAGMA main.table_list(" + table + ")");
    while (sorts.next())
        if (sorts.text(2) != "table") return true;
    SessionQuery columns(database, "PRAGMA main.table_xinfo(" + table + ")");
    while (columns.next())
        if (columns.integer(6) != 0) return true;
    return false;
}

constexpr const char* name_another = " Name a session.db that a run has written.";

}  // namespace

// ---- a query -----------------------------------------------------------------------------------------------------

SessionQuery::SessionQuery(const SessionHandle& session, const std::string& sql) : session_(session) {
    code_ = sqlite3_prepare_v2(session.database, sql.c_str(), -1, &statement_, nullptr);
    if (code_ != SQLITE_OK) note_failure();
}
SessionQuery::~SessionQuery() { sqlite3_finalize(statement_); }

bool SessionQuery::next() {
    if (code_ != SQLITE_OK) return false;
    code_ = sqlite3_step(statement_);
    if (code_ != SQLITE_ROW) {
        if (code_ != SQLITE_DONE) note_failure();
        return false;
    }
    code_ = SQLITE_OK;
    return true;
}

void SessionQuery::note_failure() {
    std::string* const first = session_.outside_reason;
    if (first != nullptr && first->empty()) *first = outside_reason(session_.database, code_);
}

bool SessionQuery::has_failed() const noexcept { return code_ != SQLITE_DONE && code_ != SQLITE_OK; }
int SessionQuery::columns() const { return sqlite3_column_count(statement_); }
int SessionQuery::type(int column) const { return sqlite3_column_type(statement_, column); }
bool SessionQuery::is_number(int column) const {
    const int type = sqlite3_column_type(statement_, column);
    return type == SQLITE_FLOAT || type == SQLITE_INTEGER;
}
bool SessionQuery::is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
double SessionQuery::number(int column) const { return sqlite3_column_double(statement_, column); }
std::int64_t SessionQuery::integer(int column) const { return sqlite3_column_int64(statement_, column); }
std::string SessionQuery::text(int column) const {
    const auto* bytes = sqlite3_column_text(statement_, column);
    return bytes != nullptr ? std::string(reinterpret_cast<const char*>(bytes),
                                          static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)))
                            : std::string();
}
std::vector<unsigned char> SessionQuery::bytes(int column) const {
    const auto* bytes = static_cast<const unsigned char*>(sqlite3_column_blob(statement_, column));
    return bytes != nullptr ? std::vector<unsigned char>(bytes, bytes + sqlite3_column_bytes(statement_, column))
                            : std::vector<unsigned char>();
}

std::string_view SessionQuery::bytes_view(int column) const {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    return bytes != nullptr
               ? std::string_view(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)))
               : std::string_view();
}

// ---- a file ------------------------------------------------------------------------------------------------------

std::string SessionFile::outside_reason() const {
    return outside_reason_.empty() ? std::string() : path_ + ": cannot be read: " + outside_reason_ + ".";
}

std::string SessionFile::open(const std::string& path, const std::vector<std::string>& tables, bool is_own) {
    path_ = path;
    if (const text::RecognisedFile found = text::recognise(path); found.kind == text::FileKind::missing)
        return path + ": cannot be opened: there is no such file." + name_another;
    else if (found.kind != text::FileKind::session && !found.name.empty())
        return path + ": is not a Kerf session: " + text::other_kind_text(found, "the session.db of a run");
    if (const auto fault = text::fault_of_file(path)) return path + ": " + fault->problem + name_another;
    if (std::string refusal = database_.open(path, is_own); !refusal.empty()) return refusal;
    std::string refusal = refusal_of_contents(tables);
    return outside_reason_.empty() ? refusal : outside_reason();
}

std::string SessionFile::refusal_of_contents(const std::vector<std::string>& tables) {
    if (pragma(handle(), "PRAGMA application_id") != session_application_id)
        return path_ + ": is not a Kerf session, or a damaged one." + name_another;
    if (const auto version = pragma(handle(), "PRAGMA user_version");
        version < oldest_readable_schema_version || version > session_schema_version)
        return path_ + ": has session schema " + std::to_string(version) + ", need " +
               std::to_string(oldest_readable_schema_version) + " to " + std::to_string(session_schema_version) +
               ". Record it anew with this Kerf, or take the one that wrote it.";
    for (const std::string& table : tables)
        if (computes(handle(), table))
            return path_ + ": computes its table `" + table + "`, as no run does." + name_another;
    SessionQuery query(handle(), "SELECT value FROM session WHERE key = 'state'");
    const std::string state = query.next() ? query.text(0) : std::string();
    if (state != "running" && state != "finished" && state != "incomplete")
        return path_ + ": its table `session` has no valid state, so the file is damaged." + name_another;
    return {};
}

}  // namespace kerf::session
