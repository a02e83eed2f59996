// SPDX-License-Identifier: Apache-2.0
#include "documents/read_landmarks.h"

#include <utility>

#include "documents/read_solids.h"
#include "documents/shapes/shapes.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

std::vector<MarkupsFile> read_markups(const Node& node, Report& report) {
    std::vector<MarkupsFile> files;
    for (const Node& item : read_list(node, "landmarks.markups", report)) {
        MapReader map(item, shapes::markups, "markups", report);
        MarkupsFile markups;
        shapes::markups.fill(map, markups);
        if (const Node* names = map.find("names"))
            for (const Node& one : read_list(*names, "markups.names", report)) {
                MapReader name(one, shapes::markup_name, "markups.names", report);
                const std::string label = name.text("label"), id = name.id("id");
                if (!markups.names.emplace(label, id).second)
                    report.error(text::Code::duplicate_id, one.span,
                                 "The label " + text::yaml_quoted(label) + " occurs twice under `names`. Remove one.");
                name.finish();
            }
        map.finish();
        files.push_back(std::move(markups));
    }
    return files;
}

}  // namespace

const std::vector<Node>& read_named(const Node* node, const std::string& name, UniqueIds& ids, Report& report) {
    static const std::vector<Node> none;
    if (!node || !is_kind(*node, Node::Kind::map, name, report)) return none;
    for (const Node& child : node->children)
        if (read_key(child, "A name in " + name, report)) ids.add(child.key, child.key_span, report);
    return node->children;
}

void read_landmarks(const Node& node, Anatomy& anatomy, Report& report) {
    MapReader map(node, shapes::landmarks, "landmarks", report);
    UniqueIds ids("landmark");  // a step names a landmark of any sort
    for (const Node& item : read_named(map.find("points"), "landmarks.points", ids, report)) {
        LandmarkPoint& point = anatomy.points.emplace_back(LandmarkPoint{.id = item.key});
        read_map(item, shapes::point, item.key, point, report);
    }
    for (const Node& item : read_named(map.find("axes"), "landmarks.axes", ids, report)) {
        LandmarkAxis& landmark = anatomy.axes.emplace_back(LandmarkAxis{.id = item.key});
        MapReader axis(item, shapes::axis, item.key, report);
        read_ends(axis, landmark, item.key);
        shapes::axis.fill(axis, landmark);
        axis.finish();
    }
    for (const Node& item : read_named(map.find("planes"), "landmarks.planes", ids, report)) {
        LandmarkPlane& plane = anatomy.planes.emplace_back(LandmarkPlane{.id = item.key});
        read_map(item, shapes::plane, item.key, plane, report);
    }
    if (const Node* files = map.find("markups")) anatomy.markups = read_markups(*files, report);
    map.finish();
}

}  // namespace kerf::documents
