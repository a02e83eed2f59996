// SPDX-License-Identifier: Apache-2.0
#include "app/outputs.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "text/write_file.h"

namespace kerf::app {

std::string refusal_of_folder(const std::string& folder) {
    namespace fs = std::filesystem;
    std::error_code error, ignored;
    fs::path there = fs::absolute(folder.empty() ? "." : folder, error);
    if (error)
        return "`--out` is `" + folder + "`, and the working folder no longer exists (" + error.message() +
               "). Change into another folder, or give one with its whole path.";
    while (!fs::exists(there, ignored) && there.has_relative_path()) there = there.parent_path();
    const std::string cannot = "`--out` is `" + folder + "`, which cannot be written: `" + there.string() + "` ";
    if (!fs::is_directory(there, ignored)) return cannot + "is a file. Give another folder.";
    if (access(there.c_str(), W_OK | X_OK) != 0) return cannot + "may not be written. Give another folder.";
    return "";
}

std::string refusal_of_page(const std::string& file) {
    if (std::filesystem::path(file).extension() != ".html")
        return "`--out` is `" + file + "`, and must be an .html file. Write `--out page.html`.";
    return refusal_of_folder(std::filesystem::path(file).parent_path().string());
}

std::string write_page(const std::string& file, const std::string& page) {
    text::MadeFolders made;
    const std::string folder = std::filesystem::path(file).parent_path().string();
    std::string error = folder.empty() ? std::string() : made.make(folder);
    if (error.empty()) error = text::write_file(file, page);
    if (error.empty()) made.keep();
    return error;
}

}  // namespace kerf::app
