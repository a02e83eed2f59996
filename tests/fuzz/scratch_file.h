// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "tests/fuzz/fuzz_target.h"

namespace kerf::fuzz {

/// A folder in memory for readers that take a path. It holds what the last input was.
class ScratchFolder {
public:
    ScratchFolder() {
        const bool has_memory = std::filesystem::is_directory("/dev/shm");
        std::string name =
            (has_memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) + "/kerf-fuzz-XXXXXX";
        require(mkdtemp(name.data()) != nullptr, "a folder for files can be made");
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    /// A file that holds these bytes, in place of one of that name. Gives its path.
    std::string hold(const std::string& name, std::string_view bytes) const {
        std::string path = path_ + "/" + name;
        const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        const bool is_whole =
            file >= 0 && write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
        require(is_whole, "the file can be written");
        close(file);
        return path;
    }
    [[nodiscard]] std::string operator/(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

}  // namespace kerf::fuzz
