// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/correct_keys.h"

#include <algorithm>
#include <string>
#include <vector>

#include "documents/yaml/read_map.h"
#include "text/look_alike.h"

namespace kerf::documents {
namespace {

void correct(Node& node, const ValueShape& shape, Report& report);

void correct_map(Node& map, const Shape& shape, Report& report) {
    if (map.kind != Node::Kind::map) return;
    std::vector<std::string> absent;
    for (const KeyShape& key : shape.keys)
        if (map.find(key.name) == nullptr) absent.push_back(key.name);
    for (Node& child : map.children) {
        if (report.is_full()) return;
        if (shape.find(child.key) == nullptr) {
            const std::string meant = closest(text::straightened(child.key), absent, report);
            if (meant.empty()) continue;
            refuse_key(child, shape, meant, report);
            child.key = meant;
            absent.erase(std::find(absent.begin(), absent.end(), meant));
        }
        correct(child, shape.find(child.key)->value, report);
    }
}

void correct(Node& node, const ValueShape& shape, Report& report) {
    if (shape.shape != nullptr) {
        // A map with a single key is meant as the other shape if that is closer to its key.
        const bool is_other = shape.other != nullptr && node.children.size() == 1 &&
                              !closest(text::straightened(node.children[0].key), {shape.other->keys[0].name}).empty();
        correct_map(node, is_other ? *shape.other : *shape.shape, report);
    } else if (!shape.item.empty()) {
        for (Node& child : node.children) correct(child, shape.item.front(), report);
    }
}

}  // namespace

void correct_keys(Node& document, const Shape& shape, Report& report) { correct_map(document, shape, report); }

}  // namespace kerf::documents
