// SPDX-License-Identifier: Apache-2.0
#include "run/lone_anatomy.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bone/import/fit_landmarks.h"
#include "bone/import/make_body.h"
#include "bone/import/markups.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"
#include "run/data_files.h"

namespace kerf::run {
namespace {

using namespace literals;

constexpr double spacings[] = {0.5_mm, 1.0_mm, 2.0_mm};  // finest first

bool is_too_large(const text::Diagnostics& found) {
    return std::any_of(found.begin(), found.end(), [](const text::Diagnostic& d) { return d.code == "E0602"; });
}

}  // namespace

text::Result<LoneAnatomy> make_lone_anatomy(const std::string& file, const bone::ImportOptions& options) {
    text::Diagnostics diagnostics;
    auto anatomy = documents::read_anatomy(file).take(diagnostics);
    if (!anatomy) return diagnostics;
    check_data_files(*anatomy, diagnostics);
    if (!text::has_error(diagnostics)) (void)bone::add_markups(*anatomy, diagnostics);
    if (text::has_error(diagnostics)) return diagnostics;
    for (const double spacing : spacings) {
        bone::ImportReport import;
        text::Diagnostics found;
        auto body = bone::make_body(*anatomy, spacing, &import, options).take(found);
        if (is_too_large(found) && spacing != *std::rbegin(spacings)) continue;
        diagnostics.insert(diagnostics.end(), found.begin(), found.end());
        if (!body || text::has_error(diagnostics)) return diagnostics;
        bone::use_fits(*anatomy, import);
        return {LoneAnatomy{std::move(*anatomy), std::move(*body), std::move(import), spacing}, std::move(diagnostics)};
    }
    return diagnostics;
}

}  // namespace kerf::run
