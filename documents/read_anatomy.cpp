// SPDX-License-Identifier: Apache-2.0
#include "documents/read_anatomy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "documents/fit_references.h"
#include "documents/shapes.h"
#include "documents/yaml/correct_keys.h"
#include "documents/yaml/read_map.h"
#include "kerf/abi.h"
#include "text/printable.h"

namespace kerf {
namespace {

constexpr double shortest = 1e-6;  // [m] a length below it has no direction

/// The two ends of a tube or an axis; reports when they coincide.
template <class Ends>
void read_ends(MapReader& map, Ends& ends, const std::string& name, Report& report) {
    const auto from = map.vector("from");
    const auto to = map.vector("to");
    if (!from || !to) return;
    ends.from = *from;
    ends.to = *to;
    if (length(*to - *from) < shortest)
        report.error(Code::degenerate, map.span(),
                     name + " has no length: both ends are the same point. Move one of them.");
}

Solid read_box(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, shapes::box, name, report);
    BoxSolid box;
    box.centre = map.vector("centre").value_or(Vec3{});
    box.size = map.vector("size").value_or(Vec3{});
    map.finish();
    return box;
}

Solid read_tube(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, shapes::tube, name, report);
    TubeSolid tube;
    read_ends(map, tube, name, report);
    tube.radius = map.quantity("radius");
    map.finish();
    return tube;
}

Solid read_elliptic_tube(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, shapes::elliptic_tube, name, report);
    EllipticTubeSolid tube;
    read_ends(map, tube, name, report);
    tube.width = map.quantity("width");
    tube.height = map.quantity("height");
    if (const Node* up = map.find("up")) {
        tube.up = read_vector(*up, map.name_of("up"), map.need_of("up"), report).value_or(tube.up);
        const Vec3 along = normalized(tube.to - tube.from);
        if (length(cross(along, normalized(tube.up))) < 1e-3 && length(along) > 0.0)
            report.error(Code::degenerate, up->span,
                         map.name_of("up") + " points along the tube, expected across it. Turn it.");
    }
    map.finish();
    return tube;
}

Solid read_sphere(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, shapes::sphere, name, report);
    SphereSolid sphere;
    sphere.centre = map.vector("centre").value_or(Vec3{});
    sphere.radius = map.quantity("radius");
    map.finish();
    return sphere;
}

Solid read_solid(const Node& node, const std::string& name, Report& report) {
    if (node.key == "box") return read_box(node, name, report);
    if (node.key == "tube") return read_tube(node, name, report);
    if (node.key == "sphere") return read_sphere(node, name, report);
    return read_elliptic_tube(node, name, report);
}

/// The one solid that a map names by its key.
Solid read_solid(MapReader& map, Report& report) {
    const Node* node = map.one_of();
    return node ? read_solid(*node, map.name_of(node->key), report) : BoxSolid{};
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

std::string read_data_path(const Node* node, const std::string& name, Report& report) {
    return node ? read_path(*node, name, "the document's own folder or KERF_DATA", report) : std::string();
}

DensityLine read_density_line(const Node& node, Report& report) {
    MapReader map(node, shapes::density_line, "ct.density", report);
    DensityLine line;
    line.at_zero = map.quantity("at_zero");
    line.per_unit = map.quantity("per_unit");
    line.floor = map.quantity("floor");
    line.source = map.text("source");
    map.finish();
    return line;
}

CtSource read_ct(const Node& node, Report& report) {
    MapReader map(node, shapes::ct, "ct", report);
    CtSource ct;
    ct.image = read_data_path(map.find("image"), "ct.image", report);
    ct.series = map.text("series");
    ct.acquisition = map.text("acquisition");
    ct.may_resample = map.yes_no("resample");
    if (map.word("intensity") == "grey") ct.intensity = CtSource::Intensity::grey;
    if (const Node* found = map.find("labels")) {
        MapReader labels(*found, shapes::labels, "ct.labels", report);
        ct.labels = read_data_path(labels.find("file"), "ct.labels.file", report);
        labels.labels("keep", ct.keep, ct.keep_named);
        labels.finish();
    }
    if (const Node* found = map.find("keep")) {
        MapReader keep(*found, shapes::kept_piece, "ct.keep", report);
        ct.component_at = keep.id("component_at");
        keep.finish();
    }
    ct.threshold = map.quantity("threshold");
    map.quantity("closing", ct.closing);
    ct.fill = map.yes_no("fill");
    if (const Node* density = map.find("density")) ct.density = read_density_line(*density, report);
    ct.source = map.text("source");
    map.finish();
    return ct;
}

void read_repair(const Node& node, MeshSource& mesh, Report& report) {
    MapReader map(node, shapes::repair, "mesh.repair", report);
    map.quantity("holes_up_to", mesh.holes_up_to);
    map.quantity("pieces_under", mesh.pieces_under);
    if (const std::string inner = map.word("inner"); !inner.empty())
        mesh.inner = inner == "hollow" ? InnerPieces::hollow : InnerPieces::solid;
    map.finish();
}

/// `has_density_line`: the density of the base comes from the CT.
std::vector<Tissue> read_tissues(const Node& node, bool has_density_line, Report& report) {
    std::vector<Tissue> tissues;
    UniqueIds ids;
    const std::vector<Node>& items = read_list(node, "tissues", report);
    if (items.size() > KERF_MAX_TISSUES)
        report.error(Code::out_of_range, items[KERF_MAX_TISSUES].span,
                     "There are too many tissues: got " + std::to_string(items.size()) + ", expected at most " +
                         std::to_string(KERF_MAX_TISSUES) + ". Remove some.");
    for (const Node& item : items) {
        MapReader map(item, shapes::tissue, item_name(item, "tissue"), report);
        Tissue tissue;
        tissue.id = map.id("id");
        if (const Node* id = item.find("id"); id != nullptr && !tissue.id.empty()) ids.add(tissue.id, id->span, report);
        const bool is_base = &item == &items.back();
        const bool has_own_density = !(is_base && has_density_line);
        const Node* density = has_own_density ? map.required("density") : map.find("density");
        if (has_own_density)
            map.quantity("density", tissue.density);
        else if (density)
            report.error(Code::degenerate, density->key_span,
                         "The last tissue has two densities: this one and `ct.density`. Remove one.");
        const Node* solids = map.find("solids");
        const Node* thickness = is_base || solids ? map.find("thickness") : map.required("thickness");
        if (thickness && !is_base) map.quantity("thickness", tissue.thickness);
        if (solids && !is_base) tissue.solids = read_solids(*solids, map.name_of("solids"), report);
        if (is_base)
            for (const Node* own : {thickness, solids})
                if (own)
                    report.error(Code::degenerate, own->key_span,
                                 "The last tissue has " + (own == solids ? std::string("solids") : "a thickness") +
                                     ", but it fills all that the others leave. Remove it.");
        tissue.source = map.text("source");
        map.finish();
        tissues.push_back(std::move(tissue));
    }
    return tissues;
}

/// The children of a map whose keys are ids that the author chose.
const std::vector<Node>& read_named(const Node* node, const std::string& name, UniqueIds& ids, Report& report) {
    static const std::vector<Node> none;
    if (!node || !is_kind(*node, Node::Kind::map, name, report)) return none;
    for (const Node& child : node->children) {
        Node key;
        key.text = child.key;
        key.span = child.key_span;
        if (read_id(key, "A name in " + name, report)) ids.add(child.key, child.key_span, report);
    }
    return node->children;
}

std::vector<MarkupsFile> read_markups(const Node& node, Report& report) {
    std::vector<MarkupsFile> files;
    for (const Node& item : read_list(node, "landmarks.markups", report)) {
        MapReader map(item, shapes::markups, "markups", report);
        MarkupsFile markups;
        markups.file = read_data_path(map.find("file"), "markups.file", report);
        markups.tolerance = map.quantity("tolerance");
        if (const Node* names = map.find("names"))
            for (const Node& one : read_list(*names, "markups.names", report)) {
                MapReader name(one, shapes::markup_name, "markups.names", report);
                const std::string label = name.text("label"), id = name.id("id");
                if (!markups.names.emplace(label, id).second)
                    report.error(Code::duplicate_id, one.span,
                                 "The label " + yaml_quoted(label) + " occurs twice under `names`. Remove one.");
                name.finish();
            }
        map.finish();
        files.push_back(std::move(markups));
    }
    return files;
}

/// Unit; one without length is refused.
Vec3 read_direction(MapReader& map, const std::string& key, Report& report) {
    const Vec3 direction = map.vector(key).value_or(Vec3{0, 0, 1});
    if (length(direction) > 1e-6) return normalized(direction);
    report.error(Code::degenerate, map.span(),
                 map.name_of(key) + " has no length. Give it a direction, as in `0 0 1`.");
    return {0, 0, 1};
}

struct FitKind {
    const char* key;
    LandmarkFit::Shape shape;
    const Shape& values;
    const char* reference;  ///< key of the landmark that it refers to; null: none
};
const std::array<FitKind, 4> fit_kinds{{{"sphere", LandmarkFit::Shape::sphere, shapes::sphere_fit, nullptr},
                                        {"tube", LandmarkFit::Shape::tube, shapes::tube_fit, nullptr},
                                        {"neck", LandmarkFit::Shape::neck, shapes::neck_fit, "head"},
                                        {"condyles", LandmarkFit::Shape::condyles, shapes::condyles_fit, "shaft"}}};

std::optional<LandmarkFit> read_fit(MapReader& landmark, const Shape& shape, Report& report) {
    const Node* node = landmark.find("fit");
    if (!node) return std::nullopt;
    MapReader map(*node, shape, landmark.name_of("fit"), report);
    LandmarkFit fit;
    if (const Node* found = map.one_of()) {
        const FitKind& kind = *std::find_if(fit_kinds.begin(), fit_kinds.end(),
                                            [&](const FitKind& one) { return found->key == one.key; });
        fit.shape = kind.shape;
        MapReader values(*found, kind.values, map.name_of(found->key), report);
        if (kind.reference != nullptr)
            fit.reference = values.id(kind.reference);
        else
            fit.radius = values.quantity("radius");
        values.quantity("within", fit.within);
        values.finish();
    }
    if (const Node* residual = map.find("residual")) {
        MapReader bound(*residual, shapes::fit_residual, map.name_of("residual"), report);
        fit.residual = bound.quantity("at_most");
        bound.finish();
    }
    map.finish();
    return fit;
}

void read_landmarks(const Node& node, Anatomy& anatomy, Report& report) {
    MapReader map(node, shapes::landmarks, "landmarks", report);
    UniqueIds ids;  // a step names a landmark without saying of which sort
    for (const Node& item : read_named(map.find("points"), "landmarks.points", ids, report)) {
        MapReader point(item, shapes::point, item.key, report);
        LandmarkPoint landmark;
        landmark.id = item.key;
        landmark.at = point.vector("at").value_or(Vec3{});
        landmark.tolerance = point.quantity("tolerance");
        if (const std::string lies = point.word("lies"); !lies.empty())
            landmark.lies = lies == "on_bone"   ? LandmarkPoint::Lies::on_bone
                            : lies == "in_bone" ? LandmarkPoint::Lies::in_bone
                                                : LandmarkPoint::Lies::off_bone;
        landmark.fit = read_fit(point, shapes::point_fit, report);
        point.finish();
        anatomy.points.push_back(std::move(landmark));
    }
    for (const Node& item : read_named(map.find("axes"), "landmarks.axes", ids, report)) {
        MapReader axis(item, shapes::axis, item.key, report);
        LandmarkAxis landmark;
        landmark.id = item.key;
        read_ends(axis, landmark, item.key, report);
        landmark.tolerance = axis.quantity("tolerance");
        landmark.fit = read_fit(axis, shapes::axis_fit, report);
        axis.finish();
        anatomy.axes.push_back(std::move(landmark));
    }
    for (const Node& item : read_named(map.find("planes"), "landmarks.planes", ids, report)) {
        MapReader plane(item, shapes::plane, item.key, report);
        LandmarkPlane landmark;
        landmark.id = item.key;
        landmark.at = plane.vector("at").value_or(Vec3{});
        landmark.normal = read_direction(plane, "normal", report);
        landmark.tolerance = plane.quantity("tolerance");
        plane.finish();
        anatomy.planes.push_back(std::move(landmark));
    }
    if (const Node* files = map.find("markups")) anatomy.markups = read_markups(*files, report);
    map.finish();
}

/// Adds the solids of the tissue that `name` names.
void add_solids_of(const Node& name, const std::vector<Tissue>& tissues, Zone& zone, Report& report) {
    const std::optional<std::string> id = read_id(name, "tissue", report);
    if (!id) return;
    std::vector<std::string> known;
    for (const Tissue& tissue : tissues) {
        if (!tissue.solids.empty()) known.push_back(tissue.id);
        if (tissue.solids.empty() || tissue.id != *id) continue;
        zone.solids.insert(zone.solids.end(), tissue.solids.begin(), tissue.solids.end());
        zone.is_tissue = true;
        return;
    }
    report.error(Code::unknown_word, name.span,
                 "No tissue `" + *id + "` has solids; " +
                     (known.empty() ? "no tissue of this anatomy has any. Give it `solids:`, or write solids here."
                                    : "known are " + listed(known) + "." + or_choose(closest(*id, known, report))));
}

std::vector<Zone> read_zones(const Node& node, const std::vector<Tissue>& tissues, Report& report) {
    std::vector<Zone> zones;
    UniqueIds ids;
    for (const Node& item : read_named(&node, "zones", ids, report)) {
        Zone zone;
        zone.id = item.key;
        for (const Node& solid : read_list(item, item.key, report)) {
            MapReader map(solid, shapes::zone_solid, item.key, report);
            const Node* found = map.one_of();
            if (found && found->key == "tissue")
                add_solids_of(*found, tissues, zone, report);
            else if (found)
                zone.solids.push_back(read_solid(*found, map.name_of(found->key), report));
            map.finish();
        }
        zones.push_back(std::move(zone));
    }
    return zones;
}

Fracture read_fracture(const Node& node, Report& report) {
    MapReader map(node, shapes::fracture, "fracture", report);
    Fracture fracture;
    fracture.at = map.vector("at").value_or(Vec3{});
    fracture.normal = read_direction(map, "normal", report);
    map.quantity("gap", fracture.gap);
    fracture.shift = map.vector("shift").value_or(Vec3{});
    if (const Node* turn = map.find("turn")) {
        MapReader turned(*turn, shapes::fracture_turn, "fracture.turn", report);
        fracture.turn = turned.quantity("by");
        fracture.about = read_direction(turned, "about", report);
        turned.finish();
    }
    map.finish();
    return fracture;
}

}  // namespace

namespace {

std::optional<AnatomyDraft> draft_of_text(const std::string& file, std::string text, Diagnostics& diagnostics) {
    Diagnostics found;
    std::optional<AnatomyDraft> draft;
    if (std::optional<Document> document = parse_document(file, std::move(text), found)) {
        Report report(*document, found);
        const Node* kind = document->root.find("kind");
        if (kind == nullptr || kind->text == "Anatomy") correct_keys(document->root, shapes::anatomy, report);
        MapReader map(document->root, shapes::anatomy, "", report);
        if (read_header(map, "Anatomy", report)) {
            draft.emplace();
            Anatomy* anatomy = &draft->anatomy;
            anatomy->file = file;
            anatomy->text = document->text();
            if (const Node* node = map.find("metadata")) {
                MapReader metadata(*node, shapes::anatomy_metadata, "metadata", report);
                anatomy->id = metadata.id("id");
                anatomy->title = metadata.text("title");
                metadata.finish();
            }
            map.one_of();
            if (const Node* ct = map.find("ct")) anatomy->ct = read_ct(*ct, report);
            if (const Node* mesh = map.find("mesh")) anatomy->mesh = read_mesh(*mesh, "mesh", report);
            if (const Node* node = map.find("phantom")) {
                MapReader phantom(*node, shapes::phantom, "phantom", report);
                if (const Node* parts = phantom.find("parts"))
                    anatomy->phantom.parts = read_parts(*parts, "phantom.parts", report);
                phantom.finish();
            }
            if (const Node* node = map.find("tissues"))
                anatomy->tissues = read_tissues(*node, anatomy->ct && anatomy->ct->density, report);
            if (const Node* node = map.find("landmarks")) read_landmarks(*node, *anatomy, report);
            if (const Node* node = map.find("zones")) anatomy->zones = read_zones(*node, anatomy->tissues, report);
            if (const Node* node = map.find("fracture")) anatomy->fracture = read_fracture(*node, report);
            map.finish();
            check_fit_references(document->root, *anatomy, report);
            draft->is_sound = !has_error(found);
        }
    }
    diagnostics.insert(diagnostics.end(), found.begin(), found.end());
    return draft;
}

std::optional<Anatomy> sound(std::optional<AnatomyDraft> draft) {
    return draft && draft->is_sound ? std::optional(std::move(draft->anatomy)) : std::nullopt;
}

}  // namespace

std::optional<AnatomyDraft> read_anatomy_draft(const std::string& file, Diagnostics& diagnostics) {
    std::optional<std::string> text = read_text_file(file, diagnostics);
    return text ? draft_of_text(file, std::move(*text), diagnostics) : std::nullopt;
}

std::optional<Anatomy> read_anatomy(const std::string& file, Diagnostics& diagnostics) {
    return sound(read_anatomy_draft(file, diagnostics));
}

std::optional<Anatomy> read_anatomy_text(const std::string& file, std::string text, Diagnostics& diagnostics) {
    return sound(draft_of_text(file, std::move(text), diagnostics));
}

std::vector<PhantomPart> read_parts(const Node& node, const std::string& where, Report& report) {
    std::vector<PhantomPart> parts;
    UniqueIds ids;
    for (const Node& item : read_list(node, where, report)) {
        MapReader map(item, shapes::part, item_name(item, "part"), report);
        PhantomPart part;
        part.id = map.id("id");
        if (const Node* id = item.find("id"); id != nullptr && !part.id.empty()) ids.add(part.id, id->span, report);
        part.solid = read_solid(map, report);
        part.source = map.text("source");
        if (const Node* subtract = map.find("subtract")) {
            part.subtract = read_yes_no(*subtract, "subtract", report).value_or(false);
            if (part.subtract && parts.empty())
                report.error(
                    Code::degenerate, subtract->span,
                    "The first part is subtracted from nothing. Put it behind the parts that it is subtracted from.");
        }
        map.finish();
        parts.push_back(std::move(part));
    }
    return parts;
}

MeshSource read_mesh(const Node& node, const std::string& where, Report& report) {
    MapReader map(node, shapes::mesh, where, report);
    MeshSource mesh;
    mesh.file = read_data_path(map.find("file"), where + ".file", report);
    const std::string unit = map.word("unit");
    mesh.unit = unit == "cm" ? 1e-2 : unit == "m" ? 1.0 : unit == "um" ? 1e-6 : 1e-3;
    if (const std::string frame = map.word("frame"); !frame.empty()) {
        mesh.names_frame = true;
        mesh.is_ras = frame == "RAS";
    }
    if (const Node* repair = map.find("repair")) read_repair(*repair, mesh, report);
    if (const Node* canal = map.find("canal")) {
        MapReader room(*canal, shapes::canal, where + ".canal", report);
        if (const Node* found = room.one_of()) {
            if (found->key == "file")
                mesh.canal_file = read_data_path(found, where + ".canal.file", report);
            else
                mesh.canal = std::get<TubeSolid>(read_tube(*found, where + ".canal.tube", report));
        }
        room.finish();
    }
    mesh.source = map.text("source");
    map.finish();
    return mesh;
}

Reason in_anatomy(const Anatomy& anatomy, const std::vector<std::string>& keys, std::string message) {
    Reason reason{{anatomy.file}, std::move(message), {}};
    if (anatomy.text.empty()) return reason;  // made by a program
    const Document document = read_again(anatomy.file, anatomy.text);
    const Node* node = &document.root;
    const Node* last = nullptr;
    for (const auto* some : {&anatomy.within, &keys})
        for (const std::string& key : *some)
            if (const Node* within = node->find(key)) last = node = within;
    if (last == nullptr) return reason;
    const TextSpan span = last->kind == Node::Kind::scalar && last->span.size > 0 ? last->span : last->key_span;
    reason.place = document.place(span);
    reason.source_line = document.source_line(span);
    return reason;
}

}  // namespace kerf
