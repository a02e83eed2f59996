// SPDX-License-Identifier: Apache-2.0
#include "app/badges/badge_store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "text/system_reason.h"
#include "text/write_file.h"

namespace kerf::app {

namespace {

constexpr std::size_t max_size = 4096;  ///< [bytes] of a badge's file

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

/// The bytes of a badge's file, or why they are not trusted.
struct Contents {
    bool is_there = false;
    std::string text{};
    std::string fault{};  ///< a clause; empty: the text is the file's
};

std::string fault_of(const struct stat& file) {
    if (S_ISLNK(file.st_mode)) return "it is a link";
    if (!S_ISREG(file.st_mode)) return "it is not a regular file";
    if (file.st_uid != geteuid()) return "it belongs to another user";
    if (static_cast<std::size_t>(file.st_size) > max_size) return "it is larger than a badge";
    return {};
}

Contents read(const std::string& path) {
    struct stat named {};
    if (lstat(path.c_str(), &named) != 0) {
        const bool is_missing = errno == ENOENT || errno == ENOTDIR;
        return {!is_missing, "", is_missing ? "" : "it cannot be read: " + text::system_reason(errno)};
    }
    if (std::string fault = fault_of(named); !fault.empty()) return {true, "", std::move(fault)};
    const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return {true, "", "it cannot be read: " + text::system_reason(errno)};
    Contents contents{true};
    struct stat opened {};
    if (fstat(file, &opened) != 0)
        contents.fault = "it cannot be read";
    else
        contents.fault = fault_of(opened);  // another file may have the name by now
    std::array<char, max_size + 1> bytes{};
    while (contents.fault.empty() && contents.text.size() <= max_size) {
        const ssize_t count = ::read(file, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) contents.fault = "it cannot be read: " + text::system_reason(errno);
        if (count <= 0) break;
        contents.text.append(bytes.data(), static_cast<std::size_t>(count));
    }
    close(file);
    return contents;
}

}  // namespace

std::string no_folder_for_badges() {
    return "there is no folder for the badges of plugins. Set HOME, or KERF_BADGES to a folder; `KERF_BADGES=off` "
           "switches badges off.";
}

BadgeStore BadgeStore::of_environment() {
    const auto absolute = [](const std::string& folder) {
        std::error_code error;
        const auto path = std::filesystem::absolute(folder, error);
        return error ? folder : path.string();
    };
    std::string folder = variable("KERF_BADGES");
    if (folder == "off") {
        BadgeStore store("");
        store.is_off_ = true;
        return store;
    }
    if (!folder.empty()) return BadgeStore(absolute(folder));
    if (folder = variable("XDG_STATE_HOME"); folder.starts_with('/')) return BadgeStore(folder + "/kerf/badges");
    const std::string home = variable("HOME");
    return BadgeStore(home.starts_with('/') ? home + "/.local/state/kerf/badges" : "");
}

BadgeStore::Found BadgeStore::find(const std::string& digest) const {
    if (folder_.empty() || digest.empty()) return {};
    const std::string file = file_of(digest);
    Contents contents = read(file);
    if (!contents.is_there) return {};
    Found found;
    if (contents.fault.empty()) found.badge = read_badge(contents.text, digest, contents.fault);
    if (!found.badge)
        found.fault = "the badge " + file + " is ignored: " + contents.fault + ". Remove it, then run `kerf check`.";
    return found;
}

BadgeStore::Kept BadgeStore::keep(const Badge& badge) const {
    const auto failed = [](const std::string& why) { return Kept{std::nullopt, "the badge is not kept: " + why}; };
    if (folder_.empty()) return failed(no_folder_for_badges());
    text::MadeFolders made;
    if (const std::string error = made.make(folder_); !error.empty()) return failed(error);
    made.keep();
    const std::string file = file_of(badge.digest);
    Kept kept;
    Contents earlier = read(file);
    if (!earlier.fault.empty()) return failed(file + " is in the way: " + earlier.fault + ". Remove it.");
    if (earlier.is_there) {
        std::string fault;
        const auto read = read_badge(earlier.text, badge.digest, fault);
        if (read && kept_of(*read, badge) == *read) return {read, ""};
        if (!read) kept.fault = "the badge " + file + " was replaced: " + fault + ".";
    }
    // A name of this process alone: two programs that check one plugin do not wait for one another.
    const std::string temporary = folder_ + "/." + badge.digest + "-" + std::to_string(getpid());
    if (const std::string error = text::write_file(temporary, text_of(badge)); !error.empty()) return failed(error);
    if (const std::string error = text::rename_into_position(temporary, file); !error.empty()) return failed(error);
    kept.badge = badge;
    return kept;
}

}  // namespace kerf::app
