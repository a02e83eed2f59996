// SPDX-License-Identifier: Apache-2.0
#include "run/tick_row.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "text/quantity.h"

namespace kerf::run {

double tip_inside(const Simulation& simulation, const StepMonitor& monitor, Vec3 tip) {
    const auto& owners = monitor.owners().step;
    const LiveBody& owner =
        *simulation.bodies()[owners.empty() ? 0 : owners[std::min(monitor.current(), owners.size() - 1)]];
    const auto inside = [&](const LiveBody& live) {
        return -uncut_distance(*live.bone, locate(*live.bone, inverse(live.world_from_body) * tip));
    };
    double deepest = inside(owner);
    // Parts separated by a cut have the same uncut bone. A fragment of a fracture has its own.
    for (const auto& live : simulation.bodies())
        if (live->is_present && live->is_cuttable && live->bone != owner.bone)
            deepest = std::max(deepest, inside(*live));
    return deepest;
}

std::int32_t tissue_at(const Scene& scene, const Simulation& simulation, Vec3 tip) {
    // One voxel ahead, because the tip is on the border of its own cut.
    const Vec3 ahead = tip + scene.procedure.spacing * rotate(simulation.world_from_tool().rotation, {0, 0, 1});
    for (const auto& live : simulation.bodies()) {
        if (!live->is_present || !live->is_cuttable) continue;
        const Body& bone = *live->bone;
        const LocatedPoint place = locate(bone, inverse(live->world_from_body) * ahead);
        if (std::max(bone.surface.at(place), simulation.exact(live->id).at(place)) > 0.0) continue;
        double weight[KERF_MAX_TISSUES];
        material_weights(bone, place, weight);
        return static_cast<std::int32_t>(std::max_element(weight, weight + bone.materials.size()) - weight);
    }
    return -1;
}

session::TickRow row_of(const TickResult& result, const Scene& scene, const Simulation& simulation,
                        const StepMonitor& monitor, const SignalTable& signals, const Pose& world_from_handle,
                        std::int32_t tissue, double removed) {
    session::TickRow row;
    row.tick = simulation.ticks() - 1;
    row.time = static_cast<double>(row.tick) * Simulation::dt;
    row.step = monitor.current() < scene.procedure.steps.size() ? static_cast<std::int32_t>(monitor.current()) : -1;
    row.device_from_handle = world_from_handle;
    row.world_from_tool = result.world_from_tool;
    row.modelled = result.bone_on_tool;
    row.coupled = result.coupled_on_hand;
    row.limited = result.limited_on_hand;
    row.commanded = result.command.wrench;
    row.thrust = result.thrust;
    row.torque = result.torque;
    row.depth =
        monitor.frame(std::min(monitor.current(), scene.frames.size() - 1)).depth_of(result.world_from_tool.position);
    row.feed_rate = result.rate[2];
    row.tissue = tissue;
    row.iterations = result.iterations;
    row.power_hand = result.power_hand;
    row.removed = removed;
    signals.fill(simulation, row);
    return row;
}

std::string event_detail(const std::string& event, const Simulation& simulation) {
    if (event == "haptics.quarantined") return text_of(simulation.law_fault());
    if (event == "haptics.law_made_energy") {
        const MadeEnergy& made = simulation.ledger().last();
        const auto in_mj = [](double v) { return text::quantity_text(std::round(v * 1e5) * 1e-5, "mJ"); };
        return name_of_law(*simulation.setup().force) + ": within a second it gave the tool " + in_mj(made.made) +
               " that it had never taken; its work in all was " + in_mj(made.through);
    }
    if (event != "haptics.unresisted") return "";
    const auto in_mm = [](double v) { return text::quantity_text(std::round(v * 1e4) * 1e-4, "mm"); };
    const Unresisted& where = simulation.unresisted();
    return "the tool, " + in_mm(-where.point.z) + " behind its tip, is " + in_mm(where.depth) +
           " or more in uncut bone, and no channel of " + name_of_law(*simulation.setup().force) + " resists it there";
}

}  // namespace kerf::run
