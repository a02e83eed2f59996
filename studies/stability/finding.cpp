// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/finding.h"

#include "studies/drawing/svg.h"

namespace kerf::stability {

std::string figure(double value, const char* unit) {
    return drawing::figure(value) + (*unit != '\0' ? std::string(" ") + unit : "");
}

}  // namespace kerf::stability
