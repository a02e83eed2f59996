// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/source.h"

namespace kerf::app {

/// The input of `kerf import`.
struct ImportRequest {
    std::string source;         ///< a scan's file, a folder with DICOM, or a surface
    std::string out;            ///< .nrrd for a scan, .stl for a surface; empty: nothing is written
    std::string series;         ///< for a folder with several
    std::string acquisition;    ///< for a series with several
    bool may_resample = false;  ///< across missing slices
    std::string unit = "mm";    ///< for a surface: mm, cm, m or um
    std::string frame;          ///< for a surface: LPS or RAS; empty: the frame that the file names, or else LPS
};

struct ImportOutcome {
    std::string text;               ///< the findings and the processing, for people
    text::Diagnostics diagnostics;  ///< errors and warnings
    std::string error;              ///< why nothing could be written; empty on success
};

/// Reads a scan or a surface, checks all of it, and writes it in standard form: LPS, at right angles, closed. Copies no
/// personal data.   [main]
[[nodiscard]] ImportOutcome import_source(const ImportRequest& request);

}  // namespace kerf::app
