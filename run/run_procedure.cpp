// SPDX-License-Identifier: Apache-2.0
#include "run/run_procedure.h"

#include "documents/yaml/read_map.h"
#include "run/run.h"

namespace kerf::run {

std::string refusal_of_rehearsal(const documents::Procedure& procedure, const std::string& id) {
    std::vector<std::string> known;
    for (const documents::Rehearsal& r : procedure.rehearsals) {
        if (id.empty() || r.id == id) return "";
        known.push_back(r.id);
    }
    return known.empty() ? "the procedure has no rehearsal, and there is no device. Add one under `rehearsals:`."
                         : "there is no rehearsal `" + id + "`. " + documents::write_instead(id, known);
}

const documents::Rehearsal& rehearsal_of(const documents::Procedure& procedure, const std::string& id) {
    return *std::find_if(procedure.rehearsals.begin(), procedure.rehearsals.end(),
                         [&](const documents::Rehearsal& r) { return id.empty() || r.id == id; });
}

RunOutcome run_procedure(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request) {
    RunOutcome outcome;
    const auto run = Run::create(scene, plugins, request, outcome);
    if (run == nullptr) return outcome;
    while (run->step()) {
    }
    return run->finish();
}

}  // namespace kerf::run
