// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/view/viewed_run.h"  // all that a viewer needs of Kerf

/// Prints a line for each second of a run until its result, and the result.
void show(kerf::run::ViewedRun& run);
