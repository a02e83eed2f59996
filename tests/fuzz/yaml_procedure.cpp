// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "documents/check_needs.h"
#include "documents/read_procedure.h"
#include "tests/documents/catalog.h"
#include "tests/fuzz/diagnosed.h"

bool kerf::fuzz::reads(std::string_view input) {
    static const ComponentCatalog catalog = example_catalog();
    Diagnostics diagnostics;
    const auto procedure = read_procedure_text("p.yaml", std::string(input), catalog).take(diagnostics);
    require_reason(procedure.has_value(), diagnostics);
    if (procedure) check_needs(*procedure, Anatomy{}, diagnostics);
    return procedure.has_value();
}
