// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/femur.h"

#include "documents/made/femur/dimensions.h"
#include "documents/made/femur/distal_measures.h"
#include "documents/made/femur/distal_text.h"
#include "documents/made/femur/proximal_measures.h"
#include "documents/made/femur/proximal_text.h"

namespace kerf::documents {
namespace {

bool is_proximal(const MakeRequest& request) { return request.level == "proximal"; }

}  // namespace

BoneKind femur_kind() {
    return {.name = "femur",
            .a_level = "the end of the femur",
            .levels = {"proximal", "distal"},
            .example_level = "proximal",
            .frame =
                "Patient axes (LPS): x to the patient's left, y to posterior, z to the head. The upper end is of a "
                "left femur: x is lateral, and the origin is where the axes of neck and shaft meet. The leg is "
                "turned inwards by the version of the neck, as on a fracture table: the neck lies in the plane "
                "y = 0. The lower end is of a right femur: x is medial, and the origin is the middle of the shaft "
                "in the plane of the cut.",
            .title =
                [](const MakeRequest& request) {
                    return std::string(is_proximal(request) ? "Broken upper end of a left femur"
                                                            : "Lower end of a right femur");
                },
            .population = femur_population,
            .text =
                [](const MakeRequest& request, const DimensionValues& v) {
                    return is_proximal(request) ? proximal_femur_text(request, v) : distal_femur_text(request, v);
                },
            .measured =
                [](const Anatomy& anatomy) {
                    std::vector<MeasuredDimension> found = measured_proximal_femur(anatomy);
                    return found.empty() ? measured_distal_femur(anatomy) : found;
                }};
}

}  // namespace kerf::documents
