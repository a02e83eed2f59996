// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "documents/yaml/document.h"

/// The values that a patch has set so far. A patch that sets one of them twice would depend on the order of its lines.
namespace kerf::documents {

/// Keys of maps, and ids of the items of lists, from the root of a document.
using NodePath = std::vector<std::string>;

class PatchedPaths {
public:
    struct Change {
        TextSpan span;      ///< of the key
        std::string value;  ///< as shown in messages
        NodePath path;      ///< empty until it is recorded
    };

    /// Records that `change` sets the value at `path`. Returns an earlier change of the same value, of a part of it, or
    /// of a value that contains it, and records nothing then; null if there is none.   [main]
    const Change* record(const NodePath& path, Change change);

private:
    std::map<NodePath, Change> changes_;
};

/// Returns the path with dots between its parts.   [main]
[[nodiscard]] std::string path_text(const NodePath& path);

}  // namespace kerf::documents
