// SPDX-License-Identifier: Apache-2.0
#include "app/window/waiting_screen.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>

#include "app/window/panel_painter.h"

namespace kerf::window {

void WaitingScreen::draw(int width, int height, const std::string& what, double fraction) {
    if (width < 1 || height < 1) return;
    glViewport(0, 0, width, height);
    glClearColor(0.114f, 0.129f, 0.149f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    gui_.draw(width, height, [&](const Fonts& fonts) {
        const float wide = std::min(420.0f, static_cast<float>(width)), x = 0.5f * (static_cast<float>(width) - wide),
                    y = 0.5f * static_cast<float>(height) - 40.0f;
        PanelPainter painter(*ImGui::GetBackgroundDrawList(), fonts, {x, y}, {x + wide, y + 80.0f}, theme::panel);
        painter.line(what);
        painter.skip(4.0f);
        painter.bar(fraction, theme::modelled, 10.0f);
    });
}

}  // namespace kerf::window
