// SPDX-License-Identifier: Apache-2.0
#include "app/window/widgets.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "app/window/panel_painter.h"

namespace kerf::window {

ImVec4 rgba(ImU32 colour) { return ImGui::ColorConvertU32ToFloat4(colour); }

void begin_panel(const char* name, ImVec2 low, ImVec2 high, ImU32 background) {
    ImGui::SetNextWindowPos(low);
    ImGui::SetNextWindowSize({std::max(1.0f, high.x - low.x), std::max(1.0f, high.y - low.y)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, rgba(background));
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
}

void end_panel() {
    ImGui::End();
    ImGui::PopStyleColor();
}

void heading(const Fonts& fonts, const char* words) {
    ImGui::PushFont(fonts.small);
    ImGui::TextColored(rgba(theme::soft), "%s", words);
    ImGui::PopFont();
}

void wrapped(ImU32 colour, const std::string& words) {
    ImGui::PushStyleColor(ImGuiCol_Text, rgba(colour));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(words.c_str(), words.c_str() + words.size());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void set_style() {
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0.0f;
    style.WindowBorderSize = 0.0f;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 4.0f;
    style.WindowPadding = {14.0f, 10.0f};
    style.FramePadding = {8.0f, 4.0f};
    style.ItemSpacing = {8.0f, 6.0f};
    style.CellPadding = {6.0f, 3.0f};
    style.ScrollbarSize = 10.0f;
    const std::pair<ImGuiCol, ImU32> colours[] = {
        {ImGuiCol_Text, theme::text},          {ImGuiCol_TextDisabled, theme::soft},
        {ImGuiCol_PopupBg, theme::bar},        {ImGuiCol_Border, theme::line},
        {ImGuiCol_FrameBg, theme::header},     {ImGuiCol_FrameBgHovered, theme::line},
        {ImGuiCol_FrameBgActive, theme::line}, {ImGuiCol_Button, theme::header},
        {ImGuiCol_ButtonHovered, theme::lit},  {ImGuiCol_ButtonActive, theme::lit},
        {ImGuiCol_Header, theme::lit},         {ImGuiCol_HeaderHovered, IM_COL32(0x26, 0x3c, 0x4e, 255)},
        {ImGuiCol_HeaderActive, theme::lit},   {ImGuiCol_CheckMark, theme::modelled},
        {ImGuiCol_ScrollbarBg, theme::panel},  {ImGuiCol_TableHeaderBg, theme::panel},
        {ImGuiCol_TableRowBgAlt, theme::bar}};
    for (const auto& [which, colour] : colours) style.Colors[which] = rgba(colour);
}

void copy(const std::string& from, std::span<char> to) {
    const std::size_t size = std::min(from.size(), to.size() - 1);
    std::memcpy(to.data(), from.data(), size);
    to[size] = '\0';
}

void paint_top(const Fonts& fonts, float width, const std::string& words) {
    constexpr const char* notice = "For training and research; not for diagnosis, planning or deciding treatment.";
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({0, 0}, {width, top_height}, theme::header);
    list.AddText(fonts.large, fonts.large->FontSize, {14, 10}, theme::text, "Kerf");
    const std::string line = words.empty() ? notice : words + "   " + notice;
    list.AddText(fonts.small, fonts.small->FontSize, {76, 14}, theme::soft,
                 shortened(fonts.small, line, width - 90.0f).c_str());
}

}  // namespace kerf::window
