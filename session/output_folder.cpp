// SPDX-License-Identifier: Apache-2.0
#include "session/output_folder.h"

#include <linux/magic.h>
#include <sys/vfs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "core/field/pieces/present_bone.h"
#include "session/recorder.h"

namespace kerf::session {
namespace {

namespace fs = std::filesystem;

/// Returns whether a file is a session. SQLite stores the application id in bytes 68 … 71, most significant first.
bool is_session(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<char, 72> head{};
    if (!in.read(head.data(), head.size())) return false;
    if (std::memcmp(head.data(), "SQLite format 3", 16) != 0) return false;
    std::uint32_t id = 0;
    for (std::size_t i = 68; i < 72; ++i) id = (id << 8) | static_cast<unsigned char>(head[i]);
    return id == static_cast<std::uint32_t>(session_application_id);
}

/// Returns all files that a run writes, the session last: it identifies the others as a run's until they are removed.
std::vector<std::string> files_of_a_run() {
    std::vector<std::string> whole{"summary.json", "report.html", "bone.stl",   "bone-exact.stl",
                                   "remesh.json",  "clock.svg",   "plugins.log"},
        all;
    for (std::size_t body = 1; body < max_bodies; ++body)
        for (const char* of : {"bone-", "implant-", "bone-exact-"}) whole.push_back(of + std::to_string(body) + ".stl");
    for (const std::string& name : whole) all.insert(all.end(), {name, name + ".part"});
    for (const char* suffix : {".part-journal", ".part", "-journal", "-shm", "-wal", ""})
        all.push_back(std::string("session.db") + suffix);
    return all;
}

/// Returns whether the folder is left over from a run that died before its session was complete: only auxiliary files
/// and at most an empty session.
bool is_trace_of_a_run(const fs::path& folder) {
    std::error_code error;
    for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (entry->symlink_status(error).type() != fs::file_type::regular || error) return false;
        const bool is_auxiliary = name == "session.db.part" || name == "session.db.part-journal" ||
                                  name == "session.db-journal" || name == "session.db-wal" || name == "session.db-shm";
        const bool is_empty_session = name == "session.db" && entry->file_size(error) == 0;
        if (!is_auxiliary && !is_empty_session) return false;
    }
    return !error;
}

/// Returns why a path is too long, or an empty text. SQLite accepts at most 512 bytes, including its own suffixes.
std::string refusal_of_length(const std::string& folder) {
    constexpr std::size_t longest = 480;
    std::error_code error;
    const std::size_t length = fs::absolute(folder, error).string().size();
    if (error) return "the working folder no longer exists (" + error.message() + "). Change into another one.";
    return length <= longest ? ""
                             : folder.substr(0, 60) + "… could not be made: its path has " + std::to_string(length) +
                                   " bytes, expected at most " + std::to_string(longest) + ". Give a shorter one.";
}

/// Returns why the files of a folder keep a run from writing there, for people; empty if they do not.
std::string refusal_of_contents(const std::string& folder) {
    std::error_code error;
    const fs::path path(folder);
    const bool is_empty = fs::is_empty(path, error);
    if (error) return folder + " could not be read: " + error.message();
    if (is_empty) return {};
    if (!is_session(path / "session.db") && !is_trace_of_a_run(path))
        return folder + " holds other files and no Kerf session, so it was left alone. Give a new or empty folder.";
    const std::vector<std::string> ours = files_of_a_run();
    for (auto entry = fs::directory_iterator(path, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (std::find(std::begin(ours), std::end(ours), name) == std::end(ours))
            return folder + " holds `" + name +
                   "`, which no run has written, so it was left alone. Give a new or empty folder.";
    }
    return error ? folder + " could not be read: " + error.message() : std::string();
}

/// Returns whether a path leads into /proc or /sys.
bool is_of_the_system(const std::string& folder) {
    std::error_code ignored;
    fs::path there = fs::absolute(folder, ignored);
    while (!fs::exists(there, ignored) && there.has_relative_path()) there = there.parent_path();
    struct statfs of {};
    return statfs(there.c_str(), &of) == 0 && (of.f_type == PROC_SUPER_MAGIC || of.f_type == SYSFS_MAGIC);
}

/// Returns why a path leads to no folder that can be made or written, for people; empty if it does.
std::string refusal_of_path(const std::string& folder, const fs::file_status& status) {
    if (std::string why = refusal_of_length(folder); !why.empty()) return why;
    if (is_of_the_system(folder))
        return folder +
               " belongs to the system, which makes up the files there and keeps none. Give a folder on a disk.";
    return fs::exists(status) && !fs::is_directory(status)
               ? folder + " is a file; results need a folder. Give another one."
               : std::string();
}

}  // namespace

std::string refusal_of_output(const std::string& folder) {
    std::error_code ignored;
    const fs::file_status status = fs::status(folder, ignored);
    if (std::string why = refusal_of_path(folder, status); !why.empty()) return why;
    return fs::exists(status) ? refusal_of_contents(folder) : std::string();
}

std::string prepare_output(const std::string& folder, text::OutputLock& lock, text::MadeFolders& made) {
    std::error_code error;
    const fs::path path(folder);
    const fs::file_status status = fs::status(path, error);

    if (std::string why = refusal_of_path(folder, status); !why.empty()) return why;
    if (!fs::exists(status)) {
        const std::string why = made.make(folder);
        return why.empty() ? lock.take(folder) : why;
    }

    // Locked before the files are checked: another run could change the folder.
    if (std::string taken = lock.take(folder); !taken.empty()) return taken;
    if (std::string why = refusal_of_contents(folder); !why.empty()) return why;
    // Only files of a run are removed. Any other file stops the removal before the first file is removed.
    for (const std::string& name : files_of_a_run())
        if (!error) fs::remove(path / name, error);
    return error ? folder + " could not be emptied: " + error.message() : std::string();
}

}  // namespace kerf::session
