// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "documents/check_needs.h"
#include "documents/read_procedure.h"
#include "tests/documents/catalog.h"
#include "tests/fuzz/diagnosed.h"

bool kerf::fuzz::reads(std::string_view input) {
    static const ComponentCatalog catalog = documents::example_catalog();
    text::Diagnostics diagnostics;
    const auto procedure = documents::read_procedure_text("p.yaml", std::string(input), catalog).take(diagnostics);
    require_reason(procedure.has_value(), diagnostics);
    if (procedure) documents::check_needs(*procedure, documents::Anatomy{}, diagnostics);
    return procedure.has_value();
}
