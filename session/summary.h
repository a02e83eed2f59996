// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"

namespace kerf {

/// The contents of summary.json, schema 1: stable, scripts read it. Millimetres and seconds are named in the keys;
/// a metric's value is in its own `unit`. What is not a finite number becomes `null`.   [any]
[[nodiscard]] std::string summary_json(const RunSummary& summary);

}  // namespace kerf
