// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/fuzz/fuzz_target.h"
#include "text/source.h"

namespace kerf::fuzz {

/// Who refuses says why, and whoever does not has no error to tell. Whatever is told can be printed.
inline void require_reason(bool was_read, const text::Diagnostics& diagnostics) {
    require(was_read != text::has_error(diagnostics), "a result comes, or else an error");
    require(to_text(diagnostics).empty() == diagnostics.empty(), "what is told can be read");
}

}  // namespace kerf::fuzz
