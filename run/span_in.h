// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "documents/yaml/document.h"

namespace kerf::run {

/// Returns where a key of an item of a list is written; without the key, the item.   [any]
[[nodiscard]] inline documents::TextSpan span_in(const documents::Document& document, const char* list,
                                                 std::size_t index, const char* key) {
    const documents::Node* items = document.root.find(list);
    if (items == nullptr || index >= items->children.size()) return {};
    const documents::Node* value = items->children[index].find(key);
    return value != nullptr ? value->span : items->children[index].span;
}

}  // namespace kerf::run
