// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::app {

/// What `kerf new` writes.
enum class NewKind {
    tool,       ///< the example 02_round_burr: a plugin with a tool and its law
    strategy,   ///< the example 06_groove: a plugin with a remeshing strategy
    procedure,  ///< the example 08_procedure, with its anatomy
};

/// Writes an example under another name into a new folder. It works as it is.
/// @param name    a-z, 0-9 and _, beginning with a letter
/// @param folder  must not exist; empty: `name`
/// @return        an error message; empty on success   [main]
[[nodiscard]] std::string write_new_folder(NewKind kind, const std::string& name, const std::string& folder);

}  // namespace kerf::app
