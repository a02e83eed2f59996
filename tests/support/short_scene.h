// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "run/documents.h"
#include "run/scene.h"
#include "tests/support/drill_rig.h"

namespace kerf::test {

/// Returns the shipped pedicle screw with changes, in a bone of boxes on a coarse grid, and over after fifteen seconds:
/// the drill has met bone.
inline run::Scene scene_with(const std::vector<std::string>& settings) {
    text::Diagnostics diagnostics;
    run::DocumentRequest request{.procedure = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml",
                                 .anatomy = KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml"};
    // Tests replace the limits that these rehearsals name.
    request.changes.settings = {"accuracy.spacing=0.5 mm", "time_limit=15 s", "rehearsals.hasty=~",
                                "rehearsals.drilled-twice=~", "rehearsals.lateral-exit=~"};
    request.changes.settings.insert(request.changes.settings.end(), settings.begin(), settings.end());
    auto documents = run::check_documents(request, test::plugins()).take(diagnostics);
    auto made = documents ? make_scene(std::move(*documents)).take(diagnostics) : std::nullopt;
    if (!made) throw std::runtime_error(to_text(diagnostics));
    return std::move(*made);
}

inline const run::Scene& short_scene() {
    static const run::Scene scene = scene_with({});
    return scene;
}

}  // namespace kerf::test
