// SPDX-License-Identifier: Apache-2.0
#include "app/window/inspection_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/window/window_text.h"

namespace kerf::window {

namespace {

namespace colours = inspection_theme;
constexpr float arrow_length = 90.0f;  // [pixels] of `full_arrow`

void paint_arrow(ImDrawList& list, ImVec2 from, ImVec2 to, ImU32 colour) {
    list.AddLine(from, to, colour, 2.5f);
    const float x = to.x - from.x, y = to.y - from.y, long_ = std::sqrt(x * x + y * y);
    if (long_ < 4.0f) return;
    const float head = std::min(10.0f, 0.6f * long_), u = x / long_, v = y / long_;
    list.AddTriangleFilled(to, {to.x - head * u + 0.45f * head * v, to.y - head * v - 0.45f * head * u},
                           {to.x - head * u - 0.45f * head * v, to.y - head * v + 0.45f * head * u}, colour);
}

/// Paints the points at which the law queried bone. A point in bone is filled.
void paint_samples(const run::ViewedInspection& inspection, const Projection& projection, ImDrawList& list) {
    for (const run::ViewedSample& sample : inspection.samples) {
        const auto at = projection.at(inspection.world_from_tool * sample.point);
        if (!at) continue;
        if (sample.engagement > 0.0)
            list.AddCircleFilled(*at, 3.0f, sample.is_edge ? colours::cut : colours::contact, 10);
        else
            list.AddCircle(*at, 2.0f, colours::free, 8);
    }
}

/// Paints the force of each channel on the tool, and the length of a round force.
void paint_forces(const run::ViewedInspection& inspection, const Projection& projection, ImVec2 low, const Fonts& fonts,
                  ImDrawList& list) {
    const double full = full_arrow(inspection);
    const double metres_per_newton = static_cast<double>(arrow_length) * projection.metres_per_pixel() / full;
    for (const run::ViewedChannel& channel : inspection.channels) {
        const Vec3 force = -channel.force * channel.along;
        constexpr double shown_from = 0.01;  // of a full arrow
        if (length(force) < shown_from * full) continue;
        const auto from = projection.at(inspection.world_from_tool * channel.point);
        const auto to = projection.at(inspection.world_from_tool * (channel.point + metres_per_newton * force));
        if (!from || !to) continue;
        list.AddCircle(*from, 4.5f, colour_of(channel), 12, 2.0f);
        paint_arrow(list, *from, *to, colour_of(channel));
    }
    const ImVec2 bar{low.x + 14.0f, low.y + 20.0f};
    list.AddRectFilled({low.x + 6.0f, low.y + 6.0f}, {low.x + 330.0f, low.y + 54.0f}, IM_COL32(0x12, 0x16, 0x1b, 200),
                       3.0f);
    paint_arrow(list, bar, {bar.x + arrow_length, bar.y}, theme::text);
    list.AddText(fonts.small, fonts.small->FontSize, {bar.x + arrow_length + 8.0f, bar.y - 8.0f}, theme::text,
                 ("force of a channel: " + formatted("%g N", full)).c_str());
    const float y = bar.y + 20.0f;
    const auto legend = [&](float x, ImU32 colour, bool is_filled, const char* words) {
        if (is_filled)
            list.AddCircleFilled({bar.x + x, y}, 3.0f, colour, 10);
        else
            list.AddCircle({bar.x + x, y}, 2.0f, colour, 8);
        list.AddText(fonts.small, fonts.small->FontSize, {bar.x + x + 8.0f, y - 8.0f}, theme::soft, words);
    };
    legend(3.0f, colours::cut, true, "edge in bone");
    legend(106.0f, colours::contact, true, "contact in bone");
    legend(226.0f, colours::free, false, "in air");
}

/// Paints the tool as the hand would have it with a spring without stretch, and the spring.
void paint_coupling(const run::ViewedInspection& inspection, const Projection& projection, ImDrawList& list) {
    const run::ViewedCoupling& coupling = inspection.coupling;
    const auto line = [&](Vec3 from, Vec3 to, ImU32 colour, float width) {
        const auto a = projection.at(from), b = projection.at(to);
        if (a && b) list.AddLine(*a, *b, colour, width);
    };
    const ImU32 colour = coupling.is_saturated ? theme::bad : colours::spring;
    const Vec3 tip_of_hand = coupling.world_from_unstretched.position;
    line(tip_of_hand, coupling.grip_of_hand, colour, 1.5f);
    line(inspection.world_from_tool.position, coupling.grip_of_tool, theme::modelled, 1.5f);
    line(inspection.world_from_tool.position, tip_of_hand, colour, 3.0f);
    line(coupling.grip_of_tool, coupling.grip_of_hand, colour, 3.0f);
    if (const auto at = projection.at(tip_of_hand)) list.AddCircle(*at, 6.0f, colour, 16, 2.0f);
    if (const auto at = projection.at(inspection.world_from_tool.position))
        list.AddCircle(*at, 6.0f, theme::modelled, 16, 2.0f);
}

/// Paints the square of a slice in the picture.
void paint_frame(const run::ViewedSlice& slice, const Projection& projection, ImDrawList& list) {
    const int last = slice.edge - 1;
    const int corners[5][2] = {{0, 0}, {last, 0}, {last, last}, {0, last}, {0, 0}};
    for (int i = 0; i < 4; ++i) {
        const auto from = projection.at(slice.world_from_slice * slice.point(corners[i][0], corners[i][1]));
        const auto to = projection.at(slice.world_from_slice * slice.point(corners[i + 1][0], corners[i + 1][1]));
        if (from && to) list.AddLine(*from, *to, IM_COL32(255, 255, 255, 90), 1.0f);
    }
}

/// Returns the pixel of a point of a slice's plane [m].
ImVec2 in_slice(const run::ViewedSlice& slice, double x, double y, ImVec2 low, float edge) {
    const double width = slice.step * slice.edge;
    return {low.x + edge * static_cast<float>(0.5 + x / width), low.y + edge * static_cast<float>(0.5 - y / width)};
}

}  // namespace

InspectionLayers next_layers(const InspectionLayers& layers) {
    if (!layers.is_any()) return all_layers;
    if (layers.contacts && layers.field) return {.contacts = true};
    if (layers.contacts) return {.field = true};
    if (layers.field) return {.coupling = true};
    return {};
}

double full_arrow(const run::ViewedInspection& inspection) {
    double largest = 0.0;
    for (const run::ViewedChannel& channel : inspection.channels)
        largest = std::max(largest, channel.force * length(channel.along));
    double full = 10.0;  // [N]
    for (const double factor : {2.0, 2.5, 2.0, 2.0, 2.5, 2.0}) {
        if (largest <= full) break;
        full *= factor;
    }
    return full;
}

ImU32 colour_of(const run::ViewedChannel& channel) {
    using Kind = run::ViewedChannel::Kind;
    if (channel.wall != nullptr) return colours::wall;
    switch (channel.kind) {
        case Kind::cut:
            return colours::cut;
        case Kind::contact:
            return colours::contact;
        case Kind::friction:
            return colours::friction;
        case Kind::hold:
            break;
    }
    return colours::hold;
}

void InspectionView::show_section(const run::ViewedInspection& inspection, const run::ViewedSlice& shown,
                                  Slice& slice) const {
    if (inspection.tool == slice.tool) return;
    slice.tool = inspection.tool;
    slice.section.clear();
    if (inspection.tool < scene_->tools.size())
        slice.section = section_of(scene_->tools[inspection.tool].mesh, inverse(shown.tool_from_slice));
}

void InspectionView::paint_slice(const run::ViewedInspection& inspection,
                                 const std::shared_ptr<const run::ViewedSlice>& shown, Slice& slice,
                                 const std::string& words, ImVec2 low, float edge, const Fonts& fonts,
                                 ImDrawList& list) const {
    slice.texture.show(shown, scene_->tissues, scene_->spacing);
    if (slice.texture.name() == 0) return;
    show_section(inspection, *shown, slice);
    const ImVec2 high{low.x + edge, low.y + edge};
    list.AddRectFilled({low.x - 6, low.y - 22}, {high.x + 6, high.y + 6}, IM_COL32(0x12, 0x16, 0x1b, 235), 3.0f);
    list.AddText(fonts.small, fonts.small->FontSize, {low.x, low.y - 19}, theme::text, words.c_str());
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(slice.texture.name())), low, high);
    list.PushClipRect(low, high, true);
    const auto at = [&](double x, double y) { return in_slice(*shown, x, y, low, edge); };
    for (const SectionLine& line : slice.section)
        list.AddLine(at(line[0][0], line[0][1]), at(line[1][0], line[1][1]), theme::modelled, 1.6f);
    const Pose slice_from_tool = inverse(shown->tool_from_slice);
    for (const run::ViewedSample& sample : inspection.samples) {
        const Vec3 point = slice_from_tool * sample.point;
        if (std::abs(point.z) > scene_->spacing) continue;
        const ImU32 colour = sample.is_edge ? colours::cut : colours::contact;
        list.AddCircleFilled(at(point.x, point.y), 2.2f, sample.engagement > 0.0 ? colour : colours::free, 8);
    }
    constexpr double bar = 2e-3;  // [m]
    const float long_ = edge * static_cast<float>(bar / (shown->step * shown->edge));
    list.AddRectFilled({high.x - 14 - long_, high.y - 30}, high, IM_COL32(0x12, 0x16, 0x1b, 200));
    list.AddLine({high.x - 8 - long_, high.y - 10}, {high.x - 8, high.y - 10}, theme::text, 2.0f);
    list.AddText(fonts.small, fonts.small->FontSize, {high.x - 8 - long_, high.y - 28}, theme::text, "2 mm");
    list.PopClipRect();
}

void InspectionView::paint_slices(const run::ViewedInspection& inspection, ImVec2 low, ImVec2 high, const Fonts& fonts,
                                  ImDrawList& list) {
    if (inspection.along == nullptr || inspection.across == nullptr) return;
    const float edge = std::clamp(0.29f * (high.x - low.x), 110.0f, 230.0f);
    if (high.y - low.y < edge + 60.0f) return;
    const float top = high.y - edge - 34.0f, left = low.x + 14.0f;
    paint_slice(inspection, inspection.along, along_, "through the axis", {left, top}, edge, fonts, list);
    paint_slice(inspection, inspection.across, across_, "across the tip", {left + edge + 18.0f, top}, edge, fonts,
                list);
    const std::string legend =
        "committed bone: white is its surface, lines every " + formatted("%g mm", 1e3 * scene_->spacing);
    list.AddRectFilled({low.x + 8, high.y - 26}, {left + 2 * edge + 24, high.y - 6}, IM_COL32(0x12, 0x16, 0x1b, 235));
    list.AddText(fonts.small, fonts.small->FontSize, {left, high.y - 24}, theme::soft, legend.c_str());
}

void InspectionView::paint(const std::shared_ptr<const run::ViewedInspection>& inspection,
                           const InspectionLayers& layers, const Projection& projection, ImVec2 low, ImVec2 high,
                           const Fonts& fonts, ImDrawList& list) {
    if (!layers.is_any()) return;
    list.PushClipRect(low, high, true);
    if (inspection == nullptr) {
        const char* words = "No data: this time passed while F4 was off. `kerf view --inspect` has all times.";
        list.AddText(fonts.text, fonts.text->FontSize, {low.x + 14, low.y + 10}, theme::limit, words);
    } else {
        if (layers.field) {
            if (inspection->along != nullptr) paint_frame(*inspection->along, projection, list);
            if (inspection->across != nullptr) paint_frame(*inspection->across, projection, list);
        }
        if (layers.coupling) paint_coupling(*inspection, projection, list);
        if (layers.contacts) {
            paint_samples(*inspection, projection, list);
            paint_forces(*inspection, projection, low, fonts, list);
        }
        if (layers.field) paint_slices(*inspection, low, high, fonts, list);
    }
    list.PopClipRect();
}

}  // namespace kerf::window
