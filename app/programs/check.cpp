// SPDX-License-Identifier: Apache-2.0
// kerf-check: `kerf check`. It loads no plugin: kerf-check-child does.
#include "app/program.h"
#include "app/programs/check_plugins.h"

int main(int argc, char** argv) {
    using namespace kerf::app;
    return run_own_program<CheckOptions>(argc, argv, &check_plugins);
}
