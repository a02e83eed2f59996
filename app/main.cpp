// SPDX-License-Identifier: Apache-2.0
// The `kerf` program. Exit codes: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault.
#include "app/program.h"

int main(int argc, char** argv) {
    using namespace kerf::app;
    return run_program(argc, argv, [](const CommandLine& line, const Invocation& call) {
        return line.command->run(line.options, call);
    });
}
