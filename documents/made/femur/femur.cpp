// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/femur.h"

#include "documents/made/femur/dimensions.h"
#include "documents/made/femur/proximal_measures.h"
#include "documents/made/femur/proximal_text.h"

namespace kerf::documents {

BoneKind femur_kind() {
    return {.name = "femur",
            .a_level = "the end of the femur",
            .levels = {"proximal"},
            .example_level = "proximal",
            .frame = "A left femur. Patient axes (LPS): x to the patient's left, which is lateral here, y to posterior, "
                     "z to the head. The origin is where the axes of neck and shaft meet. The leg is turned inwards by "
                     "the version of the neck, as on a fracture table: the neck lies in the plane y = 0.",
            .title = [](const MakeRequest&) { return std::string("Broken upper end of a left femur"); },
            .population = femur_population,
            .text = proximal_femur_text,
            .measured = measured_proximal_femur};
}

}  // namespace kerf::documents
