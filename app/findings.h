// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "text/source.h"

/// Prints the findings of `kerf validate` in one of three formats.
namespace kerf::app {

/// The findings in one procedure and its anatomy.
struct Findings {
    std::string file;
    text::Diagnostics diagnostics;
};

/// Returns the findings as text.   [any] pure.
/// @param format   "text": errors with their lines and carets, and a line for each file without errors. "json": one
///                 document, schema 1. "github": workflow commands, which GitHub shows next to the lines.
[[nodiscard]] std::string findings_text(const std::vector<Findings>& all, const std::string& format);

}  // namespace kerf::app
