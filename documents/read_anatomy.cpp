// SPDX-License-Identifier: Apache-2.0
#include "documents/read_anatomy.h"

#include <algorithm>
#include <utility>

#include "documents/fit_references.h"
#include "documents/list_limits.h"
#include "documents/read_bone_source.h"
#include "documents/read_landmarks.h"
#include "documents/read_solids.h"
#include "documents/refuse_extends.h"
#include "documents/shapes/shapes.h"
#include "documents/yaml/correct_keys.h"
#include "kerf/abi.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

/// Reads the solids of a region: those of the parts with an id, on both sides, or its own.
std::vector<Solid> read_region_solids(MapReader& map, const std::vector<PhantomPart>& parts, Report& report) {
    const Node* node = map.one_of();
    if (node == nullptr) return {};
    if (node->key != "part") return read_solids(*node, map.name_of("solids"), report);
    const std::optional<std::string> id = read_id(*node, map.name_of("part"), report);
    if (!id) return {};
    std::vector<Solid> solids;
    std::vector<std::string> known;
    for (const PhantomPart& part : parts) {
        known.push_back(part.id);
        if (part.id == *id || part.id == mirrored_id(*id)) solids.push_back(part.solid);
    }
    if (solids.empty())
        refuse_unknown({.code = text::Code::unknown_word,
                        .span = node->span,
                        .subject = "The part `" + *id + "`",
                        .word = *id,
                        .known = std::move(known),
                        .if_none = "this anatomy has no `phantom.parts`. Write `solids:`."},
                       report);
    return solids;
}

std::vector<TissueRegion> read_regions(const Node& node, bool has_shell, const std::vector<PhantomPart>& parts,
                                       Report& report) {
    std::vector<TissueRegion> regions;
    for (const Node& item : read_list(node, "regions", report)) {
        MapReader map(item, shapes::tissue_region, "region", report);
        TissueRegion region;
        shapes::tissue_region.fill(map, region);
        region.solids = read_region_solids(map, parts, report);
        const Node* thickness = map.find("thickness");
        const Node* density = map.find("density");
        if (thickness != nullptr) map.quantity("thickness", region.thickness);
        if (density != nullptr) map.quantity("density", region.density);
        if (thickness != nullptr && !has_shell)
            report.error(
                text::Code::degenerate, thickness->key_span,
                "`thickness` has no effect in this region: the tissue has no shell. Remove `thickness`, or give the "
                "tissue one.");
        if (thickness == nullptr && density == nullptr)
            report.error(
                text::Code::missing_key, item.span,
                "The region changes nothing: got neither `thickness` nor `density`, expected at least one. Write one.");
        map.finish();
        regions.push_back(std::move(region));
    }
    return regions;
}

/// Returns the tissue that fills all that the others leave: the last one. If that one has a shell or solids and one
/// other tissue has neither, reports the order and returns the other one.
const Node* base_of(const std::vector<Node>& tissues, Report& report) {
    const auto is_bare = [](const Node& tissue) {
        return tissue.kind == Node::Kind::map && tissue.find("thickness") == nullptr &&
               tissue.find("solids") == nullptr;
    };
    if (tissues.empty()) return nullptr;
    const auto bare = std::find_if(tissues.begin(), tissues.end(), is_bare);
    if (is_bare(tissues.back()) || std::count_if(tissues.begin(), tissues.end(), is_bare) != 1) return &tissues.back();
    const Node* id = bare->find("id");
    const std::string name = id != nullptr ? "`" + text::excerpt(id->text, 40) + "`" : "the tissue";
    report.error(text::Code::degenerate, id != nullptr ? id->span : bare->span,
                 "The tissues are in the wrong order: " + name +
                     " has neither `thickness` nor `solids`, so it fills all that the others leave. Tissues go from "
                     "the surface inwards. Write " +
                     name + " last.");
    return &*bare;
}

/// @param has_density_line   the density of the last tissue comes from the CT
std::vector<Tissue> read_tissues(const Node& node, bool has_density_line, const std::vector<PhantomPart>& parts,
                                 Report& report) {
    std::vector<Tissue> tissues;
    UniqueIds ids("tissue");
    const std::vector<Node>& items = read_list(node, "tissues", report);
    if (items.size() > KERF_MAX_TISSUES)
        report.error(text::Code::out_of_range, items[KERF_MAX_TISSUES].span,
                     "There are too many tissues: got " + std::to_string(items.size()) + ", expected at most " +
                         std::to_string(KERF_MAX_TISSUES) + ". Remove some.");
    const Node* base = base_of(items, report);
    for (const Node& item : items) {
        MapReader map(item, shapes::tissue, item_name(item, "tissue"), report);
        Tissue tissue;
        shapes::tissue.fill(map, tissue);
        ids.add_own(tissue.id, item, report);
        const bool is_base = &item == base;
        const bool has_own_density = !(is_base && has_density_line);
        const Node* density = has_own_density ? map.required("density") : map.find("density");
        if (has_own_density)
            map.quantity("density", tissue.density);
        else if (density)
            report.error(text::Code::degenerate, density->key_span,
                         "The last tissue has two densities: this one and `ct.density`. Remove one.");
        const Node* solids = map.find("solids");
        const Node* thickness = is_base || solids ? map.find("thickness") : map.required("thickness");
        if (thickness && !is_base) map.quantity("thickness", tissue.thickness);
        if (solids && !is_base) tissue.solids = read_solids(*solids, map.name_of("solids"), report);
        if (const Node* regions = map.find("regions")) {
            tissue.regions = read_regions(*regions, thickness != nullptr && !is_base, parts, report);
            if (is_base && has_density_line)
                report.error(text::Code::degenerate, regions->key_span,
                             "`ct.density` gives the density of the last tissue, place by place. Remove the regions.");
        }
        if (is_base)
            for (const Node* own : {thickness, solids})
                if (own)
                    report.error(text::Code::degenerate, own->key_span,
                                 "The last tissue has " + (own == solids ? std::string("solids") : "a thickness") +
                                     ", but it fills all that the others leave. Remove it.");
        map.finish();
        tissues.push_back(std::move(tissue));
    }
    return tissues;
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
    report.error(
        text::Code::unknown_word, name.span,
        "No tissue `" + *id + "` has solids; " +
            (known.empty() ? "no tissue of this anatomy has any. Give it `solids:`, or write solids here."
                           : "known are " + listed(known, *id) + "." + or_choose(closest(*id, known, report))));
}

std::vector<Zone> read_zones(const Node& node, const std::vector<Tissue>& tissues, Report& report) {
    std::vector<Zone> zones;
    UniqueIds ids("zone");
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

Anatomy read_body(MapReader& map, const Document& document, Report& report) {
    Anatomy anatomy;
    anatomy.file = document.file();
    anatomy.text = document.text();
    if (const Node* node = map.find("metadata")) read_map(*node, shapes::anatomy_metadata, "metadata", anatomy, report);
    map.one_of();
    if (const Node* ct = map.find("ct")) anatomy.ct = read_ct(*ct, report);
    if (const Node* mesh = map.find("mesh")) anatomy.mesh = read_mesh(*mesh, "mesh", report);
    if (const Node* node = map.find("phantom")) {
        MapReader phantom(*node, shapes::phantom, "phantom", report);
        if (const Node* parts = phantom.find("parts"))
            anatomy.phantom.parts = read_parts(*parts, "phantom.parts", report);
        phantom.finish();
    }
    if (const Node* node = map.find("tissues"))
        anatomy.tissues = read_tissues(*node, anatomy.ct && anatomy.ct->density, anatomy.phantom.parts, report);
    if (const Node* node = map.find("landmarks")) read_landmarks(*node, anatomy, report);
    if (const Node* node = map.find("zones")) anatomy.zones = read_zones(*node, anatomy.tissues, report);
    if (const Node* node = map.find("fracture"))
        read_map(*node, shapes::fracture, "fracture", anatomy.fracture.emplace(), report);
    map.finish();
    check_fit_references(document.root, anatomy, report);
    return anatomy;
}

text::Result<AnatomyDraft> draft_of_text(const std::string& file, std::string text) {
    text::Diagnostics found;
    std::optional<Document> document = parse_document(file, std::move(text)).take(found);
    if (!document || refuse_extends(*document, shapes::anatomy, found)) return found;
    Report report(*document, found, &shapes::anatomy);
    const Node* kind = document->root.find("kind");
    if (kind == nullptr || kind->text == "Anatomy") correct_keys(document->root, shapes::anatomy, report);
    MapReader map(document->root, shapes::anatomy, "", report);
    if (!read_header(map, "Anatomy", report) || !are_lists_short(document->root, report)) return found;
    AnatomyDraft draft{read_body(map, *document, report)};
    draft.is_sound = !text::has_error(found);
    return {std::move(draft), std::move(found)};
}

text::Result<Anatomy> sound(text::Result<AnatomyDraft> draft) {
    if (!draft || !draft->is_sound) return draft.diagnostics();
    return {std::move(draft->anatomy), draft.diagnostics()};
}

}  // namespace

text::Result<AnatomyDraft> read_anatomy_draft(const std::string& file) {
    text::Result<std::string> text = read_text_file(file);
    return text ? draft_of_text(file, *std::move(text)) : text.diagnostics();
}

text::Result<AnatomyDraft> read_anatomy_draft_text(const std::string& file, std::string text) {
    return draft_of_text(file, std::move(text));
}

text::Result<Anatomy> read_anatomy(const std::string& file) { return sound(read_anatomy_draft(file)); }

text::Result<Anatomy> read_anatomy_text(const std::string& file, std::string text) {
    return sound(draft_of_text(file, std::move(text)));
}

text::Reason in_anatomy(const Anatomy& anatomy, const std::vector<std::string>& keys, std::string message) {
    text::Reason reason{{anatomy.file}, std::move(message), {}};
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

}  // namespace kerf::documents
