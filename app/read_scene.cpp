// SPDX-License-Identifier: Apache-2.0
#include "app/read_scene.h"

#include <utility>

#include "app/make_bone.h"

namespace kerf::app {

run::DocumentRequest request_of(const std::string& file, const DocumentOptions& options, const Installation& here) {
    return {file, options.anatomy, options.changes(), here.procedures()};
}

text::Result<run::Scene> make_scene(const std::string& file, const DocumentOptions& options, const Environment& with,
                                    const bone::ImportOptions& import_options) {
    text::Diagnostics diagnostics;
    auto documents = run::check_documents(request_of(file, options, with.here), with.plugins).take(diagnostics);
    if (!documents) return diagnostics;
    auto scene = make_bone(std::move(*documents), file, import_options).take(diagnostics);
    if (!scene) return diagnostics;
    return {std::move(*scene), std::move(diagnostics)};
}

std::optional<run::Scene> read_scene(const std::string& file, const DocumentOptions& options, const Environment& with) {
    text::Diagnostics diagnostics;
    auto scene = make_scene(file, options, with).take(diagnostics);
    return with_findings(std::move(scene), diagnostics);
}

}  // namespace kerf::app
