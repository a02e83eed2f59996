// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/correct_keys.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "documents/yaml/key_homes.h"
#include "documents/yaml/read_map.h"
#include "text/look_alike.h"

namespace kerf::documents {
namespace {

void correct(Node& node, const ValueShape& shape, Report& report);

bool is_like(const Node& node, const ValueShape& shape) {
    using Kind = ValueShape::Kind;
    switch (node.kind) {
        case Node::Kind::map:
            return shape.kind == Kind::map || shape.kind == Kind::named || shape.kind == Kind::parameters;
        case Node::Kind::list:
            return shape.kind == Kind::list;
        case Node::Kind::scalar:
            break;
    }
    const bool is_number = shape.kind == Kind::quantity || shape.kind == Kind::vector ||
                           shape.kind == Kind::of_signal || shape.kind == Kind::of_measure ||
                           shape.kind == Kind::of_metric;
    if (is_number && node.text.find_first_of("0123456789") == std::string::npos) return false;
    return shape.item.empty() && shape.kind != Kind::map;
}

/// Returns the key that is required and missing in a map with one unknown key: that one is meant as it. Empty if
/// several keys may be meant, or none.
std::string the_missing_key(const Node& map, const Shape& shape, const std::vector<std::string>& absent) {
    const Node* unknown = nullptr;
    for (const Node& child : map.children) {
        if (shape.find(child.key) != nullptr) continue;
        if (unknown != nullptr) return {};
        unknown = &child;
    }
    if (unknown == nullptr) return {};
    std::string missing;
    for (const std::string& name : absent) {
        const KeyShape& key = *shape.find(name);
        if (key.presence != Presence::required) continue;
        if (!missing.empty() || !is_like(*unknown, key.value)) return {};
        missing = name;
    }
    return missing;
}

/// Returns whether one letter more, less or other turns one word into the other.
bool is_one_letter_apart(std::string_view one, std::string_view other) {
    const std::size_t shorter = std::min(one.size(), other.size()), longer = std::max(one.size(), other.size());
    std::size_t begin = 0, end = 0;
    while (begin < shorter && one[begin] == other[begin]) ++begin;
    while (end < shorter - begin && one[one.size() - 1 - end] == other[other.size() - 1 - end]) ++end;
    return begin + end + 1 >= longer;
}

/// Returns whether a key that a map lacks is the exact name of a key of another map.
bool is_elsewhere(const Node& child, const Shape& here, const Report& report) {
    return report.whole() != nullptr && !homes_of(child.key, *report.whole(), here).empty();
}

/// Returns the key nearest to an unknown one; empty if none is near. The exact name of a key of another map is no slip
/// of the pen, unless one letter alone differs.
std::string near_key(const Node& child, const Shape& here, const std::vector<std::string>& keys, const Report& report) {
    const std::string meant = closest(text::straightened(child.key), keys, report);
    const bool is_exact_elsewhere =
        !meant.empty() && !is_one_letter_apart(child.key, meant) && is_elsewhere(child, here, report);
    return is_exact_elsewhere ? std::string() : meant;
}

/// Returns the key that a key from a patch or a setting was meant to change; empty if none is near.
std::string changed_key(const Node& child, const Shape& here, const std::vector<std::string>& present,
                        const Report& report) {
    const bool is_added = child.key_span.source != 0;
    return is_added ? near_key(child, here, present, report) : std::string();
}

void correct_map(Node& map, const Shape& shape, Report& report) {
    if (map.kind != Node::Kind::map) return;
    std::vector<std::string> absent, present;
    for (const KeyShape& key : shape.keys) (map.find(key.name) == nullptr ? absent : present).push_back(key.name);
    const std::string renamed = the_missing_key(map, shape, absent);
    std::vector<const Node*> dropped;
    for (Node& child : map.children) {
        if (shape.find(child.key) == nullptr && !report.is_full()) {
            std::string meant = near_key(child, shape, absent, report);
            if (meant.empty()) meant = renamed;
            if (const std::string changed = meant.empty() ? changed_key(child, shape, present, report) : "";
                !changed.empty()) {
                refuse_key(child, map, shape, changed, report);
                dropped.push_back(&child);
                continue;
            }
            if (!meant.empty()) {
                refuse_key(child, map, shape, meant, report);
                child.key = meant;
                absent.erase(std::find(absent.begin(), absent.end(), meant));
            }
        }
        if (const KeyShape* key = shape.find(child.key); key != nullptr && !report.is_full())
            correct(child, key->value, report);
    }
    std::erase_if(map.children, [&](const Node& child) {
        return std::find(dropped.begin(), dropped.end(), &child) != dropped.end();
    });
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
