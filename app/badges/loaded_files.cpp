// SPDX-License-Identifier: Apache-2.0
#include "app/badges/loaded_files.h"

#include <filesystem>
#include <map>
#include <system_error>

namespace kerf::app {

namespace {

/// Lives as long as the loaded plugins: for ever.
std::map<std::string, FileStamp>& noted() {
    static auto& stamps = *new std::map<std::string, FileStamp>;
    return stamps;
}

}  // namespace

void note_files_to_load(const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) {
        std::error_code error;
        for (std::filesystem::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
            if (file->path().extension() == ".so") noted()[file->path().string()] = stamp_of(file->path().string());
    }
}

FileStamp stamp_before_loading(const std::string& file) {
    const auto found = noted().find(file);
    return found != noted().end() ? found->second : FileStamp{};
}

}  // namespace kerf::app
