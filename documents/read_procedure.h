// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/component_info.h"
#include "documents/anatomy.h"
#include "documents/procedure.h"

/// `kind: Procedure` from YAML to checked values. All errors are reported, not the first; codes: text/codes.h.
namespace kerf {

/// What is different from the document as it is written.
struct ProcedureChanges {
    std::string variant;                ///< id; empty: none
    std::vector<std::string> settings;  ///< "path=value", applied after the variant
    bool any() const noexcept { return !variant.empty() || !settings.empty(); }
};

/// Reads and checks one procedure. Empty if anything is wrong; warnings alone do not stop it. Never throws.
/// @param catalog   what the plugins offer; no plugin code runs   [main]
std::optional<Procedure> read_procedure(const std::string& file, const ComponentCatalog& catalog,
                                        Diagnostics& diagnostics, const ProcedureChanges& changes = {});

/// The same for text that is in memory already, as in a recorded session. `file` is only its name.   [main]
std::optional<Procedure> read_procedure_text(const std::string& file, std::string text, const ComponentCatalog& catalog,
                                             Diagnostics& diagnostics, const ProcedureChanges& changes = {});

/// A procedure as far as it could be read, for checks that do not depend on its errors.
struct ProcedureDraft {
    Procedure procedure;
    bool is_sound = false;                ///< without errors
    bool has_spacing = false;             ///< `accuracy` is without errors
    std::vector<bool> sound_instruments;  ///< for each of the procedure's
};

/// Reads one procedure, as `read_procedure` does, and returns what there is of it in spite of errors. Empty if it is no
/// procedure at all.   [main]
std::optional<ProcedureDraft> read_procedure_draft(const std::string& file, const ComponentCatalog& catalog,
                                                   Diagnostics& diagnostics, const ProcedureChanges& changes = {});

/// Returns the document that this procedure was read from.   [main]
std::shared_ptr<const Document> document_of(const Procedure& procedure);

/// Reports the landmarks, zones and tissues that the procedure needs and this anatomy does not have.   [main]
void check_names(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics);

/// Reports what the procedure needs and this anatomy does not have: names as above, an axis for every step, and the
/// point `midline` when a rehearsal moves towards it. Places are those in the procedure. An axis that is fitted is not
/// compared with its step's plane: its position is not known yet.   [main]
void check_needs(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics);

/// Reports the steps whose axis leaves their plane, or lies beside it (E0507).   [main]
void check_axes_in_planes(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics);

}  // namespace kerf
