// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <unordered_map>

#include "documents/yaml/document.h"

/// Parts that a document refuses are read as they are meant, so that no second error follows from leaving them out.
namespace kerf::documents {

/// Adds the entries of `more` to a map that lacks their keys, or its items to a list that lacks their ids. An empty
/// `first` becomes `more`. Two nodes of different kinds are left as they are.   [any]
void merge(Node& first, const Node& more);

/// The nodes that have an anchor, for the aliases that repeat them. It copies at most 10000 nodes of a document: a few
/// lines of aliases can mean billions.
class Anchors {
public:
    /// Records a node under the number of its anchor; 0 is none.
    void add(std::size_t anchor, const Node& node);
    /// Returns a copy for an alias at `span`; a refused node where the copy would be too large.
    [[nodiscard]] Node copy_of(std::size_t anchor, TextSpan span);

private:
    std::unordered_map<std::size_t, Node> nodes_;
    std::size_t copied_ = 0;
};

}  // namespace kerf::documents
