// SPDX-License-Identifier: Apache-2.0
#include "documents/read_implants.h"

#include <string>
#include <utility>

#include "documents/read_bone_source.h"
#include "documents/read_solids.h"
#include "documents/shapes/shapes.h"
#include "text/codes.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {

namespace {

std::vector<ImplantHole> read_holes(const Node& node, const std::string& name, Report& report) {
    std::vector<ImplantHole> holes;
    if (!is_kind(node, Node::Kind::map, name, report)) return holes;
    for (const Node& child : node.children) {
        read_key(child, "A hole's name", report);
        ImplantHole hole{.id = child.key};
        MapReader map(child, shapes::implant_hole, child.key, report);
        read_ends(map, hole, child.key);
        shapes::implant_hole.fill(map, hole);
        map.finish();
        holes.push_back(std::move(hole));
    }
    return holes;
}

}  // namespace

std::vector<Implant> read_implants(const Node& node, Report& report) {
    std::vector<Implant> implants;
    if (!is_kind(node, Node::Kind::map, "implants", report)) return implants;
    for (const Node& child : node.children) {
        read_key(child, "An implant's name", report);
        Implant implant{.id = child.key};
        MapReader map(child, shapes::implant, child.key, report);
        const Node* solid = map.one_of();
        if (solid && solid->key == "mesh") implant.mesh = read_mesh(*solid, child.key + ".mesh", report);
        if (solid && solid->key == "parts") implant.solids.parts = read_parts(*solid, child.key + ".parts", report);
        if (const Node* holes = map.find("holes")) implant.holes = read_holes(*holes, child.key + ".holes", report);
        shapes::implant.fill(map, implant);
        map.finish();
        implants.push_back(std::move(implant));
    }
    return implants;
}

void check_named_hole(const Node& axis, const NamedHole& named, const Node& place, Report& report) {
    const Implant& implant = *named.implant;
    const Node* written = place.find(implant.id);
    const auto reason = [&](const char* key, const char* text) {
        const Node* node = written ? written->find(key) : nullptr;
        return written ? std::optional(report.because(node ? node->key_span : written->key_span, text)) : std::nullopt;
    };
    if (named.hole == nullptr) {
        std::vector<std::string> known;
        for (const ImplantHole& hole : implant.holes) known.push_back(implant.id + "." + hole.id);
        const std::string meant = closest(axis.text, known, report);
        return report.error(text::Code::unknown_plate_hole, axis.span,
                            "The axis `" + text::excerpt(axis.text, 60) + "` is unknown: `" + implant.id +
                                "` has no hole for this screw, " +
                                (known.empty() ? "and no other. Give it `holes:`."
                                               : "expected " + listed(known, axis.text) + "." +
                                                     or_choose(meant, "Name one of these, or add it under `holes:`.")),
                            meant, reason("holes", "its holes are here."));
    }
    if (!implant.place)
        report.error(text::Code::unknown_plate_hole, axis.span,
                     "The axis `" + axis.text + "` has no planned position: `" + implant.id +
                         "` has no `place:`. Add `place: {axis: …, up: 0 0 1}` to it.",
                     {}, reason("place", "the implant is here."));
}

}  // namespace kerf::documents
