// SPDX-License-Identifier: Apache-2.0
#include "text/write_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "text/system_reason.h"

namespace kerf::text {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.find_last_not_of('/') == std::string::npos
                                  ? std::string::npos
                                  : path.rfind('/', path.find_last_not_of('/'));
    return slash == std::string::npos ? (path.starts_with('/') ? "/" : ".") : slash == 0 ? "/" : path.substr(0, slash);
}

/// Syncs an open file to disk. Returns 0, or errno.
int stored(int file) {
    int code = 0;
    do code = fsync(file);
    while (code != 0 && errno == EINTR);
    const bool knows_no_order = code != 0 && (errno == EINVAL || errno == ENOTSUP || errno == EROFS);
    return code == 0 || knows_no_order ? 0 : errno;
}

/// Opens an empty file that no other process writes, or that a killed process has left. Does not follow links. Returns
/// −1 and sets `error` on failure: EBUSY if another process writes the file.
int open_alone(const std::string& path, int& error) {
    for (int attempt = 0; attempt < 8; ++attempt) {
        const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
        error = errno;
        struct stat opened {
        }, named{};
        const bool is_plain = file >= 0 && fstat(file, &opened) == 0 && S_ISREG(opened.st_mode) && opened.st_nlink == 1;
        if (file < 0 && error != ELOOP && error != ENXIO) return -1;
        if (is_plain && flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(file);
            error = EBUSY;
            return -1;
        }
        const bool is_ours = is_plain && lstat(path.c_str(), &named) == 0 && named.st_ino == opened.st_ino;
        if (is_ours && ftruncate(file, 0) == 0) return file;
        error = errno;
        if (file >= 0) close(file);
        if (!is_plain && unlink(path.c_str()) != 0) return -1;  // a link or a pipe
    }
    error = EBUSY;
    return -1;
}

FileIdentity identity(const struct stat& file) noexcept {
    return {static_cast<std::uint64_t>(file.st_dev), static_cast<std::uint64_t>(file.st_ino)};
}

std::string reason(int error) {
    if (error == EBUSY) return "another process is writing it";
    return system_reason(error);
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

bool OutputLock::is_at(const std::string& folder) const {
    struct stat locked {};
    return fstat(folder_, &locked) == 0 && identity(locked) == identity_of(folder);
}

bool is_being_written(const std::string& folder) {
    const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return false;
    const bool is_taken = flock(opened, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(opened);
    return is_taken;
}

// ---- files -------------------------------------------------------------------------------------------------------

FileWriter::FileWriter(std::string path) : path_(std::move(path)), temporary_(path_ + ".part") {
    struct stat there {};
    if (stat(path_.c_str(), &there) == 0 && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode)) {
        error_ = path_ + " could not be written: it is a device or a pipe, which a file would replace. Name a file.";
        return;
    }
    int error = 0;
    file_ = open_alone(temporary_, error);
    if (file_ < 0) fail(error);
}

FileWriter::~FileWriter() {
    if (file_ < 0) return;
    close(file_);
    unlink(temporary_.c_str());
}

void FileWriter::fail(int error) {
    if (error_.empty()) error_ = path_ + " could not be written: " + reason(error) + ".";
    if (file_ < 0) return;
    close(std::exchange(file_, -1));
    unlink(temporary_.c_str());
}

void FileWriter::write(std::span<const unsigned char> bytes) {
    while (file_ >= 0 && !bytes.empty()) {
        const ssize_t count = ::write(file_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return fail(count < 0 ? errno : ENOSPC);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void FileWriter::write(std::string_view text) {
    write(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

std::string FileWriter::finish() {
    if (file_ < 0) return error_.empty() ? path_ + " is written already." : error_;
    if (const int error = stored(file_); error != 0) {
        fail(error);
        return error_;
    }
    error_ = rename_into_position(temporary_, path_);  // still locked, so that no other process writes under that name
    close(std::exchange(file_, -1));
    return error_;
}

std::string rename_into_position(const std::string& temporary, const std::string& path) {
    if (std::rename(temporary.c_str(), path.c_str()) != 0) {
        const int error = errno;
        unlink(temporary.c_str());
        return path + " could not be written: " + reason(error) + ".";
    }
    const int error = store_on_disk(folder_of(path));
    return error == 0 ? "" : path + " is written, but its folder could not be stored on disk: " + reason(error) + ".";
}

std::string write_file(const std::string& path, std::string_view contents) {
    FileWriter file(path);
    file.write(contents);
    return file.finish();
}

std::string write_file(const std::string& path, std::span<const unsigned char> contents) {
    FileWriter file(path);
    file.write(contents);
    return file.finish();
}

FileIdentity identity_of(const std::string& path) noexcept {
    struct stat found {};
    return stat(path.c_str(), &found) == 0 ? identity(found) : FileIdentity{};
}

int store_on_disk(const std::string& path) {
    const int opened = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (opened < 0) return errno == EACCES ? 0 : errno;  // a folder without permission to read may still permit writing
    const int error = stored(opened);
    close(opened);
    return error;
}

// ---- folders -----------------------------------------------------------------------------------------------------

MadeFolders::~MadeFolders() {
    for (; !made_.empty(); made_.pop_back()) rmdir(made_.back().c_str());
}

std::string MadeFolders::make(const std::string& folder) {
    const std::size_t before = made_.size();
    const auto failed = [&](const std::string& why) {
        for (; made_.size() > before; made_.pop_back()) rmdir(made_.back().c_str());
        return folder + " could not be made: " + why + ". Give another folder.";
    };
    for (std::size_t end = 0; end != std::string::npos;) {
        end = folder.find('/', end + 1);
        const std::string part = folder.substr(0, end);
        if (mkdir(part.c_str(), 0777) == 0) {
            made_.push_back(part);
            if (const int error = store_on_disk(folder_of(part)); error != 0) return failed(reason(error));
            continue;
        }
        const int error = errno;
        std::error_code ignored;
        if (!fs::is_directory(part, ignored))
            return failed(error == EEXIST ? "`" + part + "` is a file" : reason(error));
    }
    return {};
}

}  // namespace kerf::text
