// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "documents/made/draw.h"
#include "documents/made/measured_dimension.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// A kind of bone that can be made. The functions are called with a level of the kind.   [main]
struct BoneKind {
    std::string name;                   ///< "vertebra"
    std::string a_level;                ///< what a level is: "the level of the vertebra"; empty: the kind has none
    std::vector<std::string> levels{};  ///< "L3"
    std::string example_level{};        ///< of messages, and of a description without a level
    std::string frame;                  ///< axes and origin, in words: the head of the file states them

    /// Returns what the bone is called: "Vertebra L3".
    std::string (*title)(const MakeRequest&);

    /// Returns the dimensions of adults of one sex; of both together if it is unsaid.
    Population (*population)(const MakeRequest&);

    /// Returns the anatomy behind `metadata:`: solids, tissues, landmarks and zones.
    std::string (*text)(const MakeRequest&, const DimensionValues&);

    /// Returns the dimensions, measured by straight lines through the bone. They start at landmarks; without those the
    /// result is empty.
    std::vector<MeasuredDimension> (*measured)(const Anatomy&);
};

/// Returns the kinds of bones that can be made.   [any]
[[nodiscard]] const std::vector<BoneKind>& bone_kinds();

/// Returns their names, and the levels of all.   [any]
[[nodiscard]] const std::vector<std::string>& made_kinds();
[[nodiscard]] const std::vector<std::string>& made_levels();

/// Returns one request for each kind and level.   [any]
[[nodiscard]] std::vector<MakeRequest> all_made_bones();

/// Returns a kind.   Pre: its name is one of `made_kinds()`.   [any]
[[nodiscard]] const BoneKind& bone_kind(const std::string& name);

}  // namespace kerf::documents
