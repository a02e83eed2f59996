// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "text/result.h"

/// Adds landmarks to the text of an anatomy.
namespace kerf::documents {

/// Landmarks without fits. Positions are written in millimetres with two decimals.
struct NewLandmarks {
    std::vector<LandmarkPoint> points{};
    std::vector<LandmarkAxis> axes{};

    [[nodiscard]] bool is_empty() const noexcept { return points.empty() && axes.empty(); }
};

/// Returns the lines that belong below `landmarks:`, indented by two blanks.   [any]
[[nodiscard]] std::string landmarks_text(const NewLandmarks& added);

/// Returns the text of an anatomy with landmarks added. Every byte of `text` stays, in its order. The text is read
/// again as a check: all landmarks before are the same, and the new ones are where they should be. A text whose one
/// mistake is that it has no landmarks is accepted. Error: the mistakes of the new text; E0205, the text has a form to
/// which nothing can be added.   [main]
/// @param file  only the name in messages
[[nodiscard]] text::Result<std::string> with_landmarks(const std::string& file, const std::string& text,
                                                       const NewLandmarks& added);

}  // namespace kerf::documents
