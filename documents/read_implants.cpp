// SPDX-License-Identifier: Apache-2.0
#include "documents/read_implants.h"

#include <string>
#include <utility>

#include "documents/read_anatomy.h"
#include "documents/shapes.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf {

namespace {

constexpr double shortest = 1e-6;  // [m] a length below it has no direction

bool is_name(const Node& child, const std::string& what, Report& report) {
    Node key;
    key.text = child.key;
    key.span = child.key_span;
    return read_id(key, what, report).has_value();
}

std::vector<ImplantHole> read_holes(const Node& node, const std::string& name, Report& report) {
    std::vector<ImplantHole> holes;
    if (!is_kind(node, Node::Kind::map, name, report)) return holes;
    for (const Node& child : node.children) {
        is_name(child, "A hole's name", report);
        MapReader map(child, shapes::implant_hole, child.key, report);
        ImplantHole hole;
        hole.id = child.key;
        const auto from = map.vector("from"), to = map.vector("to");
        hole.from = from.value_or(Vec3{});
        hole.to = to.value_or(Vec3{});
        hole.diameter = map.quantity("diameter");
        if (from && to && length(*to - *from) < shortest)
            report.error(Code::degenerate, map.span(),
                         child.key + " has no length: both ends are the same point. Move one of them.");
        map.finish();
        holes.push_back(std::move(hole));
    }
    return holes;
}

ImplantPlace read_geometry(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, shapes::implant_place, name, report);
    ImplantPlace place;
    place.axis = map.id("axis");
    if (const auto up = map.vector("up")) {
        place.up = normalized(*up);
        if (!(length(*up) > 1e-6))
            report.error(Code::degenerate, map.span(), name + ".up has no length. Give it a direction, as in `0 0 1`.");
    }
    map.finish();
    return place;
}

}  // namespace

std::vector<Implant> read_implants(const Node& node, Report& report) {
    std::vector<Implant> implants;
    if (!is_kind(node, Node::Kind::map, "implants", report)) return implants;
    for (const Node& child : node.children) {
        is_name(child, "An implant's name", report);
        MapReader map(child, shapes::implant, child.key, report);
        Implant implant;
        implant.id = child.key;
        const Node* solid = map.one_of();
        if (solid && solid->key == "mesh") implant.mesh = read_mesh(*solid, child.key + ".mesh", report);
        if (solid && solid->key == "parts") implant.solids.parts = read_parts(*solid, child.key + ".parts", report);
        if (const Node* holes = map.find("holes")) implant.holes = read_holes(*holes, child.key + ".holes", report);
        if (const Node* place = map.find("place")) implant.place = read_geometry(*place, child.key + ".place", report);
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
        return report.error(Code::unknown_plate_hole, axis.span,
                            "The axis `" + excerpt(axis.text, 60) + "` is unknown: `" + implant.id +
                                "` has no hole for this screw, " +
                                (known.empty() ? "and no other. Give it `holes:`."
                                               : "expected " + listed(known) + "." +
                                                     or_choose(meant, "Name one of these, or add it under `holes:`.")),
                            meant, reason("holes", "its holes are here."));
    }
    if (!implant.place)
        report.error(Code::unknown_plate_hole, axis.span,
                     "The axis `" + axis.text + "` has no planned position: `" + implant.id +
                         "` has no `place:`. Add `place: {axis: …, up: 0 0 1}` to it.",
                     {}, reason("place", "the implant is here."));
}

}  // namespace kerf
