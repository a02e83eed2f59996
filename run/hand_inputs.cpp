// SPDX-License-Identifier: Apache-2.0
#include "run/hand_inputs.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace kerf::run {

std::vector<documents::HandInput> HandInputs::take(std::uint64_t tick, std::size_t legs, bool is_regripping) {
    std::vector<documents::HandInput> inputs;
    if (recorded_ == nullptr) {
        if (legs == next_ && next_ < plan_->inputs.size()) inputs = plan_->inputs[next_];
        next_ = std::max(next_, legs + 1);  // waypoints that a hand skipped have no inputs
        // First, because the hand regrips before it releases an implant.
        if (is_regripping != std::exchange(is_regripping_, is_regripping))
            inputs.insert(inputs.begin(), {documents::HandInput::Kind::regrip, {}, is_regripping ? 1.0 : 0.0});
    } else {
        for (; next_ < recorded_->size() && (*recorded_)[next_].first <= tick; ++next_)
            inputs.push_back((*recorded_)[next_].second);
    }
    return inputs;
}

namespace {

/// Inserts an implant at the tool, or at its planned pose. An implant with a planned pose must fit the bone in both
/// cases.
std::string bring_in(const documents::HandInput& input, const Scene& scene, Simulation& simulation) {
    const auto implant = std::find_if(scene.implants.begin(), scene.implants.end(),
                                      [&](const Body& body) { return body.id == input.id; });
    if (implant == scene.implants.end()) return "there is no implant " + input.id;
    const std::optional<Pose>& planned = scene.planned[static_cast<std::size_t>(implant - scene.implants.begin())];
    const bool is_placed = input.kind == documents::HandInput::Kind::place;
    if (is_placed && !planned) return "the implant " + input.id + " has no planned pose";
    const Pose pose = is_placed ? *planned : simulation.world_from_tool();
    if (planned)
        if (std::string why_not = misfit(fit_of(*implant, pose, BoneAround(simulation))); !why_not.empty())
            return why_not;
    return simulation.insert(*implant, pose, false);
}

}  // namespace

std::string carry_out(const documents::HandInput& input, const Scene& scene, Simulation& simulation) {
    switch (input.kind) {
        case documents::HandInput::Kind::drive: {
            const kerf_tool& tool = *simulation.setup().tool->tool;
            for (std::uint32_t i = 0; i < tool.drive_count; ++i)
                if (input.id == tool.drives[i].id) {
                    simulation.command_drive(i, input.value);
                    return {};
                }
            return "the tool in hand has no drive " + input.id;
        }
        case documents::HandInput::Kind::insert:
        case documents::HandInput::Kind::place:
            return bring_in(input, scene, simulation);
        case documents::HandInput::Kind::subtract:
            simulation.subtract(simulation.tool(), simulation.world_from_tool());
            return {};
        case documents::HandInput::Kind::remove:
            if (simulation.held() < 0) return "nothing is held";
            simulation.remove_held();
            return {};
        case documents::HandInput::Kind::fuse:
            return simulation.fuse();
        case documents::HandInput::Kind::release:
            return scene.tools[simulation.tool()].outline.is_implant() ? "" : "the tool in hand is no implant";
        case documents::HandInput::Kind::regrip:
            if (input.value != 0.0 && !scene.tools[simulation.tool()].outline.has_thread())
                return "the tool in hand has no thread, so it is not turned by regripping";
            simulation.loosen_about_shaft(input.value != 0.0);
            return {};
        case documents::HandInput::Kind::undo:
            return simulation.undo();
        case documents::HandInput::Kind::redo:
            return simulation.redo();
    }
    return {};
}

}  // namespace kerf::run
