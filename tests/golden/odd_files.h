// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>

#include "text/source.h"

/// Inputs for golden files that are no text: made when they are needed.
namespace kerf::test {

/// Writes what the code is about into the folder: data files, and the document E….yaml that names them.
[[nodiscard]] const std::map<int, std::function<void(const std::string& folder)>>& makers_of_input();

/// Codes that no document leads to, since other checks come before: what the function says when it is asked all the
/// same.
[[nodiscard]] const std::map<int, std::function<text::Diagnostics()>>& direct_causes();

}  // namespace kerf::test
