// SPDX-License-Identifier: Apache-2.0
#include "session/untrusted_database.h"

#include <sqlite3.h>

#include <filesystem>
#include <system_error>

#include "session/sqlite_reason.h"
#include "text/regular_file.h"
#include "text/write_file.h"

namespace kerf::session {
namespace {

// Steps of SQLite's virtual machine. A tick takes fewer than 100 and has at least 20 bytes.
constexpr int steps_at_once = 1000;
constexpr std::int64_t min_steps = 1'000'000, steps_per_byte = 16;

std::uint64_t size_of(const std::string& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

/// Returns a path for SQLite's `file:` names, with `?`, `#` and `%` escaped.
std::string in_uri(const std::string& path) {
    std::string safe;
    for (const char c : path) safe += c == '?' ? "%3f" : c == '#' ? "%23" : c == '%' ? "%25" : std::string(1, c);
    return safe;
}

/// Returns why one of SQLite's files next to a database may not be opened, for people; empty if all are regular or
/// missing, and the -wal file can be read.
std::string refusal_of_side_files(const std::string& database) {
    for (const char* suffix : {"-wal", "-journal", "-shm"}) {
        const std::string file = database + suffix;
        std::error_code error;
        const std::filesystem::file_type type = std::filesystem::symlink_status(file, error).type();
        if (type == std::filesystem::file_type::not_found) continue;
        if (type == std::filesystem::file_type::regular) {
            if (std::string(suffix) != "-wal" || text::open_regular_file(file)) continue;
            return file + ": cannot be read, and the last rows are in it. Check its permissions.";
        }
        const auto fault = text::fault_of_file(file);
        return file + ": " +
               (fault && type != std::filesystem::file_type::symlink ? fault->problem : "this is a link.") +
               " Move it away: next to a database, SQLite writes regular files.";
    }
    return {};
}

}  // namespace

UntrustedDatabase::~UntrustedDatabase() { sqlite3_close(database_); }

int UntrustedDatabase::is_over(void* self) {
    auto& left = static_cast<UntrustedDatabase*>(self)->steps_left_;
    left -= steps_at_once;
    return left < 0 ? 1 : 0;
}

/// A finished session is one file. It is opened as immutable: without locks, so without files next to it. The -wal file
/// of a killed run is part of its session. With it, SQLite keeps in memory the data that it would otherwise write to
/// the folder.
std::string UntrustedDatabase::open(const std::string& path, bool is_own) {
    const std::string file = text::target_of_link(path);
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (!is_own && text::is_being_written(folder.empty() ? "." : folder.string()))
        return path + ": a run is writing it. Wait until that has ended.";
    if (std::string refusal = refusal_of_side_files(file); !refusal.empty())
        return file == path ? refusal : path + ": is a link to " + file + ". " + refusal;
    const std::uint64_t of_wal = size_of(file + "-wal");
    bytes_ = size_of(file) + of_wal;
    const int code = of_wal == 0 ? sqlite3_open_v2(("file:" + in_uri(file) + "?immutable=1").c_str(), &database_,
                                                   SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr)
                                 : sqlite3_open_v2(file.c_str(), &database_, SQLITE_OPEN_READONLY, "unix-none");
    if (code != SQLITE_OK) {
        const std::string reason = outside_reason(database_, code);
        return path + (reason.empty() ? ": cannot be opened. Name a session.db that a run has written."
                                      : ": cannot be read: " + reason + ".");
    }
    sqlite3_db_config(database_, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    sqlite3_exec(database_, "PRAGMA temp_store=MEMORY", nullptr, nullptr, nullptr);  // reading needs no other disk
    if (of_wal > 0) sqlite3_exec(database_, "PRAGMA locking_mode=EXCLUSIVE", nullptr, nullptr, nullptr);
    steps_left_ = min_steps + steps_per_byte * static_cast<std::int64_t>(bytes_);
    sqlite3_progress_handler(database_, steps_at_once, &UntrustedDatabase::is_over, this);
    return {};
}

}  // namespace kerf::session
