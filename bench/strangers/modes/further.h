// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tests/animals/hostile.h"

namespace hostile {

/// Writes to memory that is not its own.
void crash();

/// Changes what belongs to the process: rounding, descriptors, limits, signals, files of the run, locale, environment.
void change_surroundings(std::string_view place);

}  // namespace hostile
