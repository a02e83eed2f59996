// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/installation.h"
#include "app/standard_streams.h"
#include "core/plugin/loader.h"

namespace kerf::app {

/// Loads the laws as printed in papers, which only `stability` and `chart` use.   [main]
inline void scan_printed_laws(PluginRegistry& laws, const Installation& here) {
    laws.scan({here.printed_laws()});
    for (const auto& refusal : laws.refusals()) print_error(refusal + "\n");
}

}  // namespace kerf::app
