// SPDX-License-Identifier: Apache-2.0
#include "app/watched_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "bone/import/data_file.h"
#include "documents/yaml/document.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_files_of_folder = 20'000;  // a series has a file for each slice

bool ends_in(const std::string& path, const char* ending) {
    std::string lower = path;
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower.ends_with(ending);
}

std::int64_t nanoseconds(const timespec& time) noexcept {
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

class Collection {
public:
    /// Adds a document and the data that it names. A document that cannot be read has no data.
    void add_document(const std::string& file) {
        if (file.empty() || !documents_.insert(file).second) return;
        const fs::path folder = fs::path(file).parent_path();
        add_all(folder.empty() ? fs::path(".") : folder, ".yaml", 1);
        add(file);
        text::Diagnostics ignored;
        auto text = documents::read_text_file(file).take(ignored);
        if (!text) return;
        if (const auto document = documents::parse_document(file, *std::move(text)).take(ignored))
            add_named(document->root, "", file);
    }

    /// Adds what `--set PATH=VALUE` names.
    void add_setting(const std::string& setting, const std::string& document) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos) return;
        text::Diagnostics ignored;
        if (const auto value = documents::parse_document("--set", setting.substr(equals + 1)).take(ignored))
            add_named(value->root, setting.substr(0, equals), document);
    }

    void add(const fs::path& path) {
        struct stat found {};
        if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return;
        files[path.string()] = {.device = found.st_dev,
                                .inode = found.st_ino,
                                .size = static_cast<std::uint64_t>(found.st_size),
                                .written_ns = nanoseconds(found.st_mtim),
                                .changed_ns = nanoseconds(found.st_ctim)};
    }

    /// Adds the files of a folder with this ending, and those of its subfolders down to `levels`.
    void add_all(const fs::path& folder, const std::string& extension, int levels) {
        std::error_code error;
        std::size_t count = 0;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end && count < max_files_of_folder;
             entry.increment(error), ++count) {
            if (extension.empty() || entry->path().extension() == extension) add(entry->path());
            std::error_code unreadable;
            if (levels > 0 && entry->is_directory(unreadable)) add_all(entry->path(), extension, levels - 1);
        }
    }

    FileStates files;

private:
    /// Adds the files that a tree names. `key`: its own, or a path of a patch.
    void add_named(const documents::Node& node, const std::string& key, const std::string& document) {
        for (const documents::Node& child : node.children)
            add_named(child, child.key.empty() ? key : child.key, document);
        if (node.kind != documents::Node::Kind::scalar || node.text.empty()) return;
        const std::string last = key.substr(key.rfind('.') + 1);
        if (last == "anatomy") add_document((fs::path(document).parent_path() / node.text).string());
        constexpr std::array<std::string_view, 3> names_data{"file", "image", "labels"};
        if (std::find(names_data.begin(), names_data.end(), last) != names_data.end()) add_data(node.text, document);
    }

    void add_data(const std::string& written, const std::string& document) {
        const fs::path path = bone::found_data_file(written, document);
        std::error_code error;
        if (fs::is_directory(path, error)) {
            add_all(path, "", 1);
            return;
        }
        if (!fs::exists(path, error)) return;
        add(path);
        // Headers whose voxels are in a file of their own, of any name.
        const fs::path folder = path.parent_path();
        if (ends_in(written, ".nhdr") || ends_in(written, ".mhd") || ends_in(written, ".hdr"))
            add_all(folder.empty() ? fs::path(".") : folder, "", 0);
    }

    std::set<std::string> documents_;  ///< each is read once
};

}  // namespace

FileStates watched_files(const RunOptions& options, const std::vector<std::string>& plugins) {
    Collection collection;
    for (const std::string& folder : plugins) collection.add_all(folder, ".so", 0);
    collection.add_document(options.procedure);
    collection.add_document(options.anatomy);
    for (const std::string& patch : options.patches) collection.add_document(patch);
    for (const std::string& setting : options.settings) collection.add_setting(setting, options.procedure);
    for (const std::string& session : {options.replay, options.parent})
        if (!session.empty()) collection.add(session);
    return std::move(collection.files);
}

std::string first_change(const FileStates& before, const FileStates& now) {
    for (const auto& [path, state] : now)
        if (const auto found = before.find(path); found == before.end() || found->second != state) return path;
    for (const auto& [path, state] : before)
        if (!now.contains(path)) return path;
    return {};
}

}  // namespace kerf::app
