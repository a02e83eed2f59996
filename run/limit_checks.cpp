// SPDX-License-Identifier: Apache-2.0
#include "run/limit_checks.h"

#include <algorithm>
#include <optional>
#include <string>

#include "documents/names.h"
#include "documents/read_procedure.h"
#include "documents/yaml/document.h"
#include "documents/yaml/read_map.h"
#include "run/in_mm.h"
#include "run/verdict/step_monitor.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::run {
namespace {

/// The end of a bound that breaks at the start, and the reason.
struct BrokenEnd {
    const char* key;    ///< "at_least"
    const char* other;  ///< the key that was meant
    std::string why;    ///< "but the tool has no depth when it meets bone"
};

/// Returns the distance of the step's tool from a zone at `from` of its axis [m]; nothing if the axis is not known yet.
std::optional<double> clearance_at_start(const documents::Step& step, const documents::Limit& limit,
                                         const ToolSolid& cutting, const documents::Anatomy& anatomy) {
    const documents::LandmarkAxis* axis = documents::find_id(anatomy.axes, step.axis);
    const documents::Zone* zone = documents::find_id(anatomy.zones, limit.zone);
    if (axis == nullptr || axis->fit || zone == nullptr || cutting.outline().size() < 2) return {};
    const AxisFrame frame = axis_frame(*axis, 0.0, anatomy, documents::find_id(anatomy.planes, step.plane));
    return clearance(cutting, frame.pose_at({.depth = 0.0}), *zone);
}

std::optional<BrokenEnd> broken_end(const documents::Step& step, const documents::Limit& limit, const ToolOutline& tool,
                                    const documents::Anatomy& anatomy) {
    const documents::Bound& bound = limit.bound;
    // The depth of an implant counts as it is left.
    if (limit.quantity == "depth" && bound.at_least && *bound.at_least > 0.0 && !tool.is_implant())
        return BrokenEnd{"at_least", "at_most", "but the depth is 0 mm where the tool meets bone"};
    if (limit.quantity == "clearance" && bound.at_most)
        if (const auto distance = clearance_at_start(step, limit, tool.cutting, anatomy);
            distance && *distance > *bound.at_most)
            return BrokenEnd{"at_most", "at_least",
                             "but the tool begins " + in_mm(*distance) + " away, at `from` of its axis"};
    return std::nullopt;
}

}  // namespace

void check_limits_at_start(const documents::Procedure& procedure, std::size_t step, const ToolOutline& tool,
                           const documents::Anatomy& anatomy, text::Diagnostics& diagnostics) {
    const documents::Step& judged = procedure.steps[step];
    const auto document = documents::document_of(procedure);
    const documents::Node* steps = document->root.find("steps");
    const documents::Node* item = steps != nullptr && step < steps->children.size() ? &steps->children[step] : nullptr;
    const documents::Node* limits = item != nullptr ? item->find("limits") : nullptr;
    for (std::size_t l = 0; l < judged.limits.size(); ++l) {
        const documents::Limit& limit = judged.limits[l];
        const auto broken = broken_end(judged, limit, tool, anatomy);
        if (!broken) continue;
        const documents::Node* written =
            limits != nullptr && l < limits->children.size() ? limits->children[l].find(limit.quantity) : nullptr;
        const documents::Node* end = written != nullptr ? written->find(broken->key) : nullptr;
        const std::string value = end != nullptr ? text::excerpt(end->text, 40) : "";
        const bool has_other = written != nullptr && written->find(broken->other) != nullptr;
        documents::Report(*document, diagnostics)
            .error(text::Code::empty_bound, end != nullptr ? end->key_span : documents::TextSpan{},
                   "The limit `" + limit.name() + "` breaks before the step begins: got at " + (broken->key + 3) + " " +
                       value + ", " + broken->why + "." +
                       (has_other ? " Remove `" + std::string(broken->key) + "`, or write a goal." : ""),
                   has_other ? "" : std::string(broken->other) + ": " + value);
    }
}

}  // namespace kerf::run
