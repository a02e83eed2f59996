// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plugin/component_info.h"
#include "documents/procedure.h"

namespace kerf::run {

/// A bad hand that must not pass, made of a hand that does.
struct Cheat {
    std::string id;        ///< "backed-out"
    std::string strength;  ///< what it does, with its numbers; for people
    std::string why_not;   ///< why it does not apply to the procedure; empty: it does
    documents::Rehearsal rehearsal{};
};

/// Returns the first rehearsal that expects to pass; null if there is none.   [any] pure
[[nodiscard]] const documents::Rehearsal* find_good_hand(const documents::Procedure& procedure);

/// Returns the standing bad hands for a procedure, made of its first rehearsal that expects to pass: idle, outside the
/// bone, hasty, hammered, with its drives off, withdrawn at once, backed out, and off the plan. Nothing without such
/// a rehearsal.   [any] pure
[[nodiscard]] std::vector<Cheat> cheats_of(const documents::Procedure& procedure, const ComponentCatalog& catalog);

}  // namespace kerf::run
