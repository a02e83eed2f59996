// SPDX-License-Identifier: Apache-2.0
#include "run/hand_inputs.h"

#include <algorithm>
#include <cstdint>

#include "run/arm_views.h"

namespace kerf::run {

bool carry_out_at(HapticLoop& loop, const documents::HandInput& input) noexcept {
    if (input.kind == documents::HandInput::Kind::regrip) {
        if (input.value != 0.0 && !loop.outline().has_thread()) return false;
        loop.loosen_about_shaft(input.value != 0.0);
        return true;
    }
    const kerf_tool& tool = *loop.setup().tool->tool;
    for (std::uint32_t i = 0; i < tool.drive_count; ++i)
        if (input.id == tool.drives[i].id) {
            loop.command_drive(i, input.value);
            return true;
        }
    return false;
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
        case documents::HandInput::Kind::drive:
            return carry_out_at(simulation, input) ? "" : "the tool in hand has no drive " + input.id;
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
            return carry_out_at(simulation, input)
                       ? ""
                       : "the tool in hand has no thread, so it is not turned by regripping";
        case documents::HandInput::Kind::pause:
        case documents::HandInput::Kind::assist:
            return {};
        case documents::HandInput::Kind::image:
            return is_arm_angle(input.value) && is_arm_angle(input.tilt)
                       ? ""
                       : "an angle of the C-arm is not -360 deg to 360 deg";
        case documents::HandInput::Kind::undo:
            return simulation.undo();
        case documents::HandInput::Kind::redo:
            return simulation.redo();
    }
    return {};
}

}  // namespace kerf::run
