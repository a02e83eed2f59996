// SPDX-License-Identifier: Apache-2.0
#include "app/window/inspection_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "app/window/window_text.h"

namespace kerf::window {

namespace {

constexpr float row_height = 18.0f;

/// Paints a name, and texts that end at fixed fractions of the width.
void paint_row(PanelPainter& painter, ImU32 colour, const std::string& name, const std::array<std::string, 3>& values,
               ImU32 mark = 0) {
    ImFont* font = painter.fonts().small;
    ImDrawList& list = painter.list();
    constexpr std::array<float, 3> ends{0.5f, 0.75f, 1.0f};
    const float left = painter.left() + 13.0f;
    float name_end = painter.right();
    for (std::size_t i = values.size(); i-- > 0;) {
        if (values[i].empty()) continue;
        const float wide = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, values[i].c_str()).x;
        name_end = painter.left() + ends[i] * painter.width() - wide;
        list.AddText(font, font->FontSize, {name_end, painter.top()}, colour, values[i].c_str());
    }
    if (mark != 0) list.AddCircleFilled({painter.left() + 4.0f, painter.top() + 8.0f}, 4.0f, mark, 10);
    list.AddText(font, font->FontSize, {left, painter.top()}, colour,
                 shortened(font, name, name_end - left - 6.0f).c_str());
    painter.skip(row_height);
}

/// Returns a speed in hundredths of a millimetre per second, without "-0.00".
std::string speed_of(const run::ViewedChannel& channel) {
    const double hundredths = std::round(1e5 * channel.rate);
    return formatted("%.2f mm/s", hundredths == 0.0 ? 0.0 : 0.01 * hundredths);
}

std::string name_of(const run::ViewedChannel& channel) {
    if (channel.wall != nullptr) return channel.wall;
    constexpr std::array<const char*, 4> kinds{"cut", "contact", "friction", "hold"};
    return kinds[std::min<std::size_t>(static_cast<std::size_t>(channel.kind), 3)] + std::string(" ") +
           std::to_string(channel.id);
}

/// Returns the gap of a cut or the depth of a contact, in micrometres.
std::string travel_of(const run::ViewedChannel& channel) {
    using Kind = run::ViewedChannel::Kind;
    if (channel.kind == Kind::friction) return "";
    return formatted("%.1f µm", 1e6 * (channel.kind == Kind::cut ? channel.gap : channel.depth));
}

void paint_channels(const run::ViewedInspection& inspection, const run::ViewedScene& scene, PanelPainter& painter) {
    const std::string law = inspection.tool < scene.tools.size() ? scene.tools[inspection.tool].law : "";
    painter.heading("CHANNELS of " + law, std::to_string(inspection.channels.size()));
    paint_row(painter, theme::soft, "", {"force", "gap, depth", "speed"});
    constexpr std::size_t max_rows = 9;
    for (std::size_t c = 0; c < std::min(max_rows, inspection.channels.size()); ++c) {
        const run::ViewedChannel& channel = inspection.channels[c];
        const bool is_torque = length(channel.along) < 1e-6;
        const std::string force = is_torque ? formatted("%.3f N m", channel.force * length(channel.about))
                                            : formatted("%.2f N", channel.force * length(channel.along));
        paint_row(painter, channel.force != 0.0 ? theme::text : theme::soft, name_of(channel),
                  {force, travel_of(channel), speed_of(channel)}, colour_of(channel));
    }
    if (inspection.channels.size() > max_rows)
        painter.line(formatted("… and %zu more", inspection.channels.size() - max_rows), theme::soft);
    Vec3 sum = inspection.following;
    for (const run::ViewedChannel& channel : inspection.channels) sum = sum - channel.force * channel.along;
    paint_row(painter, theme::text, "all together", {formatted("%.2f N", length(sum)), "", ""});
    paint_row(painter, theme::soft, "no channel", {formatted("%.2f N", length(inspection.following)), "", ""});
    std::size_t in_bone = 0;
    for (const run::ViewedSample& sample : inspection.samples) in_bone += sample.engagement > 0.0 ? 1 : 0;
    painter.paragraph(formatted("%zu points queried, %zu in bone", inspection.sample_count, in_bone) +
                          (inspection.parts > 1 ? formatted(" · last of %d parts", inspection.parts) : ""),
                      theme::soft, 1);
}

void paint_signals(const run::ViewedInspection& inspection, const run::ViewedScene& scene, PanelPainter& painter) {
    if (inspection.tool >= scene.tools.size() || scene.tools[inspection.tool].signals.empty()) return;
    painter.skip(6.0f);
    painter.heading("SIGNALS");
    const auto& signals = scene.tools[inspection.tool].signals;
    constexpr std::size_t max_rows = 7;
    for (std::size_t i = 0; i < std::min(max_rows, signals.size()); ++i)
        paint_row(painter, theme::text, signals[i].name,
                  {"", "", formatted("%.4g ", inspection.signals[i] / signals[i].per_unit) + signals[i].unit});
    if (signals.size() > max_rows)
        painter.paragraph(formatted("… and %zu more", signals.size() - max_rows), theme::soft, 1);
}

void paint_coupling(const run::ViewedInspection& inspection, PanelPainter& painter) {
    const run::ViewedCoupling& coupling = inspection.coupling;
    painter.skip(6.0f);
    painter.heading("COUPLING", coupling.is_saturated ? "at its limit" : "");
    const double apart = length(coupling.world_from_unstretched.position - inspection.world_from_tool.position);
    paint_row(painter, theme::text, "tips apart", {"", "", formatted("%.3f mm", 1e3 * apart)});
    paint_row(painter, theme::text, "spring",
              {"", formatted("%.3f mm", 1e3 * length(coupling.stretch)),
               formatted("%.3f°", coupling.twist * 57.29577951308232)});
    const auto limited = [&](const char* name, double value, double limit, const char* unit) {
        paint_row(painter, theme::text, name, {"", "", formatted("%.3g of %.3g ", value, limit) + unit});
        painter.bar(limit > 0.0 ? value / limit : 0.0, coupling.is_saturated ? theme::bad : theme::modelled, 5.0f);
    };
    limited("force on the hand", length(coupling.force), coupling.max_force, "N");
    limited("torque on the hand", length(coupling.torque), coupling.max_torque_across, "N m");
    paint_row(painter, theme::soft, "force of the device", {"", "", formatted("%.2f N", coupling.device_force)});
    painter.paragraph("blue: the tool; yellow: the hand", theme::soft, 1);
}

}  // namespace

void paint_inspection_values(const run::ViewedInspection& inspection, const run::ViewedScene& scene,
                             const InspectionLayers& layers, PanelPainter& painter) {
    if (layers.contacts) {
        paint_channels(inspection, scene, painter);
        paint_signals(inspection, scene, painter);
    }
    if (layers.coupling) paint_coupling(inspection, painter);
}

}  // namespace kerf::window
