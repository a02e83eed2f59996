// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/haptics/loop/device_record.h"
#include "core/haptics/scene/simulation.h"
#include "core/plugin/loader.h"
#include "documents/anatomy.h"
#include "documents/read_procedure.h"
#include "text/result.h"

/// Reads a procedure with its anatomy and runs all checks that need no bone, in milliseconds.
namespace kerf::run {

/// The documents to read, and changes to them.
struct DocumentRequest {
    std::string procedure;                  ///< file
    std::string anatomy{};                  ///< file; empty: the one that the procedure names
    documents::ProcedureChanges changes{};  ///< a variant, `--patch` and `--set`
    std::string shipped{};                  ///< folder of the shipped procedures, searched second for anatomies
};

struct Documents {
    documents::Procedure procedure;
    documents::Anatomy anatomy;
    std::vector<std::uint64_t> markup_hashes;  ///< of the files with the anatomy's landmarks
    const DeviceRecord* device = nullptr;
    std::vector<Tool> tools;                ///< of the instruments that steps use, in the order of their first use
    std::vector<std::size_t> tool_of_step;  ///< for each step: index into `tools`
};

/// Reads both documents and runs all checks that need no bone. A mistake in one value does not hide independent ones.
/// Error: all mistakes.   [main]
[[nodiscard]] text::Result<Documents> check_documents(const DocumentRequest& request, const PluginRegistry& plugins);

/// Returns the mistakes of the variants that are not in `base`, the diagnostics of the procedure without a variant. The
/// messages name the variant.   [main]
[[nodiscard]] text::Diagnostics check_variants(const DocumentRequest& request, const text::Diagnostics& base,
                                               const PluginRegistry& plugins);

}  // namespace kerf::run
