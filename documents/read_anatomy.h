// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "documents/anatomy.h"
#include "text/result.h"

/// `kind: Anatomy` from YAML to checked values. All errors are reported, not only the first; text/codes.h lists them.
namespace kerf::documents {

/// Reads and checks one anatomy. Error: all that is wrong. Never throws.   [main]
text::Result<Anatomy> read_anatomy(const std::string& file);

/// Reads an anatomy from text in memory, such as that of a session. `file` is only its name in messages.   [main]
text::Result<Anatomy> read_anatomy_text(const std::string& file, std::string text);

/// The part of an anatomy that could be read, for checks that do not depend on its errors.
struct AnatomyDraft {
    Anatomy anatomy;
    bool is_sound = false;  ///< without errors
};

/// Reads one anatomy as `read_anatomy` does, and returns the part that it could read with the errors. Without a value
/// the file holds no anatomy at all.   [main]
text::Result<AnatomyDraft> read_anatomy_draft(const std::string& file);

/// Reads an anatomy from text in memory as `read_anatomy_draft` does.   [main]
text::Result<AnatomyDraft> read_anatomy_draft_text(const std::string& file, std::string text);

/// Returns a place in an anatomy, as a reason. `keys` lead into the document, each within the one before; the place is
/// that of the last one that exists: the value if it is a single one, else the key. Without any key it is the whole
/// file.   [main]
[[nodiscard]] text::Reason in_anatomy(const Anatomy& anatomy, const std::vector<std::string>& keys,
                                      std::string message = {});

}  // namespace kerf::documents
