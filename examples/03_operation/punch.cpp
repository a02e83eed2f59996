// SPDX-License-Identifier: Apache-2.0
#include "punch_law.h"

KERF_PLUGIN("example.operation", "0.1.0", "Apache-2.0", operation::Punch, operation::Crushing)
