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
#include "text/codes.h"
#include "text/quantity.h"

namespace kerf::run {

double bone_memory(const documents::Anatomy& anatomy, double spacing) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    for (const documents::PhantomPart& part : anatomy.phantom.parts) {
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
    return bone::fields_memory({low, high}, spacing, borders, false).bytes;
}

void check_bone_memory(const documents::Procedure& procedure, const documents::Anatomy& anatomy,
                       text::Diagnostics& diagnostics) {
    if (anatomy.ct || anatomy.mesh) return;
    const double needed = bone_memory(anatomy, procedure.spacing);
    if (needed <= bone::max_bone_memory) return;

    double spacing = procedure.spacing;
    while (bone_memory(anatomy, spacing) > 0.9 * bone::max_bone_memory /* the estimate is a few per cent off */)
        spacing *= 1.05;
    const double rounded = std::ceil(spacing * 1e5) * 1e-5;  // to 0.01 mm

    const auto read = documents::document_of(procedure);
    const documents::Document& document = *read;
    const documents::Node* accuracy = document.root.find("accuracy");
    const documents::Node* node = accuracy != nullptr ? accuracy->find("spacing") : nullptr;
    constexpr double gigabyte = 1024.0 * 1024 * 1024;
    documents::Report(document, diagnostics)
        .error(text::Code::too_fine, node != nullptr ? node->span : documents::TextSpan{},
               "At a spacing of " + text::quantity_text(procedure.spacing, "mm") + " this bone takes about " +
                   text::quantity_text(std::ceil(needed / gigabyte), "") + " GB of memory, must be at most " +
                   text::quantity_text(bone::max_bone_memory / gigabyte, "") + " GB.",
               text::quantity_text(rounded, "mm"));
}

}  // namespace kerf::run
