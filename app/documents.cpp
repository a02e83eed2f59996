// SPDX-License-Identifier: Apache-2.0
#include "app/documents.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/bone_memory.h"
#include "app/run_checks.h"
#include "core/import/data_file.h"
#include "core/import/markups.h"
#include "core/procedure/document.h"
#include "core/procedure/read_anatomy.h"

namespace kerf {

namespace {

void check_data_file(const Node& node, const std::string& document, Report& report) {
    std::error_code ignored;
    if (node.kind != Node::Kind::scalar || std::filesystem::exists(found_data_file(node.text, document), ignored))
        return;
    const char* data = std::getenv("KERF_DATA");
    const std::string first = node.text.substr(0, node.text.find('/'));
    report.error(
        Code::no_data_file, node.span,
        data != nullptr && *data != '\0'
            ? "There is no such file or folder, neither beside the document nor in `" + std::string(data) +
                  "`, which KERF_DATA names. Check its name, and that KERF_DATA names the folder that holds `" + first +
                  "`."
            : "There is no such file or folder beside the document, and KERF_DATA is not set. Check its name; where "
              "the data lie in a folder of "
              "their own, name the one that holds `" +
                  first + "`, as in `export KERF_DATA=/home/me/data`.");
}

/// Every file that the anatomy names must be there; what is in it is looked at when the bone is made.
void check_data_files(const Anatomy& anatomy, Diagnostics& diagnostics) {
    const Document document = read_again(anatomy.file, anatomy.text);
    Report report(document, diagnostics);
    const auto check = [&](const Node* map, const char* key) {
        if (const Node* node = map != nullptr ? map->find(key) : nullptr) check_data_file(*node, anatomy.file, report);
    };
    const Node* ct = document.root.find("ct");
    check(ct, "image");
    check(ct != nullptr ? ct->find("labels") : nullptr, "file");
    const Node* mesh = document.root.find("mesh");
    check(mesh, "file");
    check(mesh != nullptr ? mesh->find("canal") : nullptr, "file");
    const Node* landmarks = document.root.find("landmarks");
    if (const Node* markups = landmarks != nullptr ? landmarks->find("markups") : nullptr)
        for (const Node& item : markups->children) check(&item, "file");
}

/// The same of a procedure's implants.
void check_implant_files(const Procedure& procedure, Diagnostics& diagnostics) {
    const auto document = document_of(procedure);
    Report report(*document, diagnostics);
    for (const Implant& implant : procedure.implants) {
        const Node* node = &document->root;
        for (const std::string& key : {std::string("implants"), implant.id, std::string("mesh"), std::string("file")})
            if (node != nullptr) node = node->find(key);
        if (node != nullptr) check_data_file(*node, procedure.file, report);
    }
}

/// The tools of the steps, as their plugins make them.
void make_tools(Documents& documents, const PluginRegistry& plugins, Diagnostics& diagnostics) {
    std::vector<const Instrument*> used;
    const Procedure& procedure = documents.procedure;
    for (const Step& step : procedure.steps) {
        const auto instrument = std::find_if(procedure.instruments.begin(), procedure.instruments.end(),
                                             [&](const Instrument& i) { return i.id == step.instrument; });
        const auto at = std::find(used.begin(), used.end(), &*instrument);
        documents.tool_of_step.push_back(static_cast<std::size_t>(at - used.begin()));
        if (at != used.end()) continue;
        used.push_back(&*instrument);
        Tool& tool = documents.tools.emplace_back();
        tool.setup.tool = plugins.find(instrument->plugin, KERF_KIND_TOOL, instrument->tool);
        tool.setup.force = plugins.find(instrument->plugin, KERF_KIND_FORCE, instrument->force);
        tool.setup.tool_parameters = instrument->tool_parameters;
        tool.setup.force_parameters = instrument->force_parameters;
        tool.setup.drives = instrument->drives;
        if (const std::string why = bind_law(tool.setup); !why.empty()) {
            refuse_tool(procedure, instrument->id, why, diagnostics);
            continue;
        }
        if (std::string why; !outline_of(tool.setup, tool.outline, why))
            refuse_tool(procedure, instrument->id, why, diagnostics);
        else
            check_width_of_cut(procedure, instrument->id, tool.outline.cutting, diagnostics);
    }
}

/// A plugin that was found and refused is no unknown plugin: the reason is its refusal.
void name_refused_plugins(const PluginRegistry& plugins, Diagnostics& diagnostics) {
    for (Diagnostic& d : diagnostics) {
        if (d.code != "E0301" || d.reason || d.place.column < 1) continue;
        const auto first = static_cast<std::size_t>(d.place.column - 1);
        if (first >= d.source_line.size()) continue;
        std::string id = d.source_line.substr(first, static_cast<std::size_t>(d.place.length));
        std::erase_if(id, [](char c) { return c == '"' || c == '\''; });
        if (const PluginRefusal* refusal = plugins.refusal_for(id); refusal != nullptr)
            d.reason = Reason{SourcePlace{refusal->path, 0, 0, 1}, refusal->why, {}};
    }
}

}  // namespace

std::optional<Documents> check_documents(const DocumentRequest& request, const PluginRegistry& plugins,
                                         Diagnostics& diagnostics) {
    Documents documents;
    auto procedure = read_procedure(request.procedure, plugins.catalog(), diagnostics, request.changes);
    name_refused_plugins(plugins, diagnostics);
    if (!procedure || has_error(diagnostics)) return std::nullopt;
    documents.procedure = std::move(*procedure);
    auto anatomy =
        read_anatomy(request.anatomy.empty() ? documents.procedure.anatomy_file : request.anatomy, diagnostics);
    if (anatomy) {
        documents.anatomy = std::move(*anatomy);
        check_data_files(documents.anatomy, diagnostics);
        if (!has_error(diagnostics)) documents.markup_hashes = add_markups(documents.anatomy, diagnostics);
        if (!has_error(diagnostics)) check_needs(documents.procedure, documents.anatomy, diagnostics);
    }
    documents.device = find_device(documents.procedure.device.c_str());
    check_run(documents.procedure, diagnostics);
    check_implant_files(documents.procedure, diagnostics);
    if (has_error(diagnostics)) return std::nullopt;
    check_bone_memory(documents.procedure, documents.anatomy, diagnostics);
    make_tools(documents, plugins, diagnostics);
    if (has_error(diagnostics)) return std::nullopt;
    return documents;
}

Diagnostics check_variants(const DocumentRequest& request, const Documents& base, const PluginRegistry& plugins) {
    Diagnostics found;
    for (const Variant& variant : base.procedure.variants) {
        DocumentRequest changed = request;
        changed.changes.variant = variant.id;
        Diagnostics of_variant;
        (void)check_documents(changed, plugins, of_variant);
        for (Diagnostic& d : of_variant) {
            if (d.level == Diagnostic::Level::warning) continue;  // said of the base, or of no weight
            d.message = "In the variant `" + variant.id + "`: " + d.message;
            found.push_back(std::move(d));
        }
    }
    return found;
}

}  // namespace kerf
