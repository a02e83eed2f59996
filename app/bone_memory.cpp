// SPDX-License-Identifier: Apache-2.0
#include "app/bone_memory.h"

#include <algorithm>
#include <cmath>

#include "core/field/grid.h"
#include "core/procedure/document.h"
#include "core/procedure/quantity.h"
#include "core/procedure/solids.h"

namespace kerf {

namespace {

constexpr int probes = 20'000;
constexpr double margin_voxels = 6.0;  // of air around the bone

}  // namespace

double bone_memory(const Anatomy& anatomy, double spacing) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    for (const PhantomPart& part : anatomy.phantom.parts) {
        if (part.subtract) continue;
        const Box box = bounds_of(part.solid);
        low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y), std::min(low.z, box.low.z)};
        high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y), std::max(high.z, box.high.z)};
    }
    if (!is_finite(low) || !is_finite(high)) return 0.0;
    const Vec3 extent = high - low + 2.0 * margin_voxels * spacing * Vec3{1, 1, 1};
    const double edge = brick_edge * spacing;
    const double bricks = extent.x / edge * (extent.y / edge) * (extent.z / edge);

    // Scattered evenly and without a seed: multiples of the plastic number's powers, modulo 1.
    constexpr double g = 1.22074408460575947536;
    const double reach = (0.5 * brick_edge * std::sqrt(3.0) + clamp_voxels) * spacing;
    const auto part_of = [](double value) { return value - std::floor(value); };
    double near = 0.0;  // probes near a border, summed over the fields
    for (int i = 1; i <= probes; ++i) {
        const Vec3 at{part_of(i / g), part_of(i / (g * g)), part_of(i / (g * g * g))};
        const Vec3 p =
            low + Vec3{at.x * extent.x, at.y * extent.y, at.z * extent.z} - margin_voxels * spacing * Vec3{1, 1, 1};
        const double distance = distance_to(anatomy.phantom, p);
        near += std::abs(distance) <= reach;
        for (std::size_t t = 0; t + 1 < anatomy.tissues.size(); ++t)
            near += std::abs(distance + anatomy.tissues[t].thickness) <= reach;
    }
    const double fields = static_cast<double>(std::max<std::size_t>(1, anatomy.tissues.size()));
    return bricks * (fields * sizeof(std::int32_t) + near / probes * stored_samples * sizeof(std::int16_t));
}

void check_bone_memory(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics) {
    if (anatomy.ct || anatomy.mesh) return;
    const double needed = bone_memory(anatomy, procedure.spacing);
    if (needed <= most_bone_memory) return;

    double spacing = procedure.spacing;
    while (bone_memory(anatomy, spacing) > 0.9 * most_bone_memory /* the estimate is a few per cent off */)
        spacing *= 1.05;
    const double rounded = std::ceil(spacing * 1e5) * 1e-5;  // to 0.01 mm

    const Document document = read_again(procedure.file, procedure.text);
    const Node* accuracy = document.root.find("accuracy");
    const Node* node = accuracy != nullptr ? accuracy->find("spacing") : nullptr;
    constexpr double gigabyte = 1024.0 * 1024 * 1024;
    Report(document, diagnostics)
        .error(Code::too_fine, node != nullptr ? node->span : TextSpan{},
               "At a spacing of " + quantity_text(procedure.spacing, "mm") + " this bone takes about " +
                   quantity_text(std::ceil(needed / gigabyte), "") + " GB of memory, must be at most " +
                   quantity_text(most_bone_memory / gigabyte, "") + " GB.",
               quantity_text(rounded, "mm"));
}

}  // namespace kerf
