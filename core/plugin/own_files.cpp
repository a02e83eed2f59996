// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/own_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <system_error>

namespace kerf {

namespace {

struct Watched {
    const OwnFiles* owner;
    int descriptor;
    OpenFile file;
    std::string name;
};

/// A handler of a crash may release files while another thread compares them, so no one waits long here.
struct AllWatched {
    std::mutex mutex;
    std::vector<Watched> files;
};
AllWatched& all_watched() {
    static AllWatched& one = *new AllWatched;  // plugins end programs at any time: it is never destroyed
    return one;
}

}  // namespace

void OwnFiles::watch(const std::vector<std::string>& paths) {
    namespace fs = std::filesystem;
    const std::lock_guard lock(all_watched().mutex);
    std::error_code error;
    for (fs::directory_iterator entry("/proc/self/fd", error), end; !error && entry != end; entry.increment(error)) {
        const int descriptor = std::stoi(entry->path().filename().string());
        const OpenFile file = open_file(descriptor);
        for (const std::string& path : paths) {
            struct stat found {};
            if (stat(path.c_str(), &found) != 0 || file != OpenFile{found.st_dev, found.st_ino}) continue;
            all_watched().files.push_back({this, descriptor, file, fs::path(path).filename().string()});
        }
    }
}

void OwnFiles::release() noexcept {
    const std::lock_guard lock(all_watched().mutex);
    std::erase_if(all_watched().files, [&](const Watched& watched) { return watched.owner == this; });
}

StateChange change_of_own_files() noexcept {
    StateChange change;
    const std::lock_guard lock(all_watched().mutex);
    for (const Watched& watched : all_watched().files) {
        const OpenFile now = open_file(watched.descriptor);
        if (now == watched.file) continue;
        change.what << "the descriptor of " << watched.name.c_str();
        change.before << "open";
        change.after << (now == OpenFile{} ? "closed" : "another file");
        break;
    }
    return change;
}

}  // namespace kerf
