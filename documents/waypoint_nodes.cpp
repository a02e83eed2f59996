// SPDX-License-Identifier: Apache-2.0
#include "documents/waypoint_nodes.h"

namespace kerf::documents {

std::vector<const Node*> waypoint_nodes(const Document& document, const Node* path) {
    std::vector<const Node*> nodes;
    if (path == nullptr || path->kind != Node::Kind::list) return nodes;
    const Node* paths = document.root.find("paths");
    std::size_t followed = 0;
    for (const Node& item : path->children) {
        const Node* name = item.find("follow");
        if (name == nullptr) {
            nodes.push_back(&item);
            continue;
        }
        const Node* there = paths != nullptr ? paths->find(name->text) : nullptr;
        if (there == nullptr || there->kind != Node::Kind::list) continue;
        for (const Node& waypoint : there->children) {
            if (followed >= max_followed) break;
            if (waypoint.find("follow") != nullptr) continue;
            nodes.push_back(&waypoint);
            ++followed;
        }
    }
    return nodes;
}

std::vector<const Node*> waypoint_nodes(const Document& document, std::size_t rehearsal) {
    const Node* rehearsals = document.root.find("rehearsals");
    if (rehearsals == nullptr || rehearsal >= rehearsals->children.size()) return {};
    return waypoint_nodes(document, rehearsals->children[rehearsal].find("path"));
}

const Node* waypoint_node(const Document& document, std::size_t rehearsal, std::size_t waypoint, const char* key) {
    const std::vector<const Node*> nodes = waypoint_nodes(document, rehearsal);
    if (waypoint >= nodes.size()) return nullptr;
    return key != nullptr ? nodes[waypoint]->find(key) : nodes[waypoint];
}

}  // namespace kerf::documents
