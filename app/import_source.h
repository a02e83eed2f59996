// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/source.h"

namespace kerf {

/// What `kerf import` is asked for.
struct ImportRequest {
    std::string source;         ///< a scan's file, a folder with DICOM, or a surface
    std::string out;            ///< .nrrd for a scan, .stl for a surface; empty: nothing is written
    std::string series;         ///< of a folder with several
    std::string acquisition;    ///< of a series with several
    bool may_resample = false;  ///< across missing slices
    std::string unit = "mm";    ///< of a surface: mm, cm, m or um
    std::string frame;          ///< of a surface: LPS or RAS; empty: as the file says, or else LPS
};

struct ImportOutcome {
    std::string text;         ///< what was found and done, for people
    Diagnostics diagnostics;  ///< what was refused or doubted
    std::string error;        ///< why nothing could be written; empty if all went well
};

/// Opens what a source holds, looks at all of it, and writes it put straight: LPS, at right angles, closed. Nothing of
/// whose it is goes anywhere.   [main]
[[nodiscard]] ImportOutcome import_source(const ImportRequest& request);

}  // namespace kerf
