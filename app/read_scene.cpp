// SPDX-License-Identifier: Apache-2.0
#include "app/read_scene.h"

#include <utility>

#include "app/make_bone.h"

namespace kerf {

DocumentRequest request_of(const std::string& file, const DocumentOptions& options, const Installation& here) {
    return {file, options.anatomy, {options.variant, options.settings}, here.procedures()};
}

std::optional<Scene> make_scene(const std::string& file, const DocumentOptions& options, const Environment& with,
                                Diagnostics& diagnostics, const ImportOptions& import_options) {
    auto documents = check_documents(request_of(file, options, with.here), with.plugins, diagnostics);
    return documents ? make_bone(std::move(*documents), file, diagnostics, import_options) : std::nullopt;
}

std::optional<Scene> read_scene(const std::string& file, const DocumentOptions& options, const Environment& with) {
    Diagnostics diagnostics;
    auto scene = make_scene(file, options, with, diagnostics);
    return with_findings(std::move(scene), diagnostics);
}

}  // namespace kerf
