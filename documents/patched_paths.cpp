// SPDX-License-Identifier: Apache-2.0
#include "documents/patched_paths.h"

#include <algorithm>
#include <utility>

namespace kerf::documents {

const PatchedPaths::Change* PatchedPaths::record(const NodePath& path, Change change) {
    for (NodePath outer = path; !outer.empty(); outer.pop_back())
        if (const auto found = changes_.find(outer); found != changes_.end()) return &found->second;
    const auto next = changes_.lower_bound(path);  // parts of a value follow it
    if (next != changes_.end() && path.size() < next->first.size() &&
        std::equal(path.begin(), path.end(), next->first.begin()))
        return &next->second;
    change.path = path;
    changes_.emplace_hint(next, path, std::move(change));
    return nullptr;
}

std::string path_text(const NodePath& path) {
    std::string text;
    for (const std::string& part : path) text += (text.empty() ? "" : ".") + part;
    return text;
}

}  // namespace kerf::documents
