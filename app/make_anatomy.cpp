// SPDX-License-Identifier: Apache-2.0
#include "app/make_anatomy.h"

#include <algorithm>
#include <optional>

#include "documents/made/read_request.h"
#include "documents/yaml/document.h"
#include "documents/yaml/read_map.h"
#include "text/source.h"

namespace kerf::app {
namespace {

/// Returns a YAML text in quotation marks.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// Writes the options as the map `anatomy:` of a procedure, so that both are read and checked alike.
std::string request_text(const AnatomyOptions& options) {
    std::string text = "make: " + quoted(options.anatomy) + "\n";
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty()) text += std::string(key) + ": " + quoted(value) + "\n";
    };
    add("level", options.level);
    add("sex", options.sex);
    add("height", options.height);
    add("age", options.age);
    if (options.is_osteoporotic) text += "osteoporosis: true\n";
    add("seed", options.seed);
    if (options.settings.empty()) return text;
    text += "set:\n";
    for (const std::string& setting : options.settings) {
        const std::size_t equals = setting.find('=');
        text += "  " + quoted(setting.substr(0, equals)) + ": " + quoted(setting.substr(equals + 1)) + "\n";
    }
    return text;
}

}  // namespace

text::Result<documents::MadeBone> make_bone_of(const AnatomyOptions& options) {
    text::Diagnostics diagnostics;
    auto document = documents::parse_document("options of kerf anatomy make", request_text(options)).take(diagnostics);
    if (!document) return diagnostics;
    documents::Report report(*document, diagnostics);
    const std::optional<documents::MakeRequest> request = documents::read_make_request(document->root, "", report);
    if (!request || text::has_error(diagnostics)) return diagnostics;
    return {documents::make_bone(*request), std::move(diagnostics)};
}

std::string made_bone_text(const documents::MadeBone& bone) {
    std::string text = bone.title + "\n" + documents::table_of_dimensions(bone, "  ");
    if (bone.drawn.redraws > 0)
        text += "Drawn again " + std::to_string(bone.drawn.redraws) + (bone.drawn.redraws == 1 ? " time" : " times") +
                ": the dimensions contradicted each other before.\n";
    return text;
}

std::string description_of_bone(const std::string& wanted, std::string& error) {
    const std::size_t slash = wanted.find('/');
    documents::MakeRequest request;
    request.kind = wanted.substr(0, slash);
    const auto has = [](const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (!has(documents::made_kinds(), request.kind)) return {};
    const documents::BoneKind& kind = documents::bone_kind(request.kind);
    request.level = slash == std::string::npos ? kind.example_level : wanted.substr(slash + 1);
    if (kind.levels.empty() && slash != std::string::npos) {
        error = "`" + kind.name + "` has no levels. Write `kerf describe " + kind.name + "`.";
        return {};
    }
    if (!kind.levels.empty() && !has(kind.levels, request.level)) {
        error = "the level of `" + text::shown(wanted) + "` is unknown: expected " +
                documents::listed(kind.levels, request.level) + ". Write `kerf describe " + kind.name + "/" +
                kind.example_level + "`.";
        return {};
    }
    return wanted + "  (a bone to make)\n  `kerf anatomy make " + request.kind +
           (request.level.empty() ? std::string() : " --level " + request.level) +
           "` makes one. Means and standard deviations of adults; each sex has its own.\n  dimensions\n" +
           documents::described_dimensions(request);
}

}  // namespace kerf::app
