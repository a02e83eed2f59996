// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "documents/yaml/read_map.h"

/// `kind: Anatomy` from YAML to checked values. All errors are reported, not the first; codes: text/codes.h.
namespace kerf {

/// Reads and checks one anatomy. Empty if anything is wrong. Never throws.   [main]
std::optional<Anatomy> read_anatomy(const std::string& file, Diagnostics& diagnostics);

/// The same for text that is in memory already, as in a recorded session. `file` is only its name.   [main]
std::optional<Anatomy> read_anatomy_text(const std::string& file, std::string text, Diagnostics& diagnostics);

/// An anatomy as far as it could be read, for checks that do not depend on its errors.
struct AnatomyDraft {
    Anatomy anatomy;
    bool is_sound = false;  ///< without errors
};

/// Reads one anatomy, as `read_anatomy` does, and returns what there is of it in spite of errors. Empty if it is no
/// anatomy at all.   [main]
std::optional<AnatomyDraft> read_anatomy_draft(const std::string& file, Diagnostics& diagnostics);

/// Reads `mesh:`, the surface that bone or an implant is made of. `where` is its name in messages.   [main]
[[nodiscard]] MeshSource read_mesh(const Node& node, const std::string& where, Report& report);

/// Reads the solids that a phantom or an implant is made of. `where` is their name in messages.   [main]
[[nodiscard]] std::vector<PhantomPart> read_parts(const Node& node, const std::string& where, Report& report);

/// Returns a place in an anatomy: the last of `keys`, each within the one before, that it has; of a single value the
/// value, else the key. Without any of them the file as a whole.   [main]
[[nodiscard]] Reason in_anatomy(const Anatomy& anatomy, const std::vector<std::string>& keys, std::string message = {});

}  // namespace kerf
