// SPDX-License-Identifier: Apache-2.0
#include "documents/list_limits.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "text/codes.h"

namespace kerf::documents {
namespace {

struct ListLimit {
    std::string_view path;  ///< keys; `*` is every item
    std::size_t max;
    std::string_view noun, advice;
};

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

/// Reports a list that is too long, at its first item beyond the limit. Returns false if there is one.
bool is_short(const Node& node, std::string_view path, const ListLimit& limit, Report& report) {
    if (path.empty()) {
        if (node.children.size() <= limit.max) return true;
        const Node& first = node.children[limit.max];
        report.error(text::Code::out_of_range, node.kind == Node::Kind::map ? first.key_span : first.span,
                     "There are too many " + std::string(limit.noun) + ": got " + std::to_string(node.children.size()) +
                         ", expected at most " + std::to_string(limit.max) + ". " + std::string(limit.advice) + ".");
        return false;
    }
    const std::size_t dot = path.find('.');
    const std::string_view key = path.substr(0, dot);
    const std::string_view rest = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
    if (key == "*") {
        bool are_short = true;
        for (const Node& child : node.children) are_short = is_short(child, rest, limit, report) && are_short;
        return are_short;
    }
    const Node* const found = node.find(key);
    return found == nullptr || is_short(*found, rest, limit, report);
}

}  // namespace

bool are_lists_short(const Node& root, Report& report) {
    bool are_short = true;
    for (const ListLimit& limit : limits) are_short = is_short(root, limit.path, limit, report) && are_short;
    return are_short;
}

}  // namespace kerf::documents
