// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

namespace kerf::window {

/// Colours of the panels.
namespace theme {
inline constexpr ImU32 panel = IM_COL32(0x12, 0x16, 0x1b, 255), header = IM_COL32(0x22, 0x2a, 0x33, 255),
                       bar = IM_COL32(0x1c, 0x21, 0x28, 255), lit = IM_COL32(0x2b, 0x4e, 0x68, 255),
                       text = IM_COL32(0xe8, 0xec, 0xef, 255), soft = IM_COL32(0x9a, 0xa5, 0xb0, 255),
                       line = IM_COL32(0x38, 0x42, 0x4d, 255), modelled = IM_COL32(0x56, 0xb4, 0xe9, 255),
                       on_hand = IM_COL32(0xe8, 0xec, 0xef, 255), limit = IM_COL32(0xf0, 0xa0, 0x00, 255),
                       good = IM_COL32(0x3d, 0xbd, 0x8a, 255), forbidden = IM_COL32(0xd9, 0x4f, 0xc4, 255),
                       bad = IM_COL32(0xf0, 0x6a, 0x5a, 255);
}  // namespace theme

struct Fonts {
    ImFont *small = nullptr, *text = nullptr, *bold = nullptr, *large = nullptr;
};

/// Loads the fonts of the panels into the present ImGui context. Without DejaVu Sans it takes the built-in font, which
/// has Latin letters only.
[[nodiscard]] Fonts load_fonts();

}  // namespace kerf::window
