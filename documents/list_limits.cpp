// SPDX-License-Identifier: Apache-2.0
#include "documents/list_limits.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "documents/waypoint_nodes.h"
#include "text/codes.h"

namespace kerf::documents {
namespace {

struct ListLimit {
    std::string_view path;  ///< keys; `*` is every item
    std::size_t max;
    std::string_view noun, advice;
    bool is_of_all = false;  ///< counts the items of all lists at this path together
};

constexpr std::size_t max_waypoints = max_followed;

constexpr std::string_view remove_some = "Remove some";

constexpr std::array limits{
    // Procedures
    ListLimit{"metadata.authors", 100, "authors", remove_some},
    ListLimit{"needs.landmarks", 256, "landmarks", remove_some},
    ListLimit{"needs.zones", 64, "zones", remove_some},
    ListLimit{"needs.tissues", 64, "tissues", remove_some},
    ListLimit{"instruments", 64, "instruments", "Split the procedure"},
    ListLimit{"implants", 64, "implants", "Split the procedure"},
    ListLimit{"implants.*.holes", 64, "holes", remove_some},
    ListLimit{"steps", 256, "steps", "Split the procedure"},
    ListLimit{"steps.*.goals", 64, "goals", remove_some},
    ListLimit{"steps.*.limits", 64, "limits", remove_some},
    ListLimit{"steps.*.allow", 64, "allowed zones", remove_some},
    ListLimit{"paths", 256, "paths", remove_some},
    ListLimit{"rehearsals", 256, "rehearsals", remove_some},
    // Each is read again for each variant.
    ListLimit{"paths.*", max_waypoints, "waypoints in `paths`", "Write shorter paths", true},
    ListLimit{"rehearsals.*.path", max_waypoints, "waypoints in the rehearsals", "Write shorter paths", true},
    // Each is read and checked like a procedure.
    ListLimit{"variants", 32, "variants", "Move some into a procedure of their own"},
    // Anatomies
    ListLimit{"phantom.parts", 256, "parts", "Combine some, or take a mesh"},
    ListLimit{"tissues.*.solids", 256, "solids", "Combine some"},
    ListLimit{"tissues.*.regions", 256, "regions", "Combine some"},
    ListLimit{"landmarks.points", 256, "points", remove_some},
    ListLimit{"landmarks.axes", 256, "axes", remove_some},
    ListLimit{"landmarks.planes", 256, "planes", remove_some},
    ListLimit{"landmarks.markups", 64, "files of markups", remove_some},
    ListLimit{"landmarks.markups.*.names", 256, "names", remove_some},
    // Both: the zones that a procedure shows, and those of an anatomy
    ListLimit{"zones", 64, "zones", remove_some},
    ListLimit{"zones.*", 256, "solids of a zone", "Combine some"},
};

/// Adds the lists at a path, in the order of the document.
void find_lists(const Node& node, std::string_view path, std::vector<const Node*>& lists) {
    if (path.empty()) return lists.push_back(&node);
    const std::size_t dot = path.find('.');
    const std::string_view key = path.substr(0, dot);
    const std::string_view rest = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
    if (key == "*") {
        for (const Node& child : node.children) find_lists(child, rest, lists);
    } else if (const Node* const found = node.find(key); found != nullptr) {
        find_lists(*found, rest, lists);
    }
}

/// Reports that a list, or several together, have `count` items, at the first item beyond the limit.
void refuse(const Node& list, std::size_t first_beyond, std::size_t count, const ListLimit& limit, Report& report) {
    const Node& first = list.children[first_beyond];
    report.error(text::Code::out_of_range, list.kind == Node::Kind::map ? first.key_span : first.span,
                 "There are too many " + std::string(limit.noun) + ": got " + std::to_string(count) +
                     ", expected at most " + std::to_string(limit.max) + ". " + std::string(limit.advice) + ".");
}

bool are_all_short(const std::vector<const Node*>& lists, const ListLimit& limit, Report& report) {
    std::size_t sum = 0;
    for (const Node* list : lists) sum += list->children.size();
    if (sum <= limit.max) return true;
    std::size_t before = 0;
    for (const Node* list : lists) {
        if (before + list->children.size() > limit.max) {
            refuse(*list, limit.max - before, sum, limit, report);
            break;
        }
        before += list->children.size();
    }
    return false;
}

/// Reports lists that are too long. Returns false if there is one.
bool are_short_at(const Node& root, const ListLimit& limit, Report& report) {
    std::vector<const Node*> lists;
    find_lists(root, limit.path, lists);
    if (limit.is_of_all) return are_all_short(lists, limit, report);
    bool are_short = true;
    for (const Node* list : lists) {
        if (list->children.size() <= limit.max) continue;
        refuse(*list, limit.max, list->children.size(), limit, report);
        are_short = false;
    }
    return are_short;
}

}  // namespace

bool are_lists_short(const Node& root, Report& report) {
    bool are_short = true;
    for (const ListLimit& limit : limits) are_short = are_short_at(root, limit, report) && are_short;
    return are_short;
}

}  // namespace kerf::documents
