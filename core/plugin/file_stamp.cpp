// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/file_stamp.h"

#include <sys/stat.h>

namespace kerf {

namespace {

std::int64_t nanoseconds(const timespec& time) noexcept {
    return std::int64_t{time.tv_sec} * 1'000'000'000 + std::int64_t{time.tv_nsec};
}

FileStamp stamp(const struct stat& file) noexcept {
    return {static_cast<std::uint64_t>(file.st_dev), static_cast<std::uint64_t>(file.st_ino),
            static_cast<std::uint64_t>(file.st_size), nanoseconds(file.st_mtim), nanoseconds(file.st_ctim)};
}

}  // namespace

FileStamp stamp_of(const std::string& path) noexcept {
    struct stat file {};
    return stat(path.c_str(), &file) == 0 ? stamp(file) : FileStamp{};
}

FileStamp stamp_of(int open_file) noexcept {
    struct stat file {};
    return fstat(open_file, &file) == 0 ? stamp(file) : FileStamp{};
}

}  // namespace kerf
