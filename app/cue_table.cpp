// SPDX-License-Identifier: Apache-2.0
#include "app/cue_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "app/make_bone.h"
#include "app/run_hand.h"
#include "app/standard_streams.h"
#include "documents/yaml/read_map.h"
#include "run/cues/cue_audit.h"
#include "run/scene.h"

namespace kerf::app {

namespace {

/// Returns a cue as a cell: "12.4", or "-" without one.
std::string in_steps(const std::optional<double>& cue) { return cue ? formatted("%.1f", *cue) : "-"; }

void print_table(const std::vector<run::StepCues>& cues) {
    std::size_t width = 4;
    for (const run::StepCues& step : cues) width = std::max(width, step.step.size());
    const auto padded = [&](std::string text) { return text.append(width - text.size(), ' '); };
    print("  " + padded("step") + "  in bone   below friction   saturated   contrast   breakthrough\n");
    for (const run::StepCues& step : cues)
        print("  " + padded(step.step) +
              formatted("  %5.1f s   %11.0f %%   %7.0f %%   %8s   %12s\n", step.time_in_bone,
                        100.0 * step.below_friction, 100.0 * step.saturated, in_steps(step.contrast).c_str(),
                        in_steps(step.exit).c_str()));
    print("  contrast: of the densest tissue with the next one; breakthrough: fall of the force at the last one. Both "
          "in\n"
          "  just-noticeable differences of 7 %; less than 1 is not felt\n");
}

}  // namespace

ExitCode print_cues(const run::Documents& documents, const std::string& file, const std::string& device,
                    const Environment& with) {
    const DeviceRecord* const record = find_device(device.c_str());
    if (record == nullptr)
        return complain(
            "there is no model of a device `" + device + "`. " + documents::write_instead(device, device_ids()),
            exit_bad_input);
    const auto& rehearsals = documents.procedure.rehearsals;
    const auto passing =
        std::find_if(rehearsals.begin(), rehearsals.end(), [](const auto& r) { return r.expect == "pass"; });
    if (passing == rehearsals.end())
        return complain(file + ": no rehearsal expects to pass, so there is no hand to feel with. Add one.",
                        exit_bad_input);
    run::Documents changed = documents;
    changed.device = record;
    text::Diagnostics diagnostics;
    const auto scene = make_bone(std::move(changed), file).take(diagnostics);
    if (!scene) {
        print_error(to_text(diagnostics));
        return exit_bad_input;
    }
    run::CueAudit audit(*scene);
    run::RunOutcome outcome;
    if (const ExitCode code = run_hand(*scene, passing->id, with, outcome, &audit); code != exit_pass) return code;
    print(file + " by `" + passing->id + "` on " + device +
          formatted(": force scale 1/%.0f, friction %.2f N, peak %.1f N, verdict ", 1.0 / scene->gains.force_scale,
                    record->friction, record->peak_force) +
          to_text(outcome.summary.verdict) + "\n");
    print_table(audit.cues());
    return exit_pass;
}

}  // namespace kerf::app
