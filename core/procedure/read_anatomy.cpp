// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/read_anatomy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/procedure/read_map.h"
#include "kerf/abi.h"
#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

const QuantityNeed coordinate{dimension::length, "mm", -2.0_m, 2.0_m};
const QuantityNeed extent{dimension::length, "mm", 0.1_mm, 2.0_m};
const QuantityNeed tolerance{dimension::length, "mm", 0.0_mm, 20.0_mm};
const QuantityNeed shell{dimension::length, "mm", 0.1_mm, 20.0_mm};
const QuantityNeed bone_density{dimension::density, "g/cm3", 0.05_g_per_cm3, 3.0_g_per_cm3};
const QuantityNeed line_density{dimension::density, "g/cm3", -3.0_g_per_cm3, 3.0_g_per_cm3};
const QuantityNeed least_density{dimension::density, "g/cm3", 0.01_g_per_cm3, 3.0_g_per_cm3};
const QuantityNeed closing_radius{dimension::length, "mm", 0.0_mm, 10.0_mm};
const QuantityNeed hole{dimension::length, "mm", 0.0_mm, 20.0_mm};
const QuantityNeed crumb{dimension::volume, "mm3", 0.0, 1e-6};
const QuantityNeed voxel_value{dimension::none, "", -4000.0, 65535.0};
const QuantityNeed label{dimension::none, "", 1.0, 65535.0};
const QuantityNeed direction{dimension::none, "", -1.0, 1.0};

constexpr double shortest = 1e-6;  // [m] a length below it has no direction

/// The two ends of a tube or an axis; reports when they coincide.
template <class Ends>
void read_ends(MapReader& map, Ends& ends, const std::string& name, Report& report) {
    const auto from = map.vector("from", coordinate);
    const auto to = map.vector("to", coordinate);
    if (!from || !to) return;
    ends.from = *from;
    ends.to = *to;
    if (length(*to - *from) < shortest)
        report.error(Code::degenerate, map.span(), name + " goes from a point to the same point.");
}

Solid read_box(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, name, report);
    BoxSolid box;
    box.centre = map.vector("centre", coordinate).value_or(Vec3{});
    box.size = map.vector("size", extent).value_or(Vec3{});
    map.finish();
    return box;
}

Solid read_tube(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, name, report);
    TubeSolid tube;
    read_ends(map, tube, name, report);
    tube.radius = map.quantity("radius", extent);
    map.finish();
    return tube;
}

Solid read_elliptic_tube(const Node& node, const std::string& name, Report& report) {
    MapReader map(node, name, report);
    EllipticTubeSolid tube;
    read_ends(map, tube, name, report);
    tube.width = map.quantity("width", extent);
    tube.height = map.quantity("height", extent);
    if (const Node* up = map.optional("up")) {
        tube.up = read_vector(*up, map.name_of("up"), direction, report).value_or(tube.up);
        const Vec3 along = normalized(tube.to - tube.from);
        if (length(cross(along, normalized(tube.up))) < 1e-3 && length(along) > 0.0)
            report.error(Code::degenerate, up->span, map.name_of("up") + " must point across the tube, not along it.");
    }
    map.finish();
    return tube;
}

const std::vector<std::string> solid_keys{"box", "tube", "elliptic_tube"};

/// The one solid that a map names by its key.
Solid read_solid(MapReader& map, Report& report) {
    const Node* node = map.one_of(solid_keys);
    if (!node) return BoxSolid{};
    const std::string name = map.name_of(node->key);
    if (node->key == "box") return read_box(*node, name, report);
    if (node->key == "tube") return read_tube(*node, name, report);
    return read_elliptic_tube(*node, name, report);
}

std::vector<PhantomPart> read_parts(const Node& node, Report& report) {
    std::vector<PhantomPart> parts;
    UniqueIds ids;
    for (const Node& item : read_list(node, "phantom.parts", report)) {
        MapReader map(item, item_name(item, "part"), report);
        PhantomPart part;
        part.id = map.id("id");
        if (!part.id.empty()) ids.add(part.id, item.find("id")->span, report);
        part.solid = read_solid(map, report);
        part.source = map.optional_text("source");
        if (const Node* subtract = map.optional("subtract")) {
            part.subtract = read_yes_no(*subtract, "subtract", report).value_or(false);
            if (part.subtract && parts.empty())
                report.error(Code::degenerate, subtract->span, "The first part has nothing to be taken away from.");
        }
        map.finish();
        parts.push_back(std::move(part));
    }
    return parts;
}

/// A path that stays inside whatever folder it is looked for in.
std::string read_data_path(const Node* node, const std::string& name, Report& report) {
    if (!node) return {};
    const std::optional<std::string> text = read_text(*node, name, report);
    if (!text) return {};
    const std::filesystem::path path = std::filesystem::path(*text).lexically_normal();
    const bool has_drive = text->find(':') != std::string::npos || text->find('\\') != std::string::npos;
    if (path.is_absolute() || has_drive || (!path.empty() && *path.begin() == "..")) {
        report.error(Code::path_outside, node->span,
                     name + " must be a path inside the document's own folder or KERF_DATA, with `/` between folders.");
        return {};
    }
    return path.generic_string();
}

DensityLine read_density_line(const Node& node, Report& report) {
    MapReader map(node, "ct.density", report);
    DensityLine line;
    line.at_zero = map.quantity("at_zero", line_density);
    line.per_unit = map.quantity("per_unit", line_density);
    line.floor = map.quantity("floor", least_density);
    line.source = map.text("source");
    map.finish();
    return line;
}

CtSource read_ct(const Node& node, Report& report) {
    MapReader map(node, "ct", report);
    CtSource ct;
    ct.image = read_data_path(map.required("image"), "ct.image", report);
    if (const Node* found = map.optional("labels")) {
        MapReader labels(*found, "ct.labels", report);
        ct.labels = read_data_path(labels.required("file"), "ct.labels.file", report);
        if (const Node* keep = labels.required("keep"))
            for (const Node& item : read_list(*keep, "ct.labels.keep", report)) {
                const std::optional<double> value = read_quantity(item, "A label", label, report);
                if (!value) continue;
                if (*value != std::floor(*value))
                    report.error(Code::not_a_number, item.span, "A label must be a whole number.");
                ct.keep.push_back(static_cast<int>(*value));
            }
        labels.finish();
    }
    ct.threshold = map.quantity("threshold", voxel_value);
    map.quantity("closing", closing_radius, ct.closing);
    if (const Node* fill = map.optional("fill")) ct.fill = read_yes_no(*fill, "ct.fill", report).value_or(false);
    if (const Node* density = map.optional("density")) ct.density = read_density_line(*density, report);
    ct.source = map.optional_text("source");
    map.finish();
    return ct;
}

/// One of a few words; the first when it is none of them.
std::size_t read_word(const Node& node, const std::string& name, const std::vector<std::string>& words, Report& report) {
    const std::optional<std::string> text = read_text(node, name, report);
    if (!text) return 0;
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    report.error(Code::unknown_word, node.span, name + " must be " + listed(words) + ".", closest(*text, words, report));
    return 0;
}

void read_repair(const Node& node, MeshSource& mesh, Report& report) {
    MapReader map(node, "mesh.repair", report);
    map.quantity("holes_up_to", hole, mesh.holes_up_to);
    map.quantity("pieces_under", crumb, mesh.pieces_under);
    if (const Node* inner = map.optional("inner"))
        mesh.inner = read_word(*inner, "mesh.repair.inner", {"hollow", "solid"}, report) == 0 ? InnerPieces::hollow
                                                                                              : InnerPieces::solid;
    map.finish();
}

MeshSource read_mesh(const Node& node, Report& report) {
    MapReader map(node, "mesh", report);
    MeshSource mesh;
    mesh.file = read_data_path(map.required("file"), "mesh.file", report);
    if (const Node* unit = map.required("unit")) {
        constexpr std::array<double, 4> metres{1e-3, 1e-2, 1.0, 1e-6};
        mesh.unit = metres[read_word(*unit, "mesh.unit", {"mm", "cm", "m", "um"}, report)];
    }
    if (const Node* frame = map.optional("frame")) {
        mesh.names_frame = true;
        mesh.is_ras = read_word(*frame, "mesh.frame", {"LPS", "RAS"}, report) == 1;
    }
    if (const Node* repair = map.optional("repair")) read_repair(*repair, mesh, report);
    if (const Node* canal = map.optional("canal")) {
        MapReader room(*canal, "mesh.canal", report);
        if (const Node* found = room.one_of({"file", "tube"})) {
            if (found->key == "file") mesh.canal_file = read_data_path(found, "mesh.canal.file", report);
            else mesh.canal = std::get<TubeSolid>(read_tube(*found, "mesh.canal.tube", report));
        }
        room.finish();
    }
    mesh.source = map.optional_text("source");
    map.finish();
    return mesh;
}

/// `has_density_line`: the density of the base comes from the CT.
std::vector<Tissue> read_tissues(const Node& node, bool has_density_line, Report& report) {
    std::vector<Tissue> tissues;
    UniqueIds ids;
    const std::vector<Node>& items = read_list(node, "tissues", report);
    if (items.size() > KERF_MAX_TISSUES)
        report.error(Code::out_of_range, items[KERF_MAX_TISSUES].span,
                     "There are " + std::to_string(items.size()) + " tissues; a force model can mix at most " +
                         std::to_string(KERF_MAX_TISSUES) + ".");
    for (const Node& item : items) {
        MapReader map(item, item_name(item, "tissue"), report);
        Tissue tissue;
        tissue.id = map.id("id");
        if (!tissue.id.empty()) ids.add(tissue.id, item.find("id")->span, report);
        const bool is_base = &item == &items.back();
        if (!(is_base && has_density_line)) tissue.density = map.quantity("density", bone_density);
        else if (const Node* density = map.optional("density"))
            report.error(Code::degenerate, density->key_span, "`ct.density` gives the last tissue its density. Remove one.");
        tissue.source = map.optional_text("source");
        if (!is_base) tissue.thickness = map.quantity("thickness", shell);
        else if (const Node* thickness = map.optional("thickness"))
            report.error(Code::degenerate, thickness->key_span,
                         "The last tissue fills what the others leave; it has no thickness. Remove it.");
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

void read_landmarks(const Node& node, Anatomy& anatomy, Report& report) {
    MapReader map(node, "landmarks", report);
    UniqueIds ids;  // a step names a landmark without saying of which sort
    for (const Node& item : read_named(map.optional("points"), "landmarks.points", ids, report)) {
        MapReader point(item, item.key, report);
        LandmarkPoint landmark;
        landmark.id = item.key;
        landmark.at = point.vector("at", coordinate).value_or(Vec3{});
        landmark.tolerance = point.quantity("tolerance", tolerance);
        point.finish();
        anatomy.points.push_back(std::move(landmark));
    }
    for (const Node& item : read_named(map.optional("axes"), "landmarks.axes", ids, report)) {
        MapReader axis(item, item.key, report);
        LandmarkAxis landmark;
        landmark.id = item.key;
        read_ends(axis, landmark, item.key, report);
        landmark.tolerance = axis.quantity("tolerance", tolerance);
        axis.finish();
        anatomy.axes.push_back(std::move(landmark));
    }
    map.finish();
}

std::vector<Zone> read_zones(const Node& node, Report& report) {
    std::vector<Zone> zones;
    UniqueIds ids;
    for (const Node& item : read_named(&node, "zones", ids, report)) {
        Zone zone;
        zone.id = item.key;
        for (const Node& solid : read_list(item, item.key, report)) {
            MapReader map(solid, item.key, report);
            zone.solids.push_back(read_solid(map, report));
            map.finish();
        }
        zones.push_back(std::move(zone));
    }
    return zones;
}

}  // namespace

std::optional<Anatomy> read_anatomy(const std::string& file, Diagnostics& diagnostics) {
    std::optional<std::string> text = read_text_file(file, diagnostics);
    return text ? read_anatomy_text(file, std::move(*text), diagnostics) : std::nullopt;
}

std::optional<Anatomy> read_anatomy_text(const std::string& file, std::string text, Diagnostics& diagnostics) {
    Diagnostics found;
    std::optional<Anatomy> anatomy;
    if (const std::optional<Document> document = parse_document(file, std::move(text), found)) {
        Report report(*document, found);
        MapReader map(document->root, "", report);
        if (read_header(map, "Anatomy", report)) {
            anatomy.emplace();
            anatomy->file = file;
            anatomy->text = document->text();
            if (const Node* node = map.required("metadata")) {
                MapReader metadata(*node, "metadata", report);
                anatomy->id = metadata.id("id");
                anatomy->title = metadata.text("title");
                metadata.finish();
            }
            const Node* solids = map.optional("phantom");
            const Node* ct = map.optional("ct");
            const Node* mesh = map.optional("mesh");
            if ((solids != nullptr) + (ct != nullptr) + (mesh != nullptr) != 1)
                report.error(Code::one_of, mesh ? mesh->key_span : ct ? ct->key_span : map.span(),
                             "An anatomy has exactly one of `phantom`, `ct` and `mesh`.");
            if (ct) anatomy->ct = read_ct(*ct, report);
            if (mesh) anatomy->mesh = read_mesh(*mesh, report);
            if (solids) {
                MapReader phantom(*solids, "phantom", report);
                if (const Node* parts = phantom.required("parts")) anatomy->phantom.parts = read_parts(*parts, report);
                phantom.finish();
            }
            if (const Node* node = map.required("tissues")) 
                anatomy->tissues = read_tissues(*node, anatomy->ct && anatomy->ct->density, report);
            if (const Node* node = map.required("landmarks")) read_landmarks(*node, *anatomy, report);
            if (const Node* node = map.optional("zones")) anatomy->zones = read_zones(*node, report);
            map.finish();
        }
    }
    if (has_error(found)) anatomy.reset();
    diagnostics.insert(diagnostics.end(), found.begin(), found.end());
    return anatomy;
}

}  // namespace kerf
