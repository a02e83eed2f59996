// SPDX-License-Identifier: Apache-2.0
#include "documents/made/mandible/mandible.h"

#include "documents/made/mandible/dimensions.h"
#include "documents/made/mandible/measures.h"
#include "documents/made/mandible/text.h"

namespace kerf::documents {

BoneKind mandible_kind() {
    return {.name = "mandible",
            .a_level = "",
            .frame =
                "Patient axes (LPS): x to the patient's left, y to posterior, z to the head. Seen from the side, the "
                "origin is the corner between the posterior and the lower border of the angle. The Frankfort "
                "horizontal is level. The right side is at negative x.",
            .title = [](const MakeRequest&) -> std::string { return "Lower jaw"; },
            .population = mandible_population,
            .text = mandible_text,
            .measured = measured_mandible};
}

}  // namespace kerf::documents
