// SPDX-License-Identifier: Apache-2.0
#include "text/inside_folder.h"

#include <algorithm>
#include <exception>
#include <filesystem>

namespace kerf::text {
namespace {

std::filesystem::path resolved(const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path.empty() ? "." : path));
}

}  // namespace

bool is_inside_folder(const std::string& path, const std::string& folder) {
    try {
        std::filesystem::path root = resolved(folder);
        if (!root.has_filename()) root = root.parent_path();  // a trailing separator is a component of its own
        const std::filesystem::path target = resolved(path);
        return std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first == root.end();
    } catch (const std::exception&) {  // a cycle of links, or a folder without permission to search
        return false;
    }
}

}  // namespace kerf::text
