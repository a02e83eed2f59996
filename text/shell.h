// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace kerf::text {

/// Returns a word as a shell reads it back, for command lines that people copy: itself where it is plain, else in
/// single quotes. Characters that a terminal would not show, and bytes that are not UTF-8, are escaped as in `$'\x1b'`,
/// which bash, ksh and zsh read.   [any] pure.
[[nodiscard]] std::string shell_quoted(std::string_view word);

/// As shell_quoted(), for the path of a file or folder: one that begins with `-` gets `./`, so that no program takes it
/// for an option.   [any] pure.
[[nodiscard]] std::string shell_path(std::string_view path);

}  // namespace kerf::text
