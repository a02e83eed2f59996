// SPDX-License-Identifier: Apache-2.0
#include "app/read_scene.h"

#include <utility>

#include "app/make_bone.h"

namespace kerf {

DocumentRequest request_of(const std::string& file, const CommandLine& line) {
    return {file, line.anatomy, {line.variant, line.settings}, line.shipped};
}

std::optional<Scene> make_scene(const std::string& file, const CommandLine& line, const PluginRegistry& plugins,
                                Diagnostics& diagnostics, const ImportOptions& options) {
    auto documents = check_documents(request_of(file, line), plugins, diagnostics);
    return documents ? make_bone(std::move(*documents), file, diagnostics, options) : std::nullopt;
}

std::optional<Scene> read_scene(const std::string& file, const CommandLine& line, const PluginRegistry& plugins) {
    Diagnostics diagnostics;
    auto scene = make_scene(file, line, plugins, diagnostics);
    return with_findings(std::move(scene), diagnostics);
}

}  // namespace kerf
