// SPDX-License-Identifier: Apache-2.0
#include "app/window/gui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

namespace kerf::window {

namespace {

constexpr std::array<std::pair<ImGuiKey_, int>, 16> keys{{{ImGuiKey_Tab, Input::tab},
                                                          {ImGuiKey_LeftArrow, Input::arrow_left},
                                                          {ImGuiKey_RightArrow, Input::arrow_right},
                                                          {ImGuiKey_UpArrow, Input::arrow_up},
                                                          {ImGuiKey_DownArrow, Input::arrow_down},
                                                          {ImGuiKey_Home, Input::home},
                                                          {ImGuiKey_End, Input::end},
                                                          {ImGuiKey_Delete, Input::erase},
                                                          {ImGuiKey_Backspace, Input::backspace},
                                                          {ImGuiKey_Enter, Input::enter},
                                                          {ImGuiKey_Escape, Input::escape},
                                                          {ImGuiKey_A, 'A'},
                                                          {ImGuiKey_C, 'C'},
                                                          {ImGuiKey_V, 'V'},
                                                          {ImGuiKey_X, 'X'},
                                                          {ImGuiKey_Z, 'Z'}}};

/// Passes one input on.
void feed_one(const Input& input, ImGuiIO& io) {
    switch (input.kind) {
        case Input::Kind::move:
            io.MousePos = {input.x, input.y};
            return;
        case Input::Kind::wheel:
            io.MouseWheel += input.wheel;
            return;
        case Input::Kind::character:
            io.AddInputCharacter(static_cast<unsigned>(std::max(input.code, 0)));
            return;
        case Input::Kind::button:
            if (input.code >= 0 && input.code < ImGuiMouseButton_COUNT) io.MouseDown[input.code] = input.is_pressed;
            return;
        case Input::Kind::key:
            if (input.code < 0 || input.code >= static_cast<int>(std::size(io.KeysDown))) return;
            io.KeysDown[input.code] = input.is_pressed;
            io.KeyCtrl = input.has_control;
            io.KeyShift = input.has_shift;
            return;
    }
}

/// Returns whether an input must wait for the next frame after an earlier one: of several changes of one key ImGui
/// would see the last alone, it would move a click, and it takes characters before keys that edit.
bool must_wait(const Input& input, const Input& earlier) {
    using Kind = Input::Kind;
    const bool is_same = input.kind == earlier.kind && input.code == earlier.code;
    const bool is_shortcut = earlier.kind == Kind::key && input.has_control != earlier.has_control;
    if (input.kind == Kind::key) return is_same || is_shortcut;
    if (input.kind == Kind::button) return is_same;
    if (input.kind == Kind::move) return earlier.kind == Kind::button;
    constexpr int first_named_key = 256;
    return input.kind == Kind::character &&
           (earlier.kind == Kind::button ||
            (earlier.kind == Kind::key && earlier.is_pressed && earlier.code >= first_named_key));
}

}  // namespace

Gui::Gui() : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    for (const auto& [key, code] : keys) ImGui::GetIO().KeyMap[key] = code;
    fonts_ = load_fonts();
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
    ImGui::SetCurrentContext(context_);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context_);
}

bool Gui::has_mouse() const {
    ImGui::SetCurrentContext(context_);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::has_keyboard() const {
    ImGui::SetCurrentContext(context_);
    return ImGui::GetIO().WantTextInput;
}

void Gui::feed() {
    ImGuiIO& io = ImGui::GetIO();
    auto next = waiting_.begin();
    for (; next != waiting_.end(); ++next) {
        const Input& input = *next;
        if (std::any_of(waiting_.begin(), next, [&](const Input& earlier) { return must_wait(input, earlier); })) break;
        feed_one(input, io);
    }
    waiting_.erase(waiting_.begin(), next);
}

void Gui::draw(int width, int height, const std::function<void(const Fonts&)>& paint) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    io.DeltaTime = 1.0f / 60.0f;
    feed();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    paint(fonts_);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace kerf::window
