// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

/// Helpers for the ids of things and for lists of them.
namespace kerf::documents {

inline std::string quoted_id(const std::string& id) { return "`" + id + "`"; }

inline bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

template <class T>
void append_ids(const std::vector<T>& things, std::vector<std::string>& ids) {
    for (const T& thing : things) ids.push_back(thing.id);
}

template <class T>
std::vector<std::string> ids_of(const std::vector<T>& things) {
    std::vector<std::string> ids;
    append_ids(things, ids);
    return ids;
}

/// Returns null where there is none.
template <class T>
const T* find_id(const std::vector<T>& things, const std::string& id) {
    const auto found = std::find_if(things.begin(), things.end(), [&](const T& thing) { return thing.id == id; });
    return found != things.end() ? &*found : nullptr;
}

}  // namespace kerf::documents
