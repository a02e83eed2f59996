// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "text/source.h"

/// What `kerf validate` found, in the form that was asked for.
namespace kerf {

/// Of one procedure and its anatomy.
struct Findings {
    std::string file;
    Diagnostics diagnostics;
};

/// "text": errors with their lines and carets, and a word on every file without. "json": one document, schema 1.
/// "github": workflow commands, which GitHub shows beside the lines.   [any] pure.
[[nodiscard]] std::string findings_text(const std::vector<Findings>& all, const std::string& format);

}  // namespace kerf
