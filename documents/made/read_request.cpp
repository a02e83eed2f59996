// SPDX-License-Identifier: Apache-2.0
#include "documents/made/read_request.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "documents/made/draw.h"
#include "documents/made/make_bone.h"
#include "documents/shapes/shapes.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

void read_seed(MapReader& map, MakeRequest& request) {
    const Node* node = map.find("seed");
    if (node == nullptr) return;
    const int errors = map.report().errors();
    double seed = 0.0;
    map.quantity("seed", seed);
    if (map.report().errors() > errors) return;
    if (seed != std::floor(seed))
        map.report().error(text::Code::out_of_range, node->span,
                           "`seed` is not a whole number: got " + text::excerpt(node->text) + ", expected 0 … " +
                               std::to_string(max_seed) + ". Write `seed: 7`.");
    else
        request.seed = static_cast<std::uint32_t>(seed);
}

void read_fixed(const Node& node, const std::vector<Dimension>& dimensions, MakeRequest& request, Report& report) {
    if (!is_kind(node, Node::Kind::map, "set", report)) return;
    std::vector<std::string> known;
    for (const Dimension& dimension : dimensions) known.push_back(dimension.name);
    for (const Node& child : node.children) {
        const auto found = std::find_if(dimensions.begin(), dimensions.end(),
                                        [&](const Dimension& dimension) { return dimension.name == child.key; });
        if (found == dimensions.end()) {
            refuse_unknown({.code = text::Code::unknown_parameter,
                            .span = child.key_span,
                            .subject = "The dimension `" + text::excerpt(child.key) + "`",
                            .word = child.key,
                            .known = known,
                            .is_key = true},
                           report);
            continue;
        }
        const text::QuantityNeed need{found->dimension, found->unit, found->min_set, found->max_set};
        if (const auto value = read_quantity(child, "set." + child.key, need, report))
            request.fixed.push_back({child.key, *value});
    }
}

/// Reports a level that the kind does not have, or a level that is missing.
void check_level(const MakeRequest& request, const Node& node, Report& report) {
    const BoneKind& kind = bone_kind(request.kind);
    const std::vector<std::string>& levels = kind.levels;
    if (levels.empty() && !request.level.empty())
        report.error(text::Code::unknown_key, node.span,
                     "`level` does not belong to a " + kind.name + ": leave it out.");
    if (levels.empty() || std::find(levels.begin(), levels.end(), request.level) != levels.end()) return;
    if (request.level.empty()) {
        report.error(text::Code::missing_key, node.span,
                     "`make: " + kind.name + "` has no `level:`: it is " + kind.a_level + ", one of " + listed(levels) +
                         ". Write `level: " + kind.example_level + "`.");
    } else {
        const std::string meant = closest(request.level, levels, report);
        report.error(text::Code::unknown_word, node.span,
                     "`level` is not one of a " + kind.name + ": got " + text::excerpt(request.level) + ", expected " +
                         listed(levels, request.level) + "." + or_choose(meant),
                     meant);
    }
}

}  // namespace

std::optional<MakeRequest> read_make_request(const Node& node, const std::string& name, Report& report) {
    const int errors = report.errors();
    MakeRequest request;
    MapReader map(node, shapes::made_bone, name, report);
    shapes::made_bone.fill(map, request);
    read_seed(map, request);
    const Node* set = map.find("set");
    const Node* level = map.find("level");
    map.finish();
    if (request.kind.empty()) return std::nullopt;
    check_level(request, level != nullptr ? *level : node, report);
    if (report.errors() > errors) return std::nullopt;
    const Population population = population_of(request);
    if (set != nullptr) read_fixed(*set, population.dimensions, request, report);
    if (report.errors() > errors) return std::nullopt;
    const std::string contradiction = draw_bone(population, request).contradiction;
    if (contradiction.empty()) return request;
    report.error(text::Code::degenerate, (set != nullptr ? *set : node).span,
                 "The dimensions contradict each other: " + contradiction +
                     (set != nullptr ? ". Change a value in `set:`." : ". Take another `seed:` or `height:`."));
    return std::nullopt;
}

}  // namespace kerf::documents
