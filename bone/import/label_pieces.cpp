// SPDX-License-Identifier: Apache-2.0
#include "bone/import/label_pieces.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "bone/report/import_report.h"
#include "documents/read_anatomy.h"

namespace kerf::bone {

void check_label_pieces(const BoneMask& mask, const documents::Anatomy& anatomy, text::Diagnostics& diagnostics) {
    constexpr std::size_t max_listed = 4;
    const std::size_t kept = anatomy.ct->keep.size() + anatomy.ct->keep_named.size();
    const std::vector<BonePiece> pieces = bone_pieces(mask);
    const auto stray = std::find_if(pieces.begin() + static_cast<std::ptrdiff_t>(std::min(kept, pieces.size())),
                                    pieces.end(), [](const BonePiece& piece) { return !piece.is_at_grid_face; });
    if (stray == pieces.end()) return;
    std::string sizes;
    const std::size_t listed = std::min(pieces.size(), max_listed);
    for (std::size_t n = 0; n < listed; ++n)
        sizes += (n == 0 ? "" : n + 1 == pieces.size() ? " and " : ", ") + std::to_string(pieces[n].voxels);
    if (pieces.size() > listed) sizes += " and less";
    const Vec3 where = mask.image.lps({static_cast<double>(stray->first[0]), static_cast<double>(stray->first[1]),
                                       static_cast<double>(stray->first[2])});
    diagnostics.push_back(text::warning_at(
        documents::in_anatomy(anatomy, {"ct", "labels", "keep"}), "W0679",
        "the kept labels are " + std::to_string(pieces.size()) + " pieces, of " + sizes + " voxels; one of " +
            std::to_string(stray->voxels) + " lies at " + rounded(where.x * 1e3, 1) + " " + rounded(where.y * 1e3, 1) +
            " " + rounded(where.z * 1e3, 1) +
            " mm. All are bone. To keep one, write `keep: {component_at: LANDMARK}` under `ct`; or remove the stray "
            "pieces from the label map."));
}

}  // namespace kerf::bone
