// SPDX-License-Identifier: Apache-2.0
#include "run/plate.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "documents/read_procedure.h"
#include "documents/solids.h"
#include "documents/waypoint_nodes.h"
#include "documents/yaml/document.h"
#include "run/in_mm.h"
#include "text/codes.h"
#include "text/quantity.h"

namespace kerf::run {

// ---- bone of several bodies ------------------------------------------------------------------------------------

BoneAround::BoneAround(const Simulation& simulation) {
    const PresentBone& present = simulation.present();
    for (std::size_t b = 0; b < simulation.bodies().size(); ++b) {
        const LiveBody& body = *simulation.bodies()[b];
        if (body.is_cuttable && body.is_present)
            parts_.push_back({present.piece(b).bone, &present.cut(b), inverse(body.world_from_body)});
    }
}

double BoneAround::distance(Vec3 point_in_world) const noexcept {
    double nearest = HUGE_VAL;
    for (const Part& part : parts_) {
        const LocatedPoint place = locate(*part.bone, part.bone_from_world * point_in_world);
        const double there = uncut_distance(*part.bone, place);
        nearest = std::min(nearest, part.cut != nullptr ? std::max(there, part.cut->at(place)) : there);
    }
    return nearest;
}

double BoneAround::uncut(Vec3 point_in_world) const noexcept {
    double nearest = HUGE_VAL;
    for (const Part& part : parts_)
        nearest =
            std::min(nearest, uncut_distance(*part.bone, locate(*part.bone, part.bone_from_world * point_in_world)));
    return nearest;
}

double BoneAround::clamp() const noexcept { return clamp_voxels * spacing(); }

double BoneAround::spacing() const noexcept {
    double finest = HUGE_VAL;
    for (const Part& part : parts_) finest = std::min(finest, part.bone->grid().spacing);
    return finest;
}

// ---- fit of a plate on bone -------------------------------------------------------------------------------------

namespace {

/// A point of a plate.
struct PlatePoint {
    Vec3 at;          ///< world frame [m]
    double to_metal;  ///< [m], negative inside
    double to_bone;   ///< [m], negative inside, clamped
};

/// Lattice points in and near a plate. Their weights are ramps one step wide, so that a coarse lattice is nearly as
/// accurate.
struct PlateSamples {
    double step = 0.0;
    std::vector<PlatePoint> points;
};

PlateSamples samples_of(const Body& plate, const Pose& world_from_plate, const BoneAround& bone) {
    constexpr double max_points = 4e5;
    const Grid& grid = plate.grid();
    const Vec3 size = grid.spacing * Vec3{static_cast<double>(grid.samples(0)), static_cast<double>(grid.samples(1)),
                                          static_cast<double>(grid.samples(2))};
    PlateSamples samples{grid.spacing, {}};
    while (size.x * size.y * size.z > max_points * samples.step * samples.step * samples.step) samples.step *= 1.25;
    const auto count = [&](double extent) { return static_cast<int>(extent / samples.step); };
    for (int k = 0; k <= count(size.z); ++k)
        for (int j = 0; j <= count(size.y); ++j)
            for (int i = 0; i <= count(size.x); ++i) {
                const Vec3 at = grid.origin + samples.step * Vec3{static_cast<double>(i), static_cast<double>(j),
                                                                  static_cast<double>(k)};
                const double to_metal = uncut_distance(plate, locate(plate, at));
                if (to_metal >= samples.step) continue;
                const Vec3 in_world = world_from_plate * at;
                samples.points.push_back({in_world, to_metal, bone.distance(in_world)});
            }
    return samples;
}

/// Returns lattice offsets within `reach` of a point, the nearest first.
std::vector<Vec3> offsets_within(double reach, double step) {
    std::vector<Vec3> offsets;
    const int most = static_cast<int>(std::ceil(reach / step));
    for (int k = -most; k <= most; ++k)
        for (int j = -most; j <= most; ++j)
            for (int i = -most; i <= most; ++i)
                if (const Vec3 o = step * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
                    length(o) <= reach)
                    offsets.push_back(o);
    std::stable_sort(offsets.begin(), offsets.end(), [](Vec3 a, Vec3 b) { return dot(a, a) < dot(b, b); });
    return offsets;
}

/// Returns the distance from a point to the surface of bone [m], also beyond the clamp of the bone's field; at most
/// `limit`. The shortest segment to the surface crosses the band of known distances.
double to_surface(Vec3 at, const BoneAround& bone, const std::vector<Vec3>& offsets, double limit) {
    const double known = 0.99 * bone.clamp();
    double nearest = limit;
    for (const Vec3 offset : offsets) {
        const double away = length(offset);
        if (away >= nearest) break;
        const double there = std::abs(bone.distance(at + offset));
        if (there < known) nearest = std::min(nearest, away + there);
    }
    return nearest;
}

/// Returns every n-th of the kept points, at most `most`.
template <class Keep>
std::vector<PlatePoint> some_of(const std::vector<PlatePoint>& points, std::size_t most, Keep&& keep) {
    std::vector<PlatePoint> kept, some;
    std::copy_if(points.begin(), points.end(), std::back_inserter(kept), keep);
    const std::size_t every = kept.size() / most + 1;
    for (std::size_t i = 0; i < kept.size(); i += every) some.push_back(kept[i]);
    return some;
}

}  // namespace

PlateFit fit_of(const Body& plate, const Pose& world_from_plate, const BoneAround& bone) {
    constexpr std::size_t max_searches = 3000;
    const PlateSamples samples = samples_of(plate, world_from_plate, bone);
    const double known = 0.99 * bone.clamp();
    const auto inside = [&](double distance) { return std::clamp(0.5 - distance / samples.step, 0.0, 1.0); };
    PlateFit fit{.gap = farthest_gap, .fraction_in_bone = 0.0, .deepest = 0.0};
    double metal = 0.0, in_bone = 0.0;
    for (const PlatePoint& point : samples.points) {
        metal += inside(point.to_metal);
        in_bone += std::max(0.0, inside(point.to_metal) + inside(point.to_bone) - 1.0);  // zero for touching faces
        if (point.to_bone < known) fit.gap = std::min(fit.gap, std::max(0.0, point.to_metal + point.to_bone));
        fit.deepest = std::max(fit.deepest, -point.to_bone - std::max(0.0, point.to_metal));
    }
    fit.fraction_in_bone = metal > 0.0 ? in_bone / metal : 0.0;

    const std::vector<Vec3> offsets = offsets_within(farthest_gap, std::min(1e-3, bone.clamp()));
    if (fit.gap >= known)  // beyond the clamp of the bone's field
        for (const PlatePoint& point : some_of(samples.points, max_searches, [&](const PlatePoint& p) {
                 return std::abs(p.to_metal) < 0.5 * samples.step;
             }))
            fit.gap = std::max(0.0, to_surface(point.at, bone, offsets, fit.gap - point.to_metal) + point.to_metal);
    for (const PlatePoint& point :
         some_of(samples.points, max_searches, [&](const PlatePoint& p) { return p.to_bone <= -known; }))
        fit.deepest =
            std::max(fit.deepest, to_surface(point.at, bone, offsets, farthest_gap) - std::max(0.0, point.to_metal));
    return fit;
}

namespace {

std::string in_tenths(double length) { return in_mm(length, 1); }
std::string in_percent(double fraction, int digits = 0) {
    const double step = std::pow(10.0, -digits);
    return text::quantity_text(0.01 * (std::round(100.0 * fraction / step) * step), "%");
}

bool is_off_bone(const PlateFit& fit) { return fit.gap > max_plate_gap; }
bool is_in_bone(const PlateFit& fit) {
    return fit.fraction_in_bone > max_plate_fraction || fit.deepest > max_plate_depth;
}

std::string gap_text(const PlateFit& fit) {
    const text::ComparedTexts shown = compared_in_mm(fit.gap, max_plate_gap, 1);
    return "its surface is " + shown.value + (fit.gap < farthest_gap ? "" : " or more") +
           " from the nearest bone, must be at most " + shown.bound;
}
std::string depth_text(const PlateFit& fit) {
    std::string text;
    if (fit.fraction_in_bone > max_plate_fraction) {
        const text::ComparedTexts shown =
            text::compared(fit.fraction_in_bone, max_plate_fraction, 0, 6,
                           [](double fraction, int digits) { return in_percent(fraction, digits); });
        text = shown.value + " of its volume is in bone, must be at most " + shown.bound;
    }
    if (fit.deepest > max_plate_depth) {
        const text::ComparedTexts shown = compared_in_mm(fit.deepest, max_plate_depth, 1);
        text += (text.empty() ? "it is " : "; it is ") + shown.value + (fit.deepest < farthest_gap ? "" : " or more") +
                " deep, must be at most " + shown.bound;
    }
    return text;
}

/// Returns the span of the last existing key of this path in an implant.
documents::TextSpan span_of(const documents::Document& document, const std::vector<std::string>& keys) {
    const documents::Node* node = document.root.find("implants");
    documents::TextSpan span;
    for (const std::string& key : keys) {
        node = node != nullptr ? node->find(key) : nullptr;
        if (node != nullptr) span = node->key_span;
    }
    return span;
}

}  // namespace

std::string misfit(const PlateFit& fit) {
    if (is_off_bone(fit)) return "it meets no bone: " + gap_text(fit);
    return is_in_bone(fit) ? "it lies through bone: " + depth_text(fit) : "";
}

void check_plate(const documents::Procedure& procedure, const documents::Implant& implant, const PlateFit& fit,
                 text::Diagnostics& diagnostics) {
    if (misfit(fit).empty()) return;
    const auto document = documents::document_of(procedure);
    const std::string planned = "The planned pose of `" + implant.id + "` ";
    const documents::TextSpan place = span_of(*document, {implant.id, "place"});
    documents::Report report(*document, diagnostics);
    if (is_off_bone(fit))
        report.error(text::Code::plate_off_bone, place,
                     planned + "meets no bone: " + gap_text(fit) +
                         ". Choose another `axis:`, or move its solids so that they reach z = 0, where the axis meets "
                         "bone.");
    else
        report.error(text::Code::plate_in_bone, place,
                     planned + "lies through bone: " + depth_text(fit) +
                         ". Turn it with `up:`, choose another `axis:`, or move its solids to z below 0 mm, which is "
                         "outside.");
}

// ---- holes and screws ---------------------------------------------------------------------------------------------

std::vector<documents::HoleInMetal> check_holes(const documents::Procedure& procedure,
                                                const documents::Implant& implant,
                                                const std::function<double(Vec3)>& distance,
                                                text::Diagnostics& diagnostics) {
    std::vector<documents::HoleInMetal> found;
    if (implant.holes.empty()) return found;
    const auto document = documents::document_of(procedure);
    documents::Report report(*document, diagnostics);
    for (const documents::ImplantHole& hole : implant.holes) {
        const documents::HoleInMetal& metal = found.emplace_back(documents::hole_in_metal(hole, distance));
        const documents::TextSpan span = span_of(*document, {implant.id, "holes", hole.id});
        const std::string name = "The hole `" + hole.id + "` of `" + implant.id + "` ";
        if (metal.blocked) {
            const auto mm = [](double v) { return text::quantity_text(std::round(v / 0.1e-3) * 0.1e-3, "mm"); };
            const Vec3 at = *metal.blocked;
            report.error(
                text::Code::closed_plate_hole, span,
                name + "is closed: there is metal at " + mm(at.x) + ", " + mm(at.y) + ", " + mm(at.z) +
                    ", expected none within " + in_tenths(0.9 * 0.5 * hole.diameter) +
                    " of its axis. Subtract a part along it, or correct the hole.",
                "{id: …, tube: {from: …, to: …, radius: " + in_tenths(0.5 * hole.diameter) + "}, subtract: true}");
        } else if (!metal.has_metal()) {
            report.error(text::Code::closed_plate_hole, span,
                         name + "is beside the metal: nowhere on its axis is there metal around it, at a distance of " +
                             in_tenths(0.6 * hole.diameter) +
                             ". Move `from` and `to` into the metal, or write the "
                             "diameter of the hole that is there.");
        }
    }
    return found;
}

void check_holes_of_parts(const documents::Procedure& procedure, text::Diagnostics& diagnostics) {
    for (const documents::Implant& implant : procedure.implants)
        if (implant.is_made_of_parts())
            (void)check_holes(
                procedure, implant, [&](Vec3 p) { return distance_to(implant.solids, p); }, diagnostics);
}

std::optional<documents::NamedHole> hole_of_step(const documents::Procedure& procedure, const documents::Step& step) {
    const std::vector<std::string>& landmarks = procedure.needs_landmarks;
    if (std::find(landmarks.begin(), landmarks.end(), step.axis) != landmarks.end()) return std::nullopt;
    const auto named = documents::named_hole(step.axis, procedure.implants);
    return named && named->hole != nullptr ? named : std::nullopt;
}

void check_screws_of_plates(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                            text::Diagnostics& diagnostics) {
    const auto document = documents::document_of(procedure);
    const documents::Node* steps = document->root.find("steps");
    documents::Report report(*document, diagnostics);
    for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
        const documents::Step& step = procedure.steps[s];
        const ToolOutline& tool = *tools[s];
        const auto named = hole_of_step(procedure, step);
        if (!named || !tool.has_thread() || !tool.is_implant()) continue;
        const documents::Node* item = steps != nullptr && s < steps->children.size() ? &steps->children[s] : nullptr;
        const documents::Node* written = item != nullptr ? item->find("instrument") : nullptr;
        const documents::TextSpan span = written != nullptr ? written->span : documents::TextSpan{};
        const auto here = std::optional(report.because(
            span_of(*document, {named->implant->id, "holes", named->name, "diameter"}), "the hole is here."));
        const double hole = named->hole->diameter, thread = 2.0 * tool.thread_radius;
        double head = 0.0;
        for (std::size_t i = tool.cutting_count; i < tool.stay_count; ++i)
            head = std::max(head, 2.0 * tool.profile[i].radius);
        if (thread > hole)
            report.error(text::Code::narrow_plate_hole, span,
                         "The thread of `" + step.instrument + "` is " + in_mm(thread) + " wide, and the hole `" +
                             step.axis + "` " + in_mm(hole) + ": it does not go through. Take a screw of at most " +
                             in_mm(hole) + ", or another hole.",
                         {}, here);
        else if (head <= hole)
            report.error(text::Code::wide_plate_hole, span,
                         "`" + step.instrument + "` would fall through the hole `" + step.axis + "`: its head is " +
                             (head > 0.0 ? in_mm(head) + " wide" : std::string("missing")) + ", and the hole is " +
                             in_mm(hole) + " wide. Take a screw with a wider head, or another hole.",
                         {}, here);
    }
}

void check_plates_are_placed(const documents::Procedure& procedure, text::Diagnostics& diagnostics) {
    const auto document = documents::document_of(procedure);
    documents::Report report(*document, diagnostics);
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r) {
        if (procedure.rehearsals[r].expect != "pass") continue;
        const std::vector<documents::Waypoint>& path = procedure.rehearsals[r].path;
        std::vector<std::string> placed;
        for (std::size_t w = 0; w < path.size(); ++w) {
            const auto named = hole_of_step(procedure, procedure.steps[path[w].step]);
            if (named && path[w].depth > 0.0 &&
                std::find(placed.begin(), placed.end(), named->implant->id) == placed.end()) {
                const std::vector<const documents::Node*> nodes = documents::waypoint_nodes(*document, r);
                report.error(text::Code::missing_plate, w < nodes.size() ? nodes[w]->span : documents::TextSpan{},
                             "The rehearsal works on a hole of `" + named->implant->id +
                                 "`, which is not in the scene yet. Add `place: " + named->implant->id +
                                 "` to a waypoint before this one.");
                break;
            }
            for (const documents::HandInput& input : path[w].inputs)
                if (input.kind == documents::HandInput::Kind::place || input.kind == documents::HandInput::Kind::insert)
                    placed.push_back(input.id);
        }
    }
}

AxisFrame frame_of(const StepHole& hole, const Pose& world_from_implant, const BoneAround& bone,
                   const documents::Anatomy& anatomy, const documents::LandmarkPlane* plane) {
    const documents::LandmarkAxis axis = documents::axis_of(hole.hole, world_from_implant, {});
    const Vec3 along = normalized(axis.to - axis.from);
    const double step = 0.1 * bone.spacing();
    const int steps = static_cast<int>(length(axis.to - axis.from) / step);
    double entry = hole.metal.middle();
    for (int i = 0; i <= steps; ++i)
        if (bone.uncut(axis.from + i * step * along) < 0.0) {
            entry = i * step;
            break;
        }
    AxisFrame frame = axis_frame(axis, entry, anatomy, plane);
    frame.plate = hole.metal.middle() - entry;
    return frame;
}

}  // namespace kerf::run
