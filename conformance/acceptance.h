// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::conformance {

struct AcceptanceRequest {
    std::string child;     ///< the program kerf-check-child
    std::string plugin;    ///< file
    std::string file;      ///< that is compared with, or written
    std::string law{};     ///< "burr with burring"; empty: the file's, or the plugin's first
    std::string folder{};  ///< for differences
};

struct AcceptanceOutcome {
    std::string text;  ///< for people
    bool is_accepted = false;
    bool is_bad_input = false;
    std::string error;  ///< not empty: nothing was compared or written
};

/// Leads the law along the file's script and compares the forces with those recorded. What differs is written to
/// `folder` as CSV and picture.   [main]
[[nodiscard]] AcceptanceOutcome accept(const AcceptanceRequest& request);
/// Records the forces into the file. A file that is there gives the script; else the standard one is taken.   [main]
[[nodiscard]] AcceptanceOutcome record(const AcceptanceRequest& request);

}  // namespace kerf::conformance
