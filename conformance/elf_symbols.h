// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace kerf::conformance {

/// What a shared library declares to the dynamic linker.
struct ElfSymbols {
    std::vector<std::string> exported;  ///< names that other libraries can bind to
    std::vector<std::string> unique;    ///< of them those that keep the library loaded for ever
    std::vector<std::string> needed;    ///< libraries
    std::vector<std::string> run_path;  ///< folders where these are searched first
    bool has_executable_stack = false;
};

/// Reads a sound ELF file of this machine; no code of it runs. Nothing where its sections were stripped.   [any]
[[nodiscard]] std::optional<ElfSymbols> elf_symbols(const std::string& path);

}  // namespace kerf::conformance
