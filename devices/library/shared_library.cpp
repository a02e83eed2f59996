// SPDX-License-Identifier: Apache-2.0
#include "devices/library/shared_library.h"

#include <dlfcn.h>
#include <sys/stat.h>

#include <cstdlib>
#include <stdexcept>

namespace kerf {

namespace {

bool is_folder(const std::string& path) {
    struct stat found {};
    return stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode);
}

/// Returns the files to try, in order.
std::vector<std::string> files_of(const LibraryPlaces& places) {
    std::vector<std::string> files;
    const auto add_folder = [&](const std::string& folder) {
        for (const std::string& name : places.names) files.push_back(folder + "/" + name);
    };
    if (!places.setting.empty()) {
        if (is_folder(places.setting))
            add_folder(places.setting);
        else
            files.push_back(places.setting);
        return files;
    }
    const char* const variable = *places.variable != '\0' ? std::getenv(places.variable) : nullptr;
    if (variable != nullptr && *variable != '\0') {
        add_folder(std::string(variable) + "/lib");
        add_folder(variable);
    }
    for (const std::string& name : places.names) files.push_back(name);
    return files;
}

std::string last_error() {
    const char* const text = dlerror();
    return text != nullptr ? text : "no reason is given";
}

}  // namespace

SharedLibrary::SharedLibrary(const LibraryPlaces& places, bool is_global) : maker_(places.maker) {
    std::string reasons;
    for (const std::string& file : files_of(places)) {
        handle_ = dlopen(file.c_str(), RTLD_NOW | RTLD_NODELETE | (is_global ? RTLD_GLOBAL : RTLD_LOCAL));
        if (handle_ != nullptr) {
            file_ = file;
            return;
        }
        reasons += (reasons.empty() ? "" : "; ") + last_error();
    }
    throw std::runtime_error(
        "the library of " + maker_ +
        " cannot be opened. Install the maker's SDK, or write `settings: {library: FOLDER}` in the "
        "station: " +
        reasons);
}

void* SharedLibrary::address_of(const char* symbol) const {
    void* const found = dlsym(handle_, symbol);
    if (found == nullptr)
        throw std::runtime_error("the library " + file_ + " of " + maker_ + " lacks the function `" + symbol +
                                 "`: it is of another version. Install a newer SDK of the maker.");
    return found;
}

bool is_installed(const LibraryPlaces& places) {
    try {
        static_cast<void>(SharedLibrary(places, false));
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace kerf
