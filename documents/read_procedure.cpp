// SPDX-License-Identifier: Apache-2.0
#include "documents/read_procedure.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <utility>

#include "documents/consequences.h"
#include "documents/list_limits.h"
#include "documents/made/read_request.h"
#include "documents/names.h"
#include "documents/patch.h"
#include "documents/procedure_context.h"
#include "documents/read_implants.h"
#include "documents/read_instruments.h"
#include "documents/read_measures.h"
#include "documents/read_rehearsals.h"
#include "documents/read_scoring.h"
#include "documents/read_steps.h"
#include "documents/refuse_extends.h"
#include "documents/shapes/shapes.h"
#include "documents/yaml/correct_keys.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

void warn_of_unused(const Node& instruments, const std::vector<Step>& steps, Report& report) {
    std::set<std::string> used;
    for (const Step& step : steps) used.insert(step.instrument);
    const auto is_known = [&](const std::string& id) { return instruments.find(id) != nullptr; };
    if (!std::all_of(used.begin(), used.end(), is_known)) return;  // one of these may be meant
    for (const Node& child : instruments.children)
        if (!used.contains(child.key))
            report.warning(text::Code::unused_instrument, child.key_span,
                           "The instrument `" + text::excerpt(child.key, 40) +
                               "` is not used by any step. Remove it, or name it in a step.");
}

/// Reads the titles of variants. A patch is checked when it is applied.
std::vector<Variant> read_variants(const Node& node, Report& report) {
    std::vector<Variant> variants;
    if (!is_kind(node, Node::Kind::map, "variants", report)) return variants;
    for (const Node& child : node.children) {
        read_key(child, "A variant's name", report);
        Variant& variant = variants.emplace_back(Variant{child.key, {}});
        read_map(child, shapes::variant, child.key, variant, report, [&](MapReader& map) {
            if (const Node* patch = map.find("patch")) is_kind(*patch, Node::Kind::map, child.key + ".patch", report);
        });
    }
    return variants;
}

/// Applies the variant, the patches and the settings to the tree, in this order.
void apply(const ProcedureChanges& changes, Document& document, text::Diagnostics& found) {
    if (!changes.variant.empty()) {
        Report report(document, found);
        const Node* variants = document.root.find("variants");
        const Node* chosen = variants ? variants->find(changes.variant) : nullptr;
        const Node* patch = chosen ? chosen->find("patch") : nullptr;
        if (!chosen) {
            std::vector<std::string> known;
            if (variants)
                for (const Node& variant : variants->children) known.push_back(variant.key);
            refuse_unknown({.code = text::Code::unknown_variant,
                            .span = variants ? variants->key_span : TextSpan{},
                            .subject = "The variant " + quoted_id(text::excerpt(changes.variant, 40)),
                            .word = changes.variant,
                            .known = known,
                            .if_none = "the procedure has none. Run it without."},
                           report);
        } else if (patch && patch->kind == Node::Kind::map) {
            const Node changed = *patch;  // the tree that holds it changes
            apply_patch(document, document.root, changed, report);
        }
    }
    for (const std::string& file : changes.patches) apply_patch_file(document, file, found);
    apply_settings(document, changes.settings, found);
}

/// Reports implants that are planned along an axis that is not declared.
void check_place_axes(const Node& implants, const ProcedureContext& reading) {
    for (const Implant& implant : reading.procedure.implants) {
        const Node* node = implants.find(implant.id);
        const Node* place = node != nullptr ? node->find("place") : nullptr;
        const Node* axis = place != nullptr ? place->find("axis") : nullptr;
        if (!implant.place || axis == nullptr || implant.place->axis.empty()) continue;
        if (!contains(reading.procedure.needs_landmarks, implant.place->axis))
            reading.refuse_undeclared(text::Code::undeclared_landmark, *axis, "landmark");
    }
}

/// Reads a procedure section by section, in the order in which they refer to each other.
class ProcedureReader {
public:
    ProcedureReader(MapReader& map, const Document& document, const ComponentCatalog& catalog, Report& report)
        : map_(map), report_(report), reading_{draft_.procedure, document, catalog, report} {}

    ProcedureDraft read() && {
        read_head();
        read_instruments();
        read_plans();
        read_steps();
        read_assistance();
        if (const Node* node = map_.find("scoring")) procedure_.scoring = read_scoring(*node, reading_);
        procedure_.rehearsals = read_rehearsals(map_.find("paths"), map_.find("rehearsals"), reading_);
        if (const Node* node = map_.find("variants")) procedure_.variants = read_variants(*node, report_);
        map_.finish();
        return std::move(draft_);
    }

private:
    template <class Rest>
    void read_section(const char* key, const MapShape<Procedure>& table, Rest&& rest) {
        if (const Node* node = map_.find(key)) read_map(*node, table, key, procedure_, report_, rest);
    }
    void read_section(const char* key, const MapShape<Procedure>& table) {
        read_section(key, table, [](MapReader&) {});
    }

    void read_head() {
        const Document& document = reading_.document;
        procedure_.file = document.file();
        procedure_.text = document.text();
        read_section("metadata", shapes::metadata, [&](MapReader& map) {
            if (const Node* authors = map.find("authors"))
                for (const Node& author : read_list(*authors, "metadata.authors", report_))
                    procedure_.authors.push_back(read_text(author, "An author", report_).value_or(""));
        });
        read_section("needs", shapes::needs);
        // Inside the document's folder, so that a procedure can be handed on, and cannot reach for other files.
        const Node* anatomy = map_.find("anatomy");
        if (anatomy != nullptr && anatomy->kind == Node::Kind::map)
            procedure_.made = read_make_request(*anatomy, "anatomy", report_);
        else if (anatomy != nullptr)
            procedure_.anatomy_name = read_path(*anatomy, anatomy->key, "the document's own folder", report_);
        if (!procedure_.anatomy_name.empty())
            procedure_.anatomy_file =
                (std::filesystem::path(document.file()).parent_path() / procedure_.anatomy_name).generic_string();
        const int errors_before_accuracy = report_.errors();
        read_section("accuracy", shapes::accuracy);
        draft_.has_spacing = report_.errors() == errors_before_accuracy;
        read_section("budget", shapes::budget,
                     [&](MapReader& map) { procedure_.budget.is_given = map.find("tick") != nullptr; });
        read_section("haptics", shapes::haptics);
        map_.quantity("time_limit", procedure_.time_limit);
    }

    void read_instruments() {
        const Node* instruments = map_.find("instruments");
        if (instruments == nullptr || !is_kind(*instruments, Node::Kind::map, "instruments", report_)) return;
        if (instruments->children.empty())
            report_.error(text::Code::empty_value, instruments->span, "The list of instruments is empty. Add one.");
        for (const Node& child : instruments->children) {
            const int errors_before = report_.errors();
            procedure_.instruments.push_back(read_instrument(child, reading_.catalog, report_));
            draft_.sound_instruments.push_back(report_.errors() == errors_before);
        }
    }

    void read_plans() {
        if (const Node* node = map_.find("implants")) {
            procedure_.implants = read_implants(*node, report_);
            check_place_axes(*node, reading_);
        }
        if (const Node* node = map_.find("constructions"))
            procedure_.constructions = read_constructions(*node, procedure_.needs_landmarks, report_);
        if (const Node* node = map_.find("measures"))
            procedure_.measures = read_measures(*node, procedure_.needs_landmarks, procedure_.constructions, report_);
    }

    void read_assistance() {
        procedure_.assist = assist_of(map_.word("assist")).value_or(procedure_.assist);
        const Node* zones = map_.find("zones");
        if (zones == nullptr || !is_kind(*zones, Node::Kind::map, "zones", report_)) return;
        for (const Node& child : zones->children) {
            if (!read_key(child, "A zone", report_)) continue;
            if (!contains(procedure_.needs_zones, child.key)) {
                Node name;
                name.text = child.key;
                name.span = child.key_span;
                reading_.refuse_undeclared(text::Code::undeclared_zone, name, "zone");
            }
            ZoneDisplay& display = procedure_.zones.emplace_back();
            display.zone = child.key;
            read_map(child, shapes::zone_display, child.key, display, report_);
        }
    }

    void read_steps() {
        UniqueIds ids("step");
        if (const Node* steps = map_.find("steps"))
            for (const Node& item : read_list(*steps, "steps", report_)) {
                procedure_.steps.push_back(read_step(item, reading_));
                ids.add_own(procedure_.steps.back().id, item, report_);
            }
        if (const Node* instruments = map_.find("instruments"); instruments && !procedure_.steps.empty())
            warn_of_unused(*instruments, procedure_.steps, report_);
    }

    MapReader& map_;
    Report& report_;
    ProcedureDraft draft_;
    Procedure& procedure_ = draft_.procedure;
    ProcedureContext reading_;
};

text::Result<ProcedureDraft> draft_of_text(const std::string& file, std::string text, const ComponentCatalog& catalog,
                                           const ProcedureChanges& changes) {
    text::Diagnostics found;
    std::optional<Document> parsed = parse_document(file, std::move(text)).take(found);
    if (!parsed) return found;
    const auto document = std::make_shared<Document>(std::move(*parsed));
    if (refuse_extends(*document, shapes::procedure, found)) return found;
    const auto correct = [&] {
        const Node* kind = document->root.find("kind");
        Report report(*document, found, &shapes::procedure);
        if (kind == nullptr || kind->text == "Procedure") correct_keys(document->root, shapes::procedure, report);
    };
    correct();
    const auto problems_before = static_cast<std::ptrdiff_t>(found.size());
    if (document->root.kind == Node::Kind::map) apply(changes, *document, found);
    if (!changes.variant.empty() && text::has_error({found.begin() + problems_before, found.end()})) {
        merge_repeated(found);  // half of a variant was applied: what else is wrong follows from that
        return found;
    }
    if (changes.any()) correct();
    Report report(*document, found, &shapes::procedure);
    MapReader map(document->root, shapes::procedure, "", report);
    if (!read_header(map, "Procedure", report) || !are_lists_short(document->root, report)) return found;
    ProcedureDraft draft = ProcedureReader(map, *document, catalog, report).read();
    draft.procedure.document = document;
    draft.procedure.translations = translations_in(document->root, shapes::procedure);
    draft.procedure.variant = changes.variant;
    if (changes.any()) draft.procedure.text = emitted(*document, false);
    draft.is_sound = !text::has_error(found);
    drop_lost_names(found);
    merge_repeated(found);
    return {std::move(draft), std::move(found)};
}

text::Result<Procedure> sound(text::Result<ProcedureDraft> draft) {
    if (!draft || !draft->is_sound) return draft.diagnostics();
    return {std::move(draft->procedure), draft.diagnostics()};
}

}  // namespace

text::Result<ProcedureDraft> read_procedure_draft(const std::string& file, const ComponentCatalog& catalog,
                                                  const ProcedureChanges& changes) {
    text::Result<std::string> text = read_text_file(file);
    return text ? draft_of_text(file, *std::move(text), catalog, changes) : text.diagnostics();
}

text::Result<Procedure> read_procedure(const std::string& file, const ComponentCatalog& catalog,
                                       const ProcedureChanges& changes) {
    return sound(read_procedure_draft(file, catalog, changes));
}

text::Result<Procedure> read_procedure_text(const std::string& file, std::string text, const ComponentCatalog& catalog,
                                            const ProcedureChanges& changes) {
    return sound(draft_of_text(file, std::move(text), catalog, changes));
}

std::shared_ptr<const Document> document_of(const Procedure& procedure) {
    return procedure.document ? procedure.document
                              : std::make_shared<const Document>(read_again(procedure.file, procedure.text));
}

}  // namespace kerf::documents
