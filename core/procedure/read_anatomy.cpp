// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/read_anatomy.h"

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

/// A label's number, or what a segmentation calls it.
void read_kept_label(const Node& item, CtSource& ct, Report& report) {
    const bool is_number = !item.text.empty() && item.text.find_first_not_of("+-.0123456789") == std::string::npos;
    if (item.kind == Node::Kind::scalar && !item.text.empty() && !is_number) {
        ct.keep_named.push_back(item.text);
        return;
    }
    const std::optional<double> value = read_quantity(item, "A label", label, report);
    if (!value) return;
    if (*value != std::floor(*value)) report.error(Code::not_a_number, item.span, "A label must be a whole number.");
    ct.keep.push_back(static_cast<int>(*value));
}

CtSource read_ct(const Node& node, Report& report) {
    MapReader map(node, "ct", report);
    CtSource ct;
    ct.image = read_data_path(map.required("image"), "ct.image", report);
    ct.series = map.optional_text("series");
    if (const Node* resample = map.optional("resample"))
        ct.may_resample = read_yes_no(*resample, "ct.resample", report).value_or(false);
    if (const Node* found = map.optional("intensity"))
        if (const auto word = read_word(*found, "ct.intensity", {"HU", "grey"}, report))
            ct.intensity = *word == "HU" ? CtSource::Intensity::hounsfield : CtSource::Intensity::grey;
    if (const Node* found = map.optional("labels")) {
        MapReader labels(*found, "ct.labels", report);
        ct.labels = read_data_path(labels.required("file"), "ct.labels.file", report);
        if (const Node* keep = labels.required("keep"))
            for (const Node& item : read_list(*keep, "ct.labels.keep", report)) read_kept_label(item, ct, report);
        labels.finish();
    }
    if (const Node* found = map.optional("keep")) {
        MapReader keep(*found, "ct.keep", report);
        ct.component_at = keep.id("component_at");
        keep.finish();
    }
    ct.threshold = map.quantity("threshold", voxel_value);
    map.quantity("closing", closing_radius, ct.closing);
    if (const Node* fill = map.optional("fill")) ct.fill = read_yes_no(*fill, "ct.fill", report).value_or(false);
    if (const Node* density = map.optional("density")) ct.density = read_density_line(*density, report);
    ct.source = map.optional_text("source");
    map.finish();
    return ct;
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

std::vector<MarkupsFile> read_markups(const Node& node, Report& report) {
    std::vector<MarkupsFile> files;
    for (const Node& item : read_list(node, "landmarks.markups", report)) {
        MapReader map(item, "markups", report);
        MarkupsFile markups;
        markups.file = read_data_path(map.required("file"), "markups.file", report);
        markups.tolerance = map.quantity("tolerance", tolerance);
        if (const Node* names = map.optional("names"); names && is_kind(*names, Node::Kind::map, "markups.names", report))
            for (const Node& name : names->children)
                if (const auto id = read_id(name, "markups.names." + name.key, report)) markups.names[name.key] = *id;
        map.finish();
        files.push_back(std::move(markups));
    }
    return files;
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
        if (const Node* lies = point.optional("lies"))
            if (const auto word = read_word(*lies, point.name_of("lies"), {"on_bone", "in_bone", "off_bone"}, report))
                landmark.lies = *word == "on_bone"   ? LandmarkPoint::Lies::on_bone
                                : *word == "in_bone" ? LandmarkPoint::Lies::in_bone
                                                     : LandmarkPoint::Lies::off_bone;
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
    for (const Node& item : read_named(map.optional("planes"), "landmarks.planes", ids, report)) {
        MapReader plane(item, item.key, report);
        LandmarkPlane landmark;
        landmark.id = item.key;
        landmark.at = plane.vector("at", coordinate).value_or(Vec3{});
        if (const auto normal = plane.vector("normal", direction)) {
            landmark.normal = normalized(*normal);
            if (!(length(*normal) > 1e-6))
                report.error(Code::degenerate, plane.span(), item.key + ".normal has no length.");
        }
        landmark.tolerance = plane.quantity("tolerance", tolerance);
        plane.finish();
        anatomy.planes.push_back(std::move(landmark));
    }
    if (const Node* files = map.optional("markups")) anatomy.markups = read_markups(*files, report);
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
            if (!solids == !ct)
                report.error(Code::one_of, ct ? ct->key_span : map.span(), "An anatomy has either `phantom` or `ct`.");
            if (ct) anatomy->ct = read_ct(*ct, report);
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
