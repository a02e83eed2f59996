// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf {

/// Runs a benchmark that writes its pictures into the folder of the first argument, which is made; without one it
/// gets an empty text. Prints what `run` throws. Returns the exit code.   [main]
template <class Run>
int run_into_folder(int argc, char** argv, const Run& run) {
    try {
        const std::string folder = argc > 1 ? argv[1] : "";
        if (!folder.empty()) std::filesystem::create_directories(folder);
        return run(folder);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

}  // namespace kerf
