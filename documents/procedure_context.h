// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/plugin/component_info.h"
#include "documents/procedure.h"
#include "documents/yaml/document.h"

namespace kerf::documents {

/// A procedure that is being read. Sections that are above in the reader's order are complete.
struct ProcedureContext {
    const Procedure& procedure;
    const Document& document;
    const ComponentCatalog& catalog;
    Report& report;

    /// Reads the name of a landmark of `needs.landmarks`. Reports one that is not declared.
    [[nodiscard]] std::string landmark(const Node& name, const std::string& called) const;
    /// Reports that `name` is not under `needs`. Reports nothing if that list is itself at fault.
    /// @param what   "landmark" or "zone"
    void refuse_undeclared(text::Code code, const Node& name, const std::string& what) const;
    /// Reports that no step has this name. Reports nothing if a step has it and was refused.
    void refuse_step(const Node& name) const;
};

}  // namespace kerf::documents
