// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/plugin/component_info.h"
#include "documents/procedure.h"
#include "text/result.h"

/// `kind: Procedure` from YAML to checked values. All errors are reported, not only the first; text/codes.h lists them.
namespace kerf::documents {

/// Changes to the document as it is written.
struct ProcedureChanges {
    std::string variant;                  ///< id; empty: none
    std::vector<std::string> settings{};  ///< "path=value", applied last
    std::vector<std::string> patches{};   ///< files, applied after the variant
    bool any() const noexcept { return !variant.empty() || !settings.empty() || !patches.empty(); }
};

/// Reads and checks one procedure. Error: all that is wrong. Warnings come with the procedure. Never throws.
/// @param catalog   the components of the plugins; no plugin code runs   [main]
text::Result<Procedure> read_procedure(const std::string& file, const ComponentCatalog& catalog,
                                       const ProcedureChanges& changes = {});

/// Reads a procedure from text in memory, such as that of a session. `file` is only its name in messages.   [main]
text::Result<Procedure> read_procedure_text(const std::string& file, std::string text, const ComponentCatalog& catalog,
                                            const ProcedureChanges& changes = {});

/// The part of a procedure that could be read, for checks that do not depend on its errors.
struct ProcedureDraft {
    Procedure procedure;
    bool is_sound = false;                ///< without errors
    bool has_spacing = false;             ///< `accuracy` is without errors
    std::vector<bool> sound_instruments;  ///< for each of the procedure's
};

/// Reads one procedure as `read_procedure` does, and returns the part that it could read with the errors. Without a
/// value the file holds no procedure at all.   [main]
text::Result<ProcedureDraft> read_procedure_draft(const std::string& file, const ComponentCatalog& catalog,
                                                  const ProcedureChanges& changes = {});

/// Returns the document that this procedure was read from.   [main]
std::shared_ptr<const Document> document_of(const Procedure& procedure);

}  // namespace kerf::documents
