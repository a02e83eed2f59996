// SPDX-License-Identifier: Apache-2.0
#include "documents/check_needs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "documents/consequences.h"
#include "documents/names.h"
#include "documents/read_anatomy.h"
#include "documents/read_measures.h"
#include "documents/read_procedure.h"
#include "documents/waypoint_nodes.h"
#include "documents/yaml/read_map.h"
#include "kerf/units.hpp"
#include "text/codes.h"
#include "text/distinguishing_digits.h"
#include "text/quantity.h"

namespace kerf::documents {
namespace {

constexpr const char* midline = "midline";

// Nodes of the document; null where it has none, or where the node around it is null.
const Node* item_of(const Node* list, std::size_t i) {
    return list != nullptr && i < list->children.size() ? &list->children[i] : nullptr;
}
const Node* find_in(const Node* map, const std::string& key) { return map != nullptr ? map->find(key) : nullptr; }
TextSpan span_or_none(const Node* node) { return node != nullptr ? node->span : TextSpan{}; }

/// Returns the place of `text` in `list`, or of the whole document if the list does not have it.
TextSpan span_of_text(const Node* list, const std::string& text) {
    for (const Node& item : list != nullptr ? list->children : std::vector<Node>{})
        if (item.text == text) return item.span;
    return {};
}

/// Returns the one name of the anatomy that the procedure uses without declaring it; empty for none or several.
std::string the_undeclared(const std::vector<std::string>& present, const std::string& what,
                           const text::Diagnostics& diagnostics) {
    std::string found;
    for (const std::string& name : present) {
        if (!is_reported_undeclared(diagnostics, what, name)) continue;
        if (!found.empty()) return {};
        found = name;
    }
    return found;
}

void check_list(const std::vector<std::string>& needed, const std::vector<std::string>& present, const Node* list,
                text::Code code, const std::string& what, const Anatomy& anatomy, Report& report,
                text::Diagnostics& diagnostics) {
    for (const std::string& name : needed) {
        if (contains(present, name)) continue;
        std::string meant = closest(name, present, report);
        if (meant.empty()) meant = the_undeclared(present, what, diagnostics);
        if (!meant.empty()) drop_undeclared(diagnostics, what, meant);
        report.error(code, span_of_text(list, name),
                     "The anatomy has no " + what + " " + quoted_id(name) +
                         (present.empty() ? "." : ": expected " + listed(present, name) + ".") +
                         or_choose(meant, "Add it there, or choose another anatomy."),
                     meant,
                     report.is_full()
                         ? std::nullopt
                         : std::optional(in_anatomy(anatomy, {what + "s"}, "its " + what + "s are here.")));
    }
}

/// Reports an axis that leads out of its plane: a blade that is fed along it would leave the plane.
void check_lies_in(const LandmarkAxis& axis, const LandmarkPlane& plane, TextSpan span, const Anatomy& anatomy,
                   Report& report) {
    using namespace literals;
    constexpr double max_angle = 3.0_deg;
    const double angle = std::asin(std::clamp(std::abs(dot(normalized(axis.to - axis.from), plane.normal)), 0.0, 1.0));
    const double off = std::abs(dot(0.5 * (axis.from + axis.to) - plane.at, plane.normal)),
                 max_off = axis.tolerance + plane.tolerance;
    const auto text_of = [](double value, int digits, double unit, const char* name) {
        const double step = unit * std::pow(10.0, -digits);
        return text::quantity_text(std::round(value / step) * step, name);
    };
    const auto in_deg = [&](double value, int digits) { return text_of(value, digits, 1.0_deg, "deg"); };
    const auto in_mm = [&](double value, int digits) { return text_of(value, digits, 1.0_mm, "mm"); };
    const text::ComparedTexts angles = text::compared(angle, max_angle, 1, 6, in_deg),
                              lengths = text::compared(off, max_off, 1, 6, in_mm);
    const text::Reason here = in_anatomy(anatomy, {"landmarks", "axes", axis.id}, "the axis is here.");
    if (angle > max_angle)
        report.error(text::Code::axis_off_plane, span,
                     "The axis " + quoted_id(axis.id) + " leaves the plane " + quoted_id(plane.id) +
                         ": got an angle of " + angles.value + ", expected at most " + angles.bound +
                         ", or the blade binds. Turn one of the two.",
                     {}, here);
    else if (off > max_off + 1e-9)
        report.error(text::Code::axis_off_plane, span,
                     "The axis " + quoted_id(axis.id) + " is not in the plane " + quoted_id(plane.id) +
                         ": got a distance of " + lengths.value + ", expected at most " + lengths.bound +
                         ", the sum of their tolerances. Move one of the two.",
                     {}, here);
}

/// Reports a quantity in the plane of a step that has none. `step` may be null.
void refuse_without_plane(const Node& what, const std::string& step_id, const Node* step, Report& report) {
    report.error(text::Code::needs_plane, what.key_span,
                 quoted_id(what.key) + " needs a plane, and the step " + quoted_id(step_id) +
                     " has none. Give the step a `plane:`, or remove " + quoted_id(what.key) + ".",
                 {}, step ? std::optional(report.because(step->span, "the step is here.")) : std::nullopt);
}

void check_planes(const Procedure& procedure, const Document& document, Report& report) {
    const Node* steps = document.root.find("steps");
    for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
        const Node* step = item_of(steps, s);
        for (std::size_t l = 0; l < procedure.steps[s].limits.size(); ++l) {
            const Limit& limit = procedure.steps[s].limits[l];
            const Node* node = find_in(item_of(find_in(step, "limits"), l), limit.quantity);
            if (node && limit.is_of_wall() && step->find("plane") == nullptr)
                refuse_without_plane(*node, procedure.steps[s].id, step, report);
        }
    }
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r) {
        const std::vector<const Node*> nodes = waypoint_nodes(document, r);
        for (std::size_t w = 0; w < procedure.rehearsals[r].path.size(); ++w) {
            const std::size_t s = procedure.rehearsals[r].path[w].step;
            const Node* waypoint = w < nodes.size() ? nodes[w] : nullptr;
            if (!waypoint || s >= procedure.steps.size() || !procedure.steps[s].plane.empty()) continue;
            if (const Node* step = item_of(steps, s); step != nullptr && step->find("plane") != nullptr) continue;
            for (const char* key : {"aside", "tilt"})
                if (const Node* node = waypoint->find(key))
                    refuse_without_plane(*node, procedure.steps[s].id, item_of(steps, s), report);
        }
    }
}

/// Refuses a point or a plane of the anatomy where an axis is needed.
void refuse_for_an_axis(TextSpan span, const std::string& id, bool is_point, const Anatomy& anatomy,
                        const std::vector<std::string>& axes, Report& report) {
    const std::string meant = closest(id, axes, report);
    report.error(text::Code::axis_is_a_point, span,
                 "The landmark " + quoted_id(id) + " is of the wrong kind: got a " + (is_point ? "point" : "plane") +
                     ", expected an axis." + or_choose(meant, "Name an axis, or give the anatomy one."),
                 meant,
                 in_anatomy(anatomy, {"landmarks", is_point ? "points" : "planes", id},
                            is_point ? "it is a point here." : "it is a plane here."));
}

/// Checks that implants are planned along axes, and that `up` gives a direction across them.
void check_planned_implants(const Procedure& procedure, const Anatomy& anatomy, const Document& document,
                            Report& report) {
    const Node* implants = document.root.find("implants");
    const std::vector<std::string> axes = ids_of(anatomy.axes), points = ids_of(anatomy.points),
                                   planes = ids_of(anatomy.planes);
    for (const Implant& implant : procedure.implants) {
        const Node* place = find_in(find_in(implants, implant.id), "place");
        const Node* name = find_in(place, "axis");
        if (!implant.place || !name || !contains(procedure.needs_landmarks, implant.place->axis)) continue;
        const std::string& id = implant.place->axis;
        if (contains(axes, id)) {
            const LandmarkAxis& axis = *find_id(anatomy.axes, id);
            if (length(cross(normalized(axis.to - axis.from), implant.place->up)) >= std::sin(min_angle_of_up))
                continue;
            const Node* up = place->find("up");
            report.error(text::Code::degenerate, up ? up->span : name->span,
                         "The place of " + quoted_id(implant.id) +
                             " has no direction for its x: `up` points along the "
                             "axis " +
                             quoted_id(id) + ", expected across it. Write another `up`, across it.",
                         {}, in_anatomy(anatomy, {"landmarks", "axes", id}, "the axis is here."));
        } else if (contains(points, id) || contains(planes, id)) {
            refuse_for_an_axis(name->span, id, contains(points, id), anatomy, axes, report);
        }
    }
}

/// Limits on places need landmarks of their sort. Limits and waypoints of a fracture need a fracture.
void check_places(const Procedure& procedure, const Anatomy& anatomy, const std::vector<std::string>& axes,
                  const std::vector<std::string>& points, const Document& document, Report& report) {
    const Node* steps = document.root.find("steps");
    const auto refuse_whole_bone = [&](TextSpan span, const std::string& what) {
        report.error(text::Code::missing_fracture, span,
                     "The anatomy has no fracture, which " + what + " needs. Add `fracture:` there, or remove this.",
                     {}, in_anatomy(anatomy, {"metadata"}, "the anatomy is here."));
    };
    for (std::size_t s = 0; s < procedure.steps.size(); ++s)
        for (std::size_t l = 0; l < procedure.steps[s].limits.size(); ++l) {
            const Limit& limit = procedure.steps[s].limits[l];
            if (!limit.is_of_places()) continue;
            const Node* node = find_in(item_of(find_in(item_of(steps, s), "limits"), l), limit.quantity);
            const auto span_of = [&](const char* key) {
                const Node* value = node ? node->find(key) : nullptr;
                return value ? value->span : TextSpan{};
            };
            const auto need = [&](const char* key, const std::string& id, const std::vector<std::string>& sort,
                                  const std::string& what) {
                if (contains(procedure.needs_landmarks, id) && !contains(sort, id))  // else it was refused already
                    report.error(text::Code::other_landmark, span_of(key),
                                 "The landmark `" + id + "` is no " + what + " of the anatomy; its landmarks" +
                                     " of this sort are " + listed(sort, id) + ". Name one of them.");
            };
            if (limit.quantity == "axes_angle") {
                need("of", limit.landmark, axes, "axis");
                need("to", limit.other, axes, "axis");
            } else if (limit.quantity == "tip_apex") {
                need("apex", limit.landmark, points, "point");
                need("neck", limit.other, axes, "axis");
            } else if (!anatomy.fracture) {
                refuse_whole_bone(node ? node->key_span : TextSpan{}, "the limit `" + limit.quantity + "`");
            }
        }
    if (anatomy.fracture) return;
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r) {
        const std::vector<Waypoint>& path = procedure.rehearsals[r].path;
        const auto displaced = std::find_if(path.begin(), path.end(), [](const Waypoint& w) { return w.is_displaced; });
        if (displaced == path.end()) continue;
        const std::vector<const Node*> nodes = waypoint_nodes(document, r);
        const auto index = static_cast<std::size_t>(displaced - path.begin());
        refuse_whole_bone(index < nodes.size() ? nodes[index]->span : TextSpan{}, "`displaced`");
    }
}

/// A piece that is held or moved must have come apart before: in an earlier step, or by an earlier goal of the same.
void check_pieces(const Procedure& procedure, const Document& document, Report& report) {
    const Node* steps = document.root.find("steps");
    for (std::size_t s = 0; s < procedure.steps.size(); ++s)
        for (std::size_t g = 0; g < procedure.steps[s].goals.size(); ++g) {
            const std::string& quantity = procedure.steps[s].goals[g].quantity;
            if (quantity == "separated") return;
            if (quantity != "held" && quantity != "moved") continue;
            const Node* goal = find_in(item_of(find_in(item_of(steps, s), "goals"), g), quantity);
            report.error(text::Code::needs_piece, goal ? goal->key_span : TextSpan{},
                         "The step " + quoted_id(procedure.steps[s].id) +
                             " takes a piece of a bone that is still whole: no step before it has the goal "
                             "`separated`. Add it to the step that parts the bone.");
            return;
        }
}

/// Checks that each step names an axis as its axis, and a plane as its plane.
void check_step_landmarks(const Procedure& procedure, const Anatomy& anatomy, const Document& document,
                          Report& report) {
    const std::vector<std::string> axes = ids_of(anatomy.axes), planes = ids_of(anatomy.planes);
    // A name that is not declared was refused when the procedure was read.
    const auto is_declared = [&](const std::string& name) { return contains(procedure.needs_landmarks, name); };
    const Node* steps = document.root.find("steps");
    for (std::size_t i = 0; i < procedure.steps.size(); ++i) {
        const std::string& axis = procedure.steps[i].axis;
        const std::string& plane = procedure.steps[i].plane;
        const Node* step = item_of(steps, i);
        const LandmarkAxis* found_axis = find_id(anatomy.axes, axis);
        if (const bool is_point = find_id(anatomy.points, axis) != nullptr;
            (is_point || contains(planes, axis)) && found_axis == nullptr && is_declared(axis))
            refuse_for_an_axis(span_or_none(find_in(step, "axis")), axis, is_point, anatomy, axes, report);
        const bool is_point = find_id(anatomy.points, plane) != nullptr;
        const LandmarkPlane* found_plane = find_id(anatomy.planes, plane);
        const bool is_known = is_point || found_plane != nullptr || contains(axes, plane);
        if (plane.empty() || !is_known || !is_declared(plane)) continue;
        const TextSpan span = span_or_none(find_in(step, "plane"));
        if (found_plane == nullptr) {
            const std::string meant = closest(plane, planes, report);
            report.error(text::Code::not_a_plane, span,
                         "The landmark " + quoted_id(plane) + " is of the wrong kind: got " +
                             (is_point ? "a point" : "an axis") + ", expected a plane." +
                             or_choose(meant, "Name a plane, or give the anatomy one."),
                         meant,
                         in_anatomy(anatomy, {"landmarks", is_point ? "points" : "axes", plane},
                                    is_point ? "it is a point here." : "it is an axis here."));
        } else if (found_axis != nullptr && !found_axis->fit) {
            check_lies_in(*found_axis, *found_plane, span, anatomy, report);
        }
    }
}

bool has_goal(const Step& step, const std::string& quantity) {
    return std::any_of(step.goals.begin(), step.goals.end(), [&](const Goal& g) { return g.quantity == quantity; });
}

/// Returns whether all of an axis lies behind a plane, farther than both tolerances.
bool is_behind(const LandmarkAxis& axis, const LandmarkPlane& plane) {
    const double in_front = std::max(dot(axis.from - plane.at, plane.normal), dot(axis.to - plane.at, plane.normal));
    return in_front < -(axis.tolerance + plane.tolerance);
}

void refuse_normal(const LandmarkPlane& plane, const Step& taking, const Node* step, const Anatomy& anatomy,
                   Report& report, text::Diagnostics& diagnostics) {
    std::string turned;
    for (const double part : {plane.normal.x, plane.normal.y, plane.normal.z}) {
        const double rounded = std::round(-part * 1e4) / 1e4;
        turned += (turned.empty() ? "" : " ") + text::quantity_text(rounded == 0.0 ? 0.0 : rounded, "");
    }
    text::Diagnostic wrong = text::error_at(
        in_anatomy(anatomy, {"landmarks", "planes", plane.id, "normal"}), code_text(text::Code::reversed_normal),
        "The normal of the plane " + quoted_id(plane.id) + " points into the bone that stays: the step " +
            quoted_id(taking.id) + " takes the piece behind the plane. Turn the normal around.");
    wrong.write = "normal: " + turned;
    wrong.reason = report.because(span_or_none(find_in(step, "axis")), "this axis leads into the piece that is taken.");
    diagnostics.push_back(std::move(wrong));
}

/// Reports planes of cuts whose normals point into the bone that stays. The cuts that bound a piece are those of the
/// instrument that parts the bone, since a piece was last taken.
void check_normals(const Procedure& procedure, const Anatomy& anatomy, const Document& document, Report& report,
                   text::Diagnostics& diagnostics) {
    std::vector<const Step*> cuts;  // since a piece was last taken
    std::vector<std::string> refused;
    const Node* steps = document.root.find("steps");
    for (std::size_t i = 0; i < procedure.steps.size(); ++i) {
        const Step& step = procedure.steps[i];
        if (!has_goal(step, "moved")) {
            cuts.push_back(&step);
            continue;
        }
        const LandmarkAxis* grip = find_id(anatomy.axes, step.axis);
        const auto parting =
            std::find_if(cuts.rbegin(), cuts.rend(), [](const Step* cut) { return has_goal(*cut, "separated"); });
        const bool is_known = grip != nullptr && !grip->fit && parting != cuts.rend();
        for (const Step* cut : is_known ? cuts : std::vector<const Step*>{}) {
            const LandmarkPlane* plane = find_id(anatomy.planes, cut->plane);
            if (plane == nullptr || cut->instrument != (*parting)->instrument || !is_behind(*grip, *plane) ||
                contains(refused, plane->id))
                continue;
            refused.push_back(plane->id);
            refuse_normal(*plane, step, item_of(steps, i), anatomy, report, diagnostics);
        }
        cuts.clear();
    }
}

/// Reports rehearsals that move towards a missing midline.
void check_midline(const Procedure& procedure, const Anatomy& anatomy, const Document& document, Report& report) {
    if (find_id(anatomy.points, midline) != nullptr) return;
    for (std::size_t i = 0; i < procedure.rehearsals.size(); ++i) {
        const std::vector<Waypoint>& path = procedure.rehearsals[i].path;
        const auto shifted = std::find_if(path.begin(), path.end(),
                                          [](const Waypoint& w) { return w.medial != 0.0 || w.medial_angle != 0.0; });
        if (shifted == path.end()) continue;
        const std::vector<const Node*> nodes = waypoint_nodes(document, i);
        const auto index = static_cast<std::size_t>(shifted - path.begin());
        report.error(
            text::Code::missing_midline, index < nodes.size() ? nodes[index]->span : TextSpan{},
            "The anatomy has no point `midline`, which the rehearsal moves towards. Add it there, or remove `" +
                std::string(shifted->medial != 0.0 ? "medial" : "medial_angle") + "`.",
            {}, in_anatomy(anatomy, {"landmarks", "points"}, "its landmarks are here."));
    }
}

}  // namespace

void check_names(const Procedure& procedure, const Anatomy& anatomy, bool is_sound, text::Diagnostics& diagnostics) {
    const auto document = document_of(procedure);
    Report report(*document, diagnostics);
    const Node* needs = document->root.find("needs");
    const auto list = [&](const char* key) { return needs ? needs->find(key) : nullptr; };
    std::vector<std::string> landmarks = ids_of(anatomy.axes);
    append_ids(anatomy.points, landmarks);
    append_ids(anatomy.planes, landmarks);
    if (is_sound || !landmarks.empty())
        check_list(procedure.needs_landmarks, landmarks, list("landmarks"), text::Code::missing_landmark, "landmark",
                   anatomy, report, diagnostics);
    // Of an anatomy with errors the zones may be under a key that is refused.
    if (is_sound || !anatomy.zones.empty())
        check_list(procedure.needs_zones, ids_of(anatomy.zones), list("zones"), text::Code::missing_zone, "zone",
                   anatomy, report, diagnostics);
    if (is_sound || !anatomy.tissues.empty())
        check_list(procedure.needs_tissues, ids_of(anatomy.tissues), list("tissues"), text::Code::missing_tissue,
                   "tissue", anatomy, report, diagnostics);
}

void check_axes_in_planes(const Procedure& procedure, const Anatomy& anatomy, text::Diagnostics& diagnostics) {
    const auto document = document_of(procedure);
    Report report(*document, diagnostics);
    const Node* steps = document->root.find("steps");
    for (std::size_t i = 0; i < procedure.steps.size(); ++i) {
        const Step& step = procedure.steps[i];
        const LandmarkAxis* axis = find_id(anatomy.axes, step.axis);
        const LandmarkPlane* plane = find_id(anatomy.planes, step.plane);
        if (axis == nullptr || plane == nullptr) continue;
        check_lies_in(*axis, *plane, span_or_none(find_in(item_of(steps, i), "plane")), anatomy, report);
    }
}

void check_needs(const Procedure& procedure, const Anatomy& anatomy, text::Diagnostics& diagnostics) {
    check_names(procedure, anatomy, true, diagnostics);
    const auto read = document_of(procedure);
    const Document& document = *read;
    Report report(document, diagnostics);
    check_step_landmarks(procedure, anatomy, document, report);
    check_planned_implants(procedure, anatomy, document, report);
    check_planes(procedure, document, report);
    if (!anatomy.fracture) check_pieces(procedure, document, report);
    check_places(procedure, anatomy, ids_of(anatomy.axes), ids_of(anatomy.points), document, report);
    check_sorts(procedure.constructions, procedure.measures, anatomy, document, report);
    check_midline(procedure, anatomy, document, report);
    if (!anatomy.fracture) check_normals(procedure, anatomy, document, report, diagnostics);
}

}  // namespace kerf::documents
