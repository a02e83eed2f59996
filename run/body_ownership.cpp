// SPDX-License-Identifier: Apache-2.0
#include "run/body_ownership.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/field/surface/bone_surface.h"
#include "documents/fracture.h"
#include "documents/solids.h"

namespace kerf::run {

namespace {

void inherit(Owners& owners, std::size_t from, const std::vector<std::size_t>& bodies, const Scene& scene,
             const PresentBone& bone) {
    if (bodies.size() < 2) return;
    std::vector<Mesh> parts;
    parts.reserve(bodies.size());
    for (const std::size_t body : bodies) parts.push_back(bone_surface(*bone.piece(body).bone, bone.cut(body), 2));
    const auto nearest_to = [&](const auto& distance) {
        std::size_t nearest = 0;
        double least = HUGE_VAL;
        for (std::size_t n = 0; n < parts.size(); ++n)
            for (const Vec3 vertex : parts[n].vertices)
                if (const double d = distance(vertex); d < least) {
                    least = d;
                    nearest = n;
                }
        return bodies[nearest];
    };
    for (std::size_t z = 0; z < owners.zone.size(); ++z)
        if (owners.zone[z] == from)
            owners.zone[z] =
                nearest_to([&](Vec3 p) { return documents::distance_to_any(scene.anatomy.zones[z].solids, p); });
    for (std::size_t s = 0; s < owners.step.size(); ++s)
        if (owners.step[s] == from)
            owners.step[s] = nearest_to([&](Vec3 p) { return length(p - scene.frames[s].entry); });
}

}  // namespace

BodyOwnership body_ownership_of(const Scene& scene) {
    BodyOwnership belongings;
    for (const documents::Zone& zone : scene.anatomy.zones) {
        const Box box = bounds_of(zone.solids);
        belongings.owners.zone.push_back(documents::body_at(scene.anatomy, 0.5 * (box.low + box.high)));
    }
    for (const AxisFrame& frame : scene.frames)
        belongings.owners.step.push_back(documents::body_at(scene.anatomy, frame.entry));
    belongings.inherit = [&scene](Owners& owners, std::size_t from, const std::vector<std::size_t>& bodies,
                                  const PresentBone& bone) { inherit(owners, from, bodies, scene, bone); };
    return belongings;
}

}  // namespace kerf::run
