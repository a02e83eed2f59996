// SPDX-License-Identifier: Apache-2.0
#include "core/session/write_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "core/field/present_bone.h"
#include "core/session/recorder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

/// SQLite keeps the application id in bytes 68 … 71 of the file, most significant first.
bool is_session(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<char, 72> head{};
    if (!in.read(head.data(), head.size())) return false;
    if (std::memcmp(head.data(), "SQLite format 3", 16) != 0) return false;
    std::uint32_t id = 0;
    for (std::size_t i = 68; i < 72; ++i) id = (id << 8) | static_cast<unsigned char>(head[i]);
    return id == static_cast<std::uint32_t>(session_application_id);
}

std::string reason(int error) {
    return error == ENOSPC || error == EDQUOT ? "the disk is full. Free some space, or give a folder on another disk"
                                              : std::strerror(error);
}

}  // namespace

OutputLock::~OutputLock() {
    if (folder_ >= 0) close(folder_);
}

std::string OutputLock::take(const std::string& folder) {
    const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return folder + " could not be opened: " + std::strerror(errno) + ".";
    const bool is_taken = flock(opened, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (is_taken) {
        close(opened);
        return folder + " is being written by another run. Wait until that has ended, or give another folder.";
    }
    if (folder_ >= 0) close(folder_);
    folder_ = opened;
    return {};
}

bool is_being_written(const std::string& folder) {
    const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return false;
    const bool is_taken = flock(opened, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(opened);
    return is_taken;
}

std::string write_file(const std::string& path, std::string_view contents) {
    const fs::path target(path);
    fs::path temporary = target;
    temporary += ".part";
    const auto failed = [&](const std::string& why) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        return path + " could not be written: " + why + ".";
    };

    errno = 0;
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (file == nullptr) return failed(reason(errno));
    const bool is_whole = std::fwrite(contents.data(), 1, contents.size(), file) == contents.size();
    const int write_error = errno;
    if (std::fclose(file) != 0 || !is_whole) return failed(reason(is_whole ? errno : write_error));

    std::error_code error;
    fs::rename(temporary, target, error);
    return error ? failed(error.message()) : std::string();
}

std::string write_file(const std::string& path, std::span<const unsigned char> contents) {
    return write_file(path, std::string_view(reinterpret_cast<const char*>(contents.data()), contents.size()));
}

std::string prepare_output(const std::string& folder, OutputLock& lock) {
    std::error_code error;
    const fs::path path(folder);
    const fs::file_status status = fs::status(path, error);

    if (!fs::exists(status)) {
        error.clear();
        fs::create_directories(path, error);
        return error ? folder + " could not be made: " + error.message() + "." : lock.take(folder);
    }
    if (!fs::is_directory(status)) return folder + " is a file; results need a folder. Give another one.";

    // Before anything is looked at: another run would change it.
    if (std::string taken = lock.take(folder); !taken.empty()) return taken;
    const bool is_empty = fs::is_empty(path, error);
    if (error) return folder + " could not be read: " + error.message();
    if (is_empty) return {};
    if (!is_session(path / "session.db"))
        return folder + " holds other files and no Kerf session, so it was left alone. Give a new or empty folder.";

    // Only what a run writes is ours to take away; anything else stops it before the first file is gone.
    std::vector<std::string> ours{"session.db", "session.db-wal", "session.db-shm", "session.db-journal"};
    std::vector<std::string> whole{"summary.json", "report.html", "bone.stl"};
    for (std::size_t body = 1; body < most_bodies; ++body) whole.push_back("bone-" + std::to_string(body) + ".stl");
    for (const std::string& name : whole) ours.insert(ours.end(), {name, name + ".part"});
    for (auto entry = fs::directory_iterator(path, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (std::find(std::begin(ours), std::end(ours), name) == std::end(ours))
            return folder + " holds `" + name +
                   "`, which no run has written, so it was left alone. Give a new or empty folder.";
    }
    for (const std::string& name : ours)
        if (!error) fs::remove(path / name, error);
    return error ? folder + " could not be emptied: " + error.message() : std::string();
}

}  // namespace kerf
