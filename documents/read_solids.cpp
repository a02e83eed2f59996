// SPDX-License-Identifier: Apache-2.0
#include "documents/read_solids.h"

#include <utility>

#include "documents/shapes/shapes.h"

namespace kerf::documents {
namespace {

EllipticTubeSolid read_elliptic_tube(const Node& node, const std::string& name, Report& report) {
    EllipticTubeSolid tube;
    MapReader map(node, shapes::elliptic_tube, name, report);
    read_ends(map, tube, name);
    shapes::elliptic_tube.fill(map, tube);
    if (const Node* up = map.find("up")) {
        tube.up = read_vector(*up, map.name_of("up"), map.need_of("up"), report).value_or(tube.up);
        const Vec3 along = normalized(tube.to - tube.from);
        if (length(cross(along, normalized(tube.up))) < 1e-3 && length(along) > 0.0)
            report.error(text::Code::degenerate, up->span,
                         map.name_of("up") + " points along the tube, expected across it. Turn it.");
    }
    map.finish();
    return tube;
}

/// The one solid that a map names by its key.
Solid read_solid(MapReader& map, Report& report) {
    const Node* node = map.one_of();
    return node ? read_solid(*node, map.name_of(node->key), report) : BoxSolid{};
}

}  // namespace

TubeSolid read_tube(const Node& node, const std::string& name, Report& report) {
    TubeSolid tube;
    MapReader map(node, shapes::tube, name, report);
    read_ends(map, tube, name);
    shapes::tube.fill(map, tube);
    map.finish();
    return tube;
}

Solid read_solid(const Node& node, const std::string& name, Report& report) {
    if (node.key == "tube") return read_tube(node, name, report);
    if (node.key == "elliptic_tube") return read_elliptic_tube(node, name, report);
    if (node.key == "sphere") {
        SphereSolid sphere;
        read_map(node, shapes::sphere, name, sphere, report);
        return sphere;
    }
    BoxSolid box;
    read_map(node, shapes::box, name, box, report);
    return box;
}

std::vector<Solid> read_solids(const Node& node, const std::string& name, Report& report) {
    std::vector<Solid> solids;
    for (const Node& solid : read_list(node, name, report)) {
        MapReader map(solid, shapes::tissue_solid, name, report);
        solids.push_back(read_solid(map, report));
        map.finish();
    }
    return solids;
}

std::vector<PhantomPart> read_parts(const Node& node, const std::string& where, Report& report) {
    std::vector<PhantomPart> parts;
    UniqueIds ids;
    for (const Node& item : read_list(node, where, report)) {
        MapReader map(item, shapes::part, item_name(item, "part"), report);
        PhantomPart part;
        shapes::part.fill(map, part);
        ids.add_own(part.id, item, report);
        part.solid = read_solid(map, report);
        if (const Node* subtract = map.find("subtract")) {
            part.subtract = read_yes_no(*subtract, "subtract", report).value_or(false);
            if (part.subtract && parts.empty())
                report.error(
                    text::Code::degenerate, subtract->span,
                    "The first part is subtracted from nothing. Put it behind the parts that it is subtracted from.");
        }
        map.finish();
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace kerf::documents
