// SPDX-License-Identifier: Apache-2.0
#include "documents/made/vertebra/vertebra.h"

#include "documents/made/vertebra/dimensions.h"
#include "documents/made/vertebra/measures.h"
#include "documents/made/vertebra/text.h"

namespace kerf::documents {

BoneKind vertebra_kind() {
    return {.name = "vertebra",
            .a_level = "the level of the vertebra",
            .levels = vertebra_levels(),
            .example_level = "L3",
            .frame = "Patient axes (LPS): x to the patient's left, y to posterior, z to the head. The origin is the "
                     "middle of the body. The right pedicle is at negative x.",
            .title = [](const MakeRequest& request) { return "Vertebra " + request.level; },
            .population = vertebra_population,
            .text = vertebra_text,
            .measured = measured_vertebra};
}

}  // namespace kerf::documents
