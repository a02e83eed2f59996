// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Positions of labels in pictures. All lengths are in units of the picture; y points down.
namespace kerf::session {

struct Rect {
    double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

/// Returns whether two rectangles overlap. Edges that touch do not.   [any]
[[nodiscard]] bool do_meet(const Rect& a, const Rect& b) noexcept;

/// A label and the point that it names.
struct Label {
    double x = 0.0, y = 0.0;           ///< the point
    double width = 0.0, height = 0.0;  ///< of the label
};

/// Returns a position for each label: near its point, within `frame`, and apart from all other labels and from `taken`.
/// Earlier labels take the nearer positions. Nothing for a label without a free position.   [any] pure.
[[nodiscard]] std::vector<std::optional<Rect>> place_labels(std::span<const Label> labels, const Rect& frame,
                                                            std::vector<Rect> taken = {});

/// Returns an upper estimate of the width of a text in a sans-serif font.   [any] pure.
/// @param size   of the font
[[nodiscard]] double text_width(std::string_view text, double size) noexcept;

}  // namespace kerf::session
