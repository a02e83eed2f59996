// SPDX-License-Identifier: Apache-2.0
#include "bench/empty_law.h"

KERF_PLUGIN("bench.empty", "0.1.0", "Apache-2.0", kerf::bench::Pin, kerf::bench::EmptyLaw)
