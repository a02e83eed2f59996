// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/loop/device_record.h"
#include "core/haptics/scene/simulation.h"
#include "core/plugin/loader.h"
#include "documents/anatomy.h"
#include "documents/read_procedure.h"

/// A procedure with its anatomy, with all checks that need no bone: in milliseconds.
namespace kerf {

/// Which documents, and what is different in them this time.
struct DocumentRequest {
    std::string procedure;       ///< file
    std::string anatomy{};       ///< file; empty: the procedure's own
    ProcedureChanges changes{};  ///< a variant, and `--set`
    std::string shipped{};       ///< folder of the shipped procedures, where anatomies are searched next
};

struct Documents {
    Procedure procedure;
    Anatomy anatomy;
    std::vector<std::uint64_t> markup_hashes;  ///< of the files with the anatomy's landmarks
    const DeviceRecord* device = nullptr;
    std::vector<Tool> tools;                ///< of the instruments that steps use, in the order of their first use
    std::vector<std::size_t> tool_of_step;  ///< for each step: which of them
};

/// Reads both and runs all checks that need no bone. A mistake in one value does not hide those that do not depend on
/// it. Error: all that is wrong, in `diagnostics`.   [main]
[[nodiscard]] std::optional<Documents> check_documents(const DocumentRequest& request, const PluginRegistry& plugins,
                                                       Diagnostics& diagnostics);

/// Returns what is wrong with the documents' variants and not among `base`, what was found in the procedure without a
/// variant. The messages name the variant.   [main]
[[nodiscard]] Diagnostics check_variants(const DocumentRequest& request, const Diagnostics& base,
                                         const PluginRegistry& plugins);

}  // namespace kerf
