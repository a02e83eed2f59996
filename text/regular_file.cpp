// SPDX-License-Identifier: Apache-2.0
#include "text/regular_file.h"

#include <filesystem>
#include <ios>
#include <system_error>

namespace kerf::text {

std::optional<FileFault> fault_of_file(const std::string& file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    switch (status.type()) {
        case std::filesystem::file_type::regular:
            return std::nullopt;
        case std::filesystem::file_type::not_found:
            return FileFault{"there is no such file.", "Check the name, and the folder it is in."};
        case std::filesystem::file_type::directory:
            return FileFault{"this is a folder.", "Name a file in it."};
        case std::filesystem::file_type::fifo:
            return FileFault{"this is a FIFO, not a regular file.", "Name a file that is stored on a disk."};
        case std::filesystem::file_type::socket:
            return FileFault{"this is a socket, not a regular file.", "Name a file that is stored on a disk."};
        case std::filesystem::file_type::character:
        case std::filesystem::file_type::block:
            return FileFault{"this is a device, not a regular file.", "Name a file that is stored on a disk."};
        default:
            if (error == std::errc::too_many_symbolic_link_levels)
                return FileFault{"this is a link that leads to itself.", "Name the file that it should lead to."};
            return FileFault{error ? "the file cannot be read." : "this is not a regular file.",
                             error ? "Check the permissions." : "Name a file that is stored on a disk."};
    }
}

std::string target_of_link(const std::string& file) {
    std::error_code error;
    if (!std::filesystem::is_symlink(file, error)) return file;
    const std::filesystem::path target = std::filesystem::canonical(file, error);
    return error ? file : target.string();
}

std::ifstream open_regular_file(const std::string& file) {
    std::ifstream stream;
    if (fault_of_file(file))
        stream.setstate(std::ios::failbit);
    else
        stream.open(file, std::ios::binary);
    return stream;
}

}  // namespace kerf::text
