// SPDX-License-Identifier: Apache-2.0
#include "run/documents.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bone/import/data_file.h"
#include "bone/import/markups.h"
#include "documents/check_needs.h"
#include "documents/made/make_bone.h"
#include "documents/read_anatomy.h"
#include "documents/yaml/document.h"
#include "documents/yaml/read_map.h"
#include "run/bone_memory.h"
#include "run/data_files.h"
#include "run/limit_checks.h"
#include "run/plate.h"
#include "run/run_checks.h"
#include "run/shipped.h"
#include "run/thread_checks.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::run {

namespace {

const documents::Instrument* find_instrument(const documents::Procedure& procedure, const std::string& id) {
    const auto found = std::find_if(procedure.instruments.begin(), procedure.instruments.end(),
                                    [&](const documents::Instrument& i) { return i.id == id; });
    return found != procedure.instruments.end() ? &*found : nullptr;
}

ToolSetup setup_of(const documents::Instrument& instrument, const PluginRegistry& plugins) {
    ToolSetup setup;
    setup.tool = plugins.find(instrument.plugin, KERF_KIND_TOOL, instrument.tool);
    setup.force = plugins.find(instrument.force_plugin, KERF_KIND_FORCE, instrument.force);
    setup.tool_parameters = instrument.tool_parameters;
    setup.force_parameters = instrument.force_parameters;
    setup.drives = instrument.drives;
    return setup;
}

/// Makes the tools of the steps by their plugins.
void make_tools(Documents& documents, const PluginRegistry& plugins, text::Diagnostics& diagnostics) {
    std::vector<const documents::Instrument*> used;
    const documents::Procedure& procedure = documents.procedure;
    for (const documents::Step& step : procedure.steps) {
        const documents::Instrument* instrument = find_instrument(procedure, step.instrument);
        const auto at = std::find(used.begin(), used.end(), instrument);
        documents.tool_of_step.push_back(static_cast<std::size_t>(at - used.begin()));
        if (at != used.end()) continue;
        used.push_back(instrument);
        Tool& tool = documents.tools.emplace_back();
        tool.setup = setup_of(*instrument, plugins);
        if (const std::string why = bind_law(tool.setup); !why.empty()) {
            refuse_tool(procedure, instrument->id, why, diagnostics);
            continue;
        }
        if (std::string why; !outline_of(tool.setup, tool.outline, why)) {
            refuse_tool(procedure, instrument->id, why, diagnostics);
            continue;
        }
        if (instrument->hands > 0) tool.outline.handling.hands = instrument->hands;
        check_guide(procedure, *instrument, tool.outline.whole, diagnostics);
        check_width_of_cut(procedure, instrument->id, tool.outline.cutting, diagnostics);
    }
    std::vector<const ToolOutline*> outlines;
    for (const std::size_t tool : documents.tool_of_step) outlines.push_back(&documents.tools[tool].outline);
    if (!text::has_error(diagnostics)) {
        check_threads(procedure, outlines, diagnostics);
        check_screws_of_plates(procedure, outlines, diagnostics);
        check_plates_are_placed(procedure, diagnostics);
    }
    for (std::size_t step = 0; step < procedure.steps.size(); ++step)
        if (const Tool& tool = documents.tools[documents.tool_of_step[step]]; !tool.outline.cutting.outline().empty()) {
            check_hole_limits(procedure, step, tool.outline.cutting, diagnostics);
            check_limits_at_start(procedure, step, tool.outline, documents.anatomy, diagnostics);
            check_turns(procedure, step, tool.outline.has_thread(), diagnostics);
        }
}

/// Adds the reason to a plugin that was found but refused. It is not unknown.
void name_refused_plugins(const PluginRegistry& plugins, text::Diagnostics& diagnostics) {
    for (text::Diagnostic& d : diagnostics) {
        if (d.code != "E0301" || d.reason || d.place.column < 1) continue;
        const auto first = static_cast<std::size_t>(d.place.column - 1);
        if (first >= d.source_line.size()) continue;
        std::string id = d.source_line.substr(first, static_cast<std::size_t>(d.place.length));
        std::erase_if(id, [](char c) { return c == '"' || c == '\''; });
        if (const PluginRefusal* refusal = plugins.refusal_for(id); refusal != nullptr)
            d.reason = text::Reason{text::SourcePosition{refusal->path, 0, 0, 1}, refusal->why, {}};
    }
}

/// Checks the tools of the sound instruments of a procedure with errors: their plugins may refuse them, too.
void check_tools(const documents::ProcedureDraft& draft, const PluginRegistry& plugins,
                 text::Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < draft.procedure.instruments.size(); ++i) {
        const documents::Instrument& instrument = draft.procedure.instruments[i];
        const auto& steps = draft.procedure.steps;
        const bool is_used = std::any_of(steps.begin(), steps.end(),
                                         [&](const documents::Step& step) { return step.instrument == instrument.id; });
        if (!is_used || !draft.sound_instruments[i]) continue;
        ToolOutline outline;
        if (std::string why; !outline_of(setup_of(instrument, plugins), outline, why))
            refuse_tool(draft.procedure, instrument.id, why, diagnostics);
    }
}

/// Returns the shipped anatomies as `anatomy:` names them.
std::vector<std::string> shipped_anatomies(const std::string& shipped) {
    namespace fs = std::filesystem;
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(shipped) / "anatomy", error))
        if (entry.path().extension() == ".yaml") names.push_back("anatomy/" + entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Adds to diagnostics about the anatomy's file that the procedure names it.
void blame_anatomy_key(const documents::Procedure& procedure, text::Diagnostics& diagnostics, std::size_t first) {
    const auto document = documents::document_of(procedure);
    if (const documents::Node* node = document->root.find("anatomy"))
        text::because_of(documents::Report(*document, diagnostics).because(node->span, "the procedure names it here."),
                         diagnostics, first);
}

/// Returns the file of the anatomy. If there is none, reports it and returns an empty text.
std::string find_anatomy(const DocumentRequest& request, const documents::Procedure& procedure,
                         text::Diagnostics& diagnostics) {
    if (!request.anatomy.empty()) return request.anatomy;
    std::error_code error;
    if (procedure.anatomy_file.empty()) return {};  // reported while the procedure was read
    if (std::filesystem::exists(procedure.anatomy_file, error)) {
        const std::size_t first = diagnostics.size();
        if (bone::is_data_file_inside(procedure.anatomy_file, procedure.file, diagnostics))
            return procedure.anatomy_file;
        blame_anatomy_key(procedure, diagnostics, first);
        return {};
    }
    const std::string file = shipped_or_own(procedure.anatomy_name, request.shipped);
    if (!request.shipped.empty() && file != procedure.anatomy_name) return file;

    const auto document = documents::document_of(procedure);
    const documents::Node* node = document->root.find("anatomy");
    const std::vector<std::string> known =
        request.shipped.empty() ? std::vector<std::string>{} : shipped_anatomies(request.shipped);
    const std::string meant = documents::closest(procedure.anatomy_name, known);
    documents::Report(*document, diagnostics)
        .error(text::Code::file_unreadable, node != nullptr ? node->span : documents::TextSpan{},
               "The anatomy does not exist: searched in the procedure's folder" +
                   (known.empty()
                        ? std::string(".")
                        : " and among the shipped ones, " + documents::listed(known, procedure.anatomy_name) + ".") +
                   documents::or_choose(meant, "Check its name, or name another with `--anatomy`."),
               meant);
    return {};
}

/// Makes an anatomy. Messages give its name in place of a file.
text::Result<documents::AnatomyDraft> read_made(const documents::MakeRequest& request) {
    documents::MadeBone bone = documents::make_bone(request);
    return documents::read_anatomy_draft_text(bone.name, std::move(bone.text));
}

/// Returns the readable part of the anatomy; nothing if it cannot be read at all.
std::optional<documents::AnatomyDraft> read_the_anatomy(const DocumentRequest& request,
                                                        const documents::Procedure& procedure,
                                                        text::Diagnostics& diagnostics) {
    const bool is_made = request.anatomy.empty() && procedure.made.has_value();
    const std::string file = is_made ? "" : find_anatomy(request, procedure, diagnostics);
    if (file.empty() && !is_made) return std::nullopt;
    const std::size_t first = diagnostics.size();
    auto draft = (is_made ? read_made(*procedure.made) : documents::read_anatomy_draft(file)).take(diagnostics);
    if (request.anatomy.empty()) blame_anatomy_key(procedure, diagnostics, first);
    return draft;
}

/// Returns the first text in backticks of a message; empty if there is none.
std::string quoted_in(const std::string& message) {
    const std::size_t begin = message.find('`'), end = message.find('`', begin + 1);
    return end == std::string::npos ? std::string() : message.substr(begin, end + 1 - begin);
}

/// Returns whether an error of a variant follows from one of its base: the same name is unknown in both, a whole
/// section of the base is under an unknown key, or a step has no id to which a path could lead.
bool follows_from_base(const text::Diagnostic& d, const text::Diagnostics& base) {
    const bool is_path = d.code == text::code_text(text::Code::patch_nowhere) ||
                         d.code == text::code_text(text::Code::nothing_to_remove) ||
                         d.code == text::code_text(text::Code::wrong_shape);
    if (!is_path && !d.code.starts_with("E03")) return false;
    const std::string name = quoted_in(d.message);
    return std::any_of(base.begin(), base.end(), [&](const text::Diagnostic& of_base) {
        const bool is_section = of_base.code == text::code_text(text::Code::unknown_key) && of_base.place.column == 1 &&
                                of_base.write.empty();
        const bool is_id = is_path &&
                           (of_base.code == text::code_text(text::Code::missing_key) ||
                            of_base.code == text::code_text(text::Code::malformed_word)) &&
                           of_base.message.starts_with("step");
        const bool is_same_name = of_base.code.starts_with("E03") && (is_path || of_base.code == d.code) &&
                                  !name.empty() && of_base.message.find(name) != std::string::npos;
        return is_section || is_id || is_same_name;
    });
}

}  // namespace

text::Result<Documents> check_documents(const DocumentRequest& request, const PluginRegistry& plugins) {
    text::Diagnostics diagnostics;
    auto draft =
        documents::read_procedure_draft(request.procedure, plugins.catalog(), request.changes).take(diagnostics);
    name_refused_plugins(plugins, diagnostics);
    if (!draft) return diagnostics;
    Documents documents;
    documents.procedure = draft->procedure;
    const std::size_t first = diagnostics.size();
    auto anatomy = read_the_anatomy(request, documents.procedure, diagnostics);
    if (anatomy && !anatomy->is_sound && anatomy->anatomy.markups.empty())
        documents::check_names(documents.procedure, anatomy->anatomy, false, diagnostics);
    if (anatomy && anatomy->is_sound) {
        documents.anatomy = std::move(anatomy->anatomy);
        const auto has_new_error = [&] {
            return text::has_error({diagnostics.begin() + static_cast<std::ptrdiff_t>(first), diagnostics.end()});
        };
        check_data_files(documents.anatomy, diagnostics);
        if (!has_new_error()) documents.markup_hashes = bone::add_markups(documents.anatomy, diagnostics);
        if (!has_new_error()) documents::check_needs(documents.procedure, documents.anatomy, diagnostics);
    }
    documents.device = find_device(documents.procedure.device.c_str());
    check_run(documents.procedure, diagnostics);
    check_implant_files(documents.procedure, diagnostics);
    if (draft->is_sound) check_holes_of_parts(documents.procedure, diagnostics);
    if (anatomy && anatomy->is_sound && draft->has_spacing)
        check_bone_memory(documents.procedure, documents.anatomy, diagnostics);
    if (draft->is_sound)
        make_tools(documents, plugins, diagnostics);
    else
        check_tools(*draft, plugins, diagnostics);
    if (text::has_error(diagnostics)) return diagnostics;
    return {std::move(documents), std::move(diagnostics)};
}

text::Diagnostics check_variants(const DocumentRequest& request, const text::Diagnostics& base,
                                 const PluginRegistry& plugins) {
    text::Diagnostics found;
    const auto draft = documents::read_procedure_draft(request.procedure, plugins.catalog(), request.changes);
    if (!draft) return found;
    const auto is_known = [&](const text::Diagnostic& d) {
        return std::any_of(base.begin(), base.end(), [&](const text::Diagnostic& b) {
            return b.code == d.code && to_text(b.place) == to_text(d.place);
        });
    };
    for (const documents::Variant& variant : draft->procedure.variants) {
        DocumentRequest changed = request;
        changed.changes.variant = variant.id;
        const auto of_variant = check_documents(changed, plugins);
        for (text::Diagnostic d : of_variant.diagnostics()) {
            if (d.level == text::Diagnostic::Level::warning) continue;  // reported for the base, or harmless
            if (is_known(d) || follows_from_base(d, base)) continue;
            d.message = "In the variant `" + variant.id + "`: " + d.message;
            found.push_back(std::move(d));
        }
    }
    return found;
}

}  // namespace kerf::run
