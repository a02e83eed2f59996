// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "documents/yaml/document.h"
#include "documents/yaml/shape.h"

/// Where a key belongs that is unknown where it is written.
namespace kerf::documents {

/// A map of a document that has a key.
struct KeyHome {
    std::string under;  ///< the key of the map, or of the list that the map is an item of; empty: the document itself
    std::string path;   ///< from the document to the key, as in `accuracy.spacing`; empty if items are on its path
};

/// Returns the maps other than `here` that have a key of this name, if they are one or two; else the key means nothing
/// definite.   [any]
[[nodiscard]] std::vector<KeyHome> homes_of(std::string_view key, const Shape& whole, const Shape& here);

/// What to do with a key that belongs elsewhere.
struct KeyAdvice {
    std::string text;   ///< empty: nowhere is known
    std::string write;  ///< a path, for a key out of a patch or a setting; may be empty
};

/// @param under   the key of the same map that it belongs under; empty: the report's document is searched
[[nodiscard]] KeyAdvice advice_for(const Node& child, const Shape& here, const std::string& under,
                                   const Report& report);

}  // namespace kerf::documents
