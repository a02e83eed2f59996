// SPDX-License-Identifier: Apache-2.0
// The first byte says of which format the others are: c .fcsv, else .mrk.json.
#include "bone/import/markups.h"

#include <cmath>
#include <string>
#include <string_view>

#include "tests/fuzz/diagnosed.h"
#include "tests/fuzz/scratch_file.h"

bool kerf::fuzz::reads(std::string_view input) {
    static const ScratchFolder folder;
    if (input.empty()) return false;
    const std::string name = input[0] == 'c' ? "a.fcsv" : "a.mrk.json";
    folder.hold(name, input.substr(1));

    documents::Anatomy anatomy;
    anatomy.file = folder / "bone.yaml";
    anatomy.markups = {{name, 1e-3, {{"F-1", "entry"}}}};
    text::Diagnostics diagnostics;
    bone::add_markups(anatomy, diagnostics);
    require_reason(!text::has_error(diagnostics), diagnostics);
    for (const documents::LandmarkPoint& point : anatomy.points)
        require(!point.id.empty() && is_finite(point.at), "a point has a name and a place");
    for (const documents::LandmarkAxis& axis : anatomy.axes)
        require(length(axis.to - axis.from) > 0.0, "an axis has a direction");
    for (const documents::LandmarkPlane& plane : anatomy.planes)
        require(std::abs(length(plane.normal) - 1.0) < 1e-9, "a normal is a unit vector");
    return !text::has_error(diagnostics);
}
