// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/source.h"

/// Errors that follow from others: one mistake is reported once.
namespace kerf::documents {

/// Merges errors about the same unknown name (E03xx, E0212): the first one lists the lines of the others.   [any]
void merge_repeated(text::Diagnostics& diagnostics);

/// Removes errors about an unknown name (E03xx) where a name of the same list is used twice (E0208): one of the two
/// should have had it. The error about the two suggests it if there is one such name.   [any]
void drop_lost_names(text::Diagnostics& diagnostics);

/// Returns the start of the message about a name that `needs` does not declare.   [any]
/// @param what   "landmark" or "zone"
[[nodiscard]] std::string undeclared_text(const std::string& what, const std::string& name);

/// Returns whether a name is reported as not declared.   [any]
[[nodiscard]] bool is_reported_undeclared(const text::Diagnostics& diagnostics, const std::string& what,
                                          const std::string& name);

/// Removes the error about a name that is not declared: `needs` has it misspelt, and this is reported.   [any]
void drop_undeclared(text::Diagnostics& diagnostics, const std::string& what, const std::string& name);

}  // namespace kerf::documents
