// SPDX-License-Identifier: Apache-2.0
#include "run/bone_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "bone/import/fields_memory.h"
#include "documents/read_procedure.h"
#include "documents/solids.h"
#include "documents/yaml/document.h"
#include "text/quantity.h"

namespace kerf {

double bone_memory(const Anatomy& anatomy, double spacing) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    for (const PhantomPart& part : anatomy.phantom.parts) {
        if (part.subtract) continue;
        const Box box = bounds_of(part.solid);
        low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y), std::min(low.z, box.low.z)};
        high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y), std::max(high.z, box.high.z)};
    }
    if (!is_finite(low) || !is_finite(high)) return 0.0;
    std::vector<std::function<double(Vec3)>> borders{[&](Vec3 p) { return distance_to(anatomy.phantom, p); }};
    for (std::size_t t = 0; t + 1 < anatomy.tissues.size(); ++t)
        borders.emplace_back(
            [&, t](Vec3 p) { return distance_to(anatomy.tissues[t], -distance_to(anatomy.phantom, p), p); });
    return fields_memory({low, high}, spacing, borders, false).bytes;
}

void check_bone_memory(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics) {
    if (anatomy.ct || anatomy.mesh) return;
    const double needed = bone_memory(anatomy, procedure.spacing);
    if (needed <= max_bone_memory) return;

    double spacing = procedure.spacing;
    while (bone_memory(anatomy, spacing) > 0.9 * max_bone_memory /* the estimate is a few per cent off */)
        spacing *= 1.05;
    const double rounded = std::ceil(spacing * 1e5) * 1e-5;  // to 0.01 mm

    const auto read = document_of(procedure);
    const Document& document = *read;
    const Node* accuracy = document.root.find("accuracy");
    const Node* node = accuracy != nullptr ? accuracy->find("spacing") : nullptr;
    constexpr double gigabyte = 1024.0 * 1024 * 1024;
    Report(document, diagnostics)
        .error(Code::too_fine, node != nullptr ? node->span : TextSpan{},
               "At a spacing of " + quantity_text(procedure.spacing, "mm") + " this bone takes about " +
                   quantity_text(std::ceil(needed / gigabyte), "") + " GB of memory, must be at most " +
                   quantity_text(max_bone_memory / gigabyte, "") + " GB.",
               quantity_text(rounded, "mm"));
}

}  // namespace kerf
