// SPDX-License-Identifier: Apache-2.0
#include "app/make_bone.h"

#include <utility>

#include "app/progress.h"
#include "app/standard_streams.h"

namespace kerf::app {

void print_notes(const std::optional<run::Scene>& scene) {
    if (!scene) return;
    for (const auto& note : scene->import.notes) print_error(note + "\n");
}

text::Result<run::Scene> make_bone(run::Documents documents, const std::string& file, bone::ImportOptions options,
                                   const std::function<void(double)>& also) {
    StillWorking sign_of_life("making the bone of " + file);
    options.progress = [&](double fraction, const std::string& what) {
        sign_of_life.is_at(fraction, what);
        if (also) also(fraction);
    };
    return make_scene(std::move(documents), options);
}

std::optional<run::Scene> with_findings(std::optional<run::Scene> scene, const text::Diagnostics& diagnostics) {
    if (!diagnostics.empty()) print_error(to_text(diagnostics));
    print_notes(scene);
    return scene;
}

}  // namespace kerf::app
