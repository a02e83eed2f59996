// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/device_record.h"
#include "core/haptics/simulation.h"
#include "core/plugin/loader.h"
#include "core/procedure/anatomy.h"
#include "core/procedure/read_procedure.h"

/// A procedure with its anatomy, checked as far as that needs no bone: in milliseconds.
namespace kerf {

/// Which documents, and what is different in them this time.
struct DocumentRequest {
    std::string procedure;       ///< file
    std::string anatomy{};       ///< file; empty: the procedure's own
    ProcedureChanges changes{};  ///< a variant, and `--set`
};

struct Documents {
    Procedure procedure;
    Anatomy anatomy;
    std::vector<std::uint64_t> markup_hashes;  ///< of the files that the anatomy's landmarks came from
    const DeviceRecord* device = nullptr;
    std::vector<Tool> tools;                ///< of the instruments that steps use, in the order of their first use
    std::vector<std::size_t> tool_of_step;  ///< for each step: which of them
};

/// Reads both and checks all that can be told without the bone. Error: whatever is wrong, all of it, in `diagnostics`.
/// [main]
[[nodiscard]] std::optional<Documents> check_documents(const DocumentRequest& request, const PluginRegistry& plugins,
                                                       Diagnostics& diagnostics);

/// What is wrong with the documents' variants and was not found in the procedure as it stands. A variant is named in
/// its messages.   [main]
[[nodiscard]] Diagnostics check_variants(const DocumentRequest& request, const Documents& base,
                                         const PluginRegistry& plugins);

}  // namespace kerf
