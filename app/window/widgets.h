// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "app/window/theme.h"

/// Widgets that several pages use, between ImGui's NewFrame and Render.
namespace kerf::window {

[[nodiscard]] ImVec4 rgba(ImU32 colour);

/// Sets the colours and distances of widgets in the present ImGui context.
void set_style();

/// Begins a panel that fills a rectangle.
void begin_panel(const char* name, ImVec2 low, ImVec2 high, ImU32 background = theme::panel);
void end_panel();

/// Paints a small heading.
void heading(const Fonts& fonts, const char* words);

/// Paints text over as many lines as it needs.
void wrapped(ImU32 colour, const std::string& words);

/// Copies a text into the buffer of a text field, as much as fits.
void copy(const std::string& from, std::span<char> to);

/// Height of the line that `paint_top` paints, in pixels.
inline constexpr float top_height = 40.0f;
/// Paints the line at the top of a page: the name of the program, `words`, and that it is not for treatment.
void paint_top(const Fonts& fonts, float width, const std::string& words = {});

}  // namespace kerf::window
