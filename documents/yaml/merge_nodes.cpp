// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/merge_nodes.h"

#include <string>
#include <unordered_set>
#include <utility>

namespace kerf::documents {
namespace {

constexpr std::size_t max_copied = 10000;  // nodes of all copies of a document

/// Returns the key of an entry, the id of an item, or the text of an item that is a name; empty if it has none.
std::string name_of(const Node& child) {
    if (!child.key.empty()) return child.key;
    if (child.kind == Node::Kind::scalar) return child.text;
    const Node* id = child.find("id");
    return id != nullptr ? id->text : std::string();
}

/// Returns whether a node has at most `max` nodes, itself included, and counts them.
bool is_small(const Node& node, std::size_t max, std::size_t& count) {
    if (++count > max) return false;
    for (const Node& child : node.children)
        if (!is_small(child, max, count)) return false;
    return true;
}

}  // namespace

void merge(Node& first, const Node& more) {
    if (first.kind == Node::Kind::scalar && first.text.empty() && !first.is_refused) {
        Node meant = more;
        meant.key = first.key;
        meant.key_span = first.key_span;
        first = std::move(meant);
        return;
    }
    if (first.kind != more.kind || first.kind == Node::Kind::scalar) return;
    std::unordered_set<std::string> names;
    for (const Node& child : first.children) names.insert(name_of(child));
    for (const Node& child : more.children)
        if (const std::string name = name_of(child); name.empty() || names.insert(name).second)
            first.children.push_back(child);
}

void Anchors::add(std::size_t anchor, const Node& node) {
    std::size_t count = 0;
    if (anchor == 0 || !is_small(node, max_copied - copied_, count)) return;
    copied_ += count;
    nodes_.insert_or_assign(anchor, node);
}

Node Anchors::copy_of(std::size_t anchor, TextSpan span) {
    const auto found = nodes_.find(anchor);
    std::size_t count = 0;
    Node copy;
    if (found == nodes_.end() || !is_small(found->second, max_copied - copied_, count)) {
        copy.is_refused = true;
    } else {
        copied_ += count;
        copy = found->second;
    }
    copy.span = span;
    copy.is_alias = true;
    return copy;
}

}  // namespace kerf::documents
