// SPDX-License-Identifier: Apache-2.0
#include "run/zone_rows.h"

#include <algorithm>
#include <cstddef>

#include "documents/solid_mesh.h"

namespace kerf::run {

void add_zone_rows(const StepMonitor& monitor, const Scene& scene, const Simulation& simulation,
                   session::RunSummary& summary) {
    const std::vector<documents::Zone>& zones = scene.anatomy.zones;
    for (std::size_t z = 0; z < zones.size(); ++z) {
        const Pose& world_from_owner = simulation.bodies()[monitor.owners().zone[z]]->world_from_body;
        bool is_limited = false;
        for (const StepState& state : monitor.steps()) {
            const LimitState* closest = nullptr;  // a step may have several limits on one zone
            for (const LimitState& limit : state.limits) {
                if (limit.limit->quantity != "clearance" || limit.limit->zone != zones[z].id) continue;
                is_limited = true;
                if (limit.closest && (closest == nullptr || limit.worst < closest->worst)) closest = &limit;
            }
            if (closest != nullptr)
                summary.approaches.push_back({state.step->id, zones[z].id, closest->worst, closest->closest->time,
                                              world_from_owner * closest->closest->at});
        }
        if (zones[z].is_tissue && !is_limited) continue;
        Mesh surface = documents::mesh_of(zones[z].solids);
        for (Vec3& vertex : surface.vertices) vertex = world_from_owner * vertex;
        for (Vec3& normal : surface.normals) normal = rotate(world_from_owner.rotation, normal);
        summary.zones.push_back({zones[z].id, session::drawn_surface(surface)});
    }
}

}  // namespace kerf::run
