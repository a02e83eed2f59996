// SPDX-License-Identifier: Apache-2.0
#include "app/window/theme.h"

#include <unistd.h>

namespace kerf::window {

namespace {

// ImGui ends the program if a font file is missing, so it is checked first.
bool can_read(const char* file) { return access(file, R_OK) == 0; }

}  // namespace

Fonts load_fonts() {
    static const ImWchar ranges[] = {0x20,   0xff,   0x100,  0x17f,  0x370,  0x3ff,  0x400,  0x45f,
                                     0x2010, 0x2026, 0x2190, 0x2193, 0x2212, 0x2212, 0x2264, 0x2265,
                                     0x25a0, 0x25cf, 0x2713, 0x2717, 0x27f2, 0x27f3, 0};
    const char* plain = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    const char* heavy = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const auto load = [&](const char* file, float size) {
        return can_read(file) ? atlas.AddFontFromFileTTF(file, size, nullptr, ranges) : atlas.AddFontDefault();
    };
    Fonts fonts;
    fonts.text = load(plain, 15.0f);
    fonts.small = load(plain, 12.5f);
    fonts.bold = load(heavy, 15.0f);
    fonts.large = load(heavy, 19.0f);
    return fonts;
}

}  // namespace kerf::window
