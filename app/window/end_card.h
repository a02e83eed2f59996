// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/window/theme.h"
#include "run/view/viewed_run.h"

/// The card with the result of a run, in the lower part of the right panel. So it covers no bone.
namespace kerf::window {

/// A choice of the user on the card.
struct CardAction {
    enum class Kind : std::uint8_t { none, show_moment, toggle, again, debrief, resume, leave } kind = Kind::none;
    double time = 0.0;  ///< [s] of `show_moment`, `debrief` and `resume`
};

/// A rectangle of the card that is clicked for an action.
struct CardLink {
    ImVec2 low, high;
    CardAction action;
};

/// The buttons of the card.
struct CardButtons {
    bool has_again = false, has_debrief = false;
    bool has_resume = false;  ///< the mouse can continue the operation from a moment on
    bool has_start_page = false;
};

inline constexpr float closed_card_height = 36.0f;  // [pixels]

struct CardModel {
    const std::optional<run::ViewedResult>* result = nullptr;
    CardButtons buttons{};
    bool is_open = true;                  ///< false: one line with the verdict
    std::optional<std::size_t> chosen{};  ///< deduction whose moment is shown
    double debrief_from = 0.0;            ///< [s]
};

/// Paints the card. Returns its clickable parts. Its lower right corner is `corner`; deductions without space are left
/// out.   Pre: a frame of ImGui has begun
/// @param width, space  of the card, and the largest height [pixels]
std::vector<CardLink> paint_card(const CardModel& model, ImVec2 corner, float width, float space, const Fonts& fonts,
                                 ImDrawList& list);

/// Returns the deductions that the card lists.   [any] pure
[[nodiscard]] std::size_t listed_deductions(const run::ViewedResult& result) noexcept;

}  // namespace kerf::window
