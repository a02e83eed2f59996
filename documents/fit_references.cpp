// SPDX-License-Identifier: Apache-2.0
#include "documents/fit_references.h"

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "documents/yaml/read_map.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

std::string in_ticks(const std::string& id) { return "`" + text::excerpt(id) + "`"; }

TextSpan span_of(const Node& root, std::initializer_list<std::string> keys) {
    const Node* node = &root;
    for (const std::string& key : keys)
        if (node != nullptr) node = node->find(key);
    return node != nullptr ? node->span : TextSpan{};
}

/// What fits may refer to.
struct Known {
    std::vector<std::string> spheres;  ///< points
    std::vector<std::string> along;    ///< axes that are not fitted to condyles
    std::set<std::string> all_axes;
    bool has_markups = false;
};

bool contains(const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

void check_head(const Node& root, const LandmarkAxis& neck, const Known& known, Report& report) {
    const std::string& head = neck.fit->reference;
    if (contains(known.spheres, head)) return;
    const std::string meant = closest(head, known.spheres, report);
    report.error(text::Code::fit_reference, span_of(root, {"landmarks", "axes", neck.id, "fit", "neck", "head"}),
                 "The head of the neck " + in_ticks(neck.id) + " is unknown: got " + in_ticks(head) +
                     ", expected a point with `fit: {sphere: …}`." +
                     or_choose(meant, known.spheres.empty() ? "Add one under `landmarks.points`."
                                                            : "Write " + listed(known.spheres, head) + "."),
                 meant);
}

void check_shaft(const Node& root, const LandmarkAxis& condyles, const Known& known, Report& report) {
    const std::string& shaft = condyles.fit->reference;
    if (contains(known.along, shaft)) return;
    const bool is_axis = known.all_axes.contains(shaft);
    if (!is_axis && known.has_markups) return;
    const std::string meant = closest(shaft, known.along, report);
    report.error(text::Code::fit_reference,
                 span_of(root, {"landmarks", "axes", condyles.id, "fit", "condyles", "shaft"}),
                 "The shaft of the condyles " + in_ticks(condyles.id) +
                     (is_axis ? " is fitted to condyles itself: got " : " is unknown: got ") + in_ticks(shaft) +
                     ", expected an axis along the bone." + or_choose(meant, "Add one under `landmarks.axes`."),
                 meant);
}

}  // namespace

void check_fit_references(const Node& root, const Anatomy& anatomy, Report& report) {
    Known known;
    known.has_markups = !anatomy.markups.empty();
    for (const LandmarkPoint& point : anatomy.points)
        if (point.fit) known.spheres.push_back(point.id);
    for (const LandmarkAxis& axis : anatomy.axes) {
        known.all_axes.insert(axis.id);
        if (!axis.fit || axis.fit->shape != LandmarkFit::Shape::condyles) known.along.push_back(axis.id);
    }
    for (const LandmarkAxis& axis : anatomy.axes) {
        if (!axis.fit || axis.fit->reference.empty()) continue;
        if (axis.fit->shape == LandmarkFit::Shape::neck)
            check_head(root, axis, known, report);
        else
            check_shaft(root, axis, known, report);
    }
    if (anatomy.ct && contains(known.spheres, anatomy.ct->component_at))
        report.error(text::Code::fit_reference, span_of(root, {"ct", "keep", "component_at"}),
                     "The piece of bone is chosen by a point that is fitted from it: got " +
                         in_ticks(anatomy.ct->component_at) +
                         ", expected a point without `fit`. Add one under `landmarks.points`.");
}

}  // namespace kerf::documents
