// SPDX-License-Identifier: Apache-2.0
#include "core/session/read_session.h"

#include <sqlite3.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "core/session/recorder.h"

namespace kerf {

namespace {

/// One SELECT, row by row.
class Query {
public:
    Query(sqlite3* database, const char* sql) { code_ = sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr); }
    ~Query() { sqlite3_finalize(statement_); }
    Query(const Query&) = delete;
    Query& operator=(const Query&) = delete;

    bool next() {
        if (code_ != SQLITE_OK) return false;
        code_ = sqlite3_step(statement_);
        if (code_ != SQLITE_ROW) return false;
        code_ = SQLITE_OK;
        return true;
    }
    [[nodiscard]] bool has_failed() const { return code_ != SQLITE_DONE && code_ != SQLITE_OK; }
    [[nodiscard]] double number(int column) const { return sqlite3_column_double(statement_, column); }
    [[nodiscard]] bool is_number(int column) const {
        const int type = sqlite3_column_type(statement_, column);
        return type == SQLITE_FLOAT || type == SQLITE_INTEGER;
    }
    [[nodiscard]] std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
    [[nodiscard]] std::string text(int column) const {
        const auto* bytes = sqlite3_column_text(statement_, column);
        return bytes != nullptr ? std::string(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)))
                                : std::string();
    }

private:
    sqlite3_stmt* statement_ = nullptr;
    int code_ = SQLITE_OK;
};

/// A unit quaternion, in a room. NaN is neither.
bool is_plausible(const Pose& pose) {
    constexpr double room = 100.0;  // [m]
    const auto& [w, x, y, z] = pose.rotation;
    return length(pose.position) < room && std::abs(w * w + x * x + y * y + z * z - 1.0) < 1e-6;
}

std::int64_t pragma(sqlite3* database, const char* sql) {
    Query query(database, sql);
    return query.next() ? query.integer(0) : -1;
}

/// Whether a table's rows are computed when they are read: a view, a virtual table, a computed column. They would be
/// statements of whoever made the file, and may never end.
bool computes(sqlite3* database, const std::string& table) {
    Query sorts(database, ("PRAGMA main.table_list(" + table + ")").c_str());
    while (sorts.next())
        if (sorts.text(2) != "table") return true;
    Query columns(database, ("PRAGMA main.table_xinfo(" + table + ")").c_str());
    while (columns.next())
        if (columns.integer(6) != 0) return true;
    return false;
}

/// [bytes] of a file and of what a run that was cut short left beside it.
std::uint64_t bytes_of(const std::string& path) {
    std::uint64_t sum = 0;
    for (const char* ending : {"", "-wal"}) {
        std::error_code error;
        if (const auto size = std::filesystem::file_size(path + ending, error); !error) sum += size;
    }
    return sum;
}

/// Ends whatever takes longer than all rows that a file has bytes for: one whose pages lead to the same page again and again
/// has rows without end.
class Patience {
public:
    Patience(sqlite3* database, std::uint64_t bytes) : steps_left_(steps + steps_per_byte * static_cast<std::int64_t>(bytes)) {
        sqlite3_progress_handler(database, at_once, &Patience::is_over, this);
    }
    Patience(const Patience&) = delete;
    Patience& operator=(const Patience&) = delete;

private:
    // Of SQLite's machine. A tick takes less than 100, and has at least 20 bytes.
    static constexpr int at_once = 1000;
    static constexpr std::int64_t steps = 1'000'000, steps_per_byte = 16;

    static int is_over(void* self) {
        auto& left = static_cast<Patience*>(self)->steps_left_;
        left -= at_once;
        return left < 0 ? 1 : 0;
    }

    std::int64_t steps_left_;
};

}  // namespace

std::optional<RecordedInputs> read_session(const std::string& path, std::string& error) {
    sqlite3* raw = nullptr;
    const int opened = sqlite3_open_v2(path.c_str(), &raw, SQLITE_OPEN_READONLY, nullptr);
    const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(raw, &sqlite3_close);
    if (opened != SQLITE_OK) {
        error = path + ": cannot be opened. Name a session.db that a run has written.";
        return std::nullopt;
    }
    Patience patience(raw, bytes_of(path));
    if (pragma(raw, "PRAGMA application_id") != session_application_id) {
        error = path + ": is not a Kerf session, or a damaged one. Name a session.db that a run has written.";
        return std::nullopt;
    }
    if (const auto version = pragma(raw, "PRAGMA user_version"); version != session_schema_version) {
        error = path + ": has session schema " + std::to_string(version) + ", need " + std::to_string(session_schema_version) + ".";
        return std::nullopt;
    }

    for (const char* table : {"session", "ticks"})
        if (computes(raw, table)) {
            error = path + ": computes its table `" + table + "`, as no run does. Name a session.db that a run has written.";
            return std::nullopt;
        }

    RecordedInputs inputs;
    Query keys(raw, "SELECT key, value FROM session");
    while (keys.next()) {
        const std::string key = keys.text(0);
        if (key == "procedure_text") inputs.procedure_text = keys.text(1);
        if (key == "condition.variant") inputs.variant = keys.text(1);
        if (key == "anatomy_hash") inputs.anatomy_hash = std::strtoull(keys.text(1).c_str(), nullptr, 16);
        if (key == "hash") inputs.hash = keys.text(1);
    }
    Query ticks(raw,
                "SELECT tick, device_from_handle_x, device_from_handle_y, device_from_handle_z, device_from_handle_qw, "
                "device_from_handle_qx, device_from_handle_qy, device_from_handle_qz FROM ticks ORDER BY tick");
    while (ticks.next()) {
        if (ticks.integer(0) != static_cast<std::int64_t>(inputs.device_from_handle.size())) {
            error = path + ": tick " + std::to_string(inputs.device_from_handle.size()) + " is missing, so it cannot be replayed.";
            return std::nullopt;
        }
        const Pose pose{{ticks.number(1), ticks.number(2), ticks.number(3)},
                        {ticks.number(4), ticks.number(5), ticks.number(6), ticks.number(7)}};
        bool is_all_numbers = true;
        for (int column = 1; column <= 7; ++column) is_all_numbers = is_all_numbers && ticks.is_number(column);
        if (!is_all_numbers || !is_plausible(pose)) {
            error = path + ": tick " + std::to_string(ticks.integer(0)) + " holds no pose, so the file is damaged and cannot be replayed.";
            return std::nullopt;
        }
        inputs.device_from_handle.push_back(pose);
    }
    if (keys.has_failed() || ticks.has_failed() || inputs.device_from_handle.empty()) {
        error = path + ": holds no ticks that can be read.";
        return std::nullopt;
    }
    return inputs;
}

}  // namespace kerf
