// SPDX-License-Identifier: Apache-2.0
#include "app/make_bone.h"

#include <utility>

#include "app/progress.h"
#include "app/standard_streams.h"

namespace kerf {

void print_notes(const std::optional<Scene>& scene) {
    if (!scene) return;
    for (const auto& note : scene->import.notes) print_error(note + "\n");
}

Result<Scene> make_bone(Documents documents, const std::string& file, ImportOptions options) {
    StillWorking sign_of_life("making the bone of " + file);
    options.progress = [&](double fraction, const std::string& what) { sign_of_life.is_at(fraction, what); };
    return make_scene(std::move(documents), options);
}

std::optional<Scene> with_findings(std::optional<Scene> scene, const Diagnostics& diagnostics) {
    if (!diagnostics.empty()) print_error(to_text(diagnostics));
    print_notes(scene);
    return scene;
}

}  // namespace kerf
