// SPDX-License-Identifier: Apache-2.0
#include "documents/read_station.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "documents/read_landmarks.h"
#include "documents/shapes/shapes.h"
#include "documents/yaml/correct_keys.h"
#include "documents/yaml/read_map.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

void read_buttons(const Node& node, const std::string& name, DeviceStation& station, Report& report) {
    const std::vector<Node>& items = read_list(node, name, report);
    if (items.size() > max_buttons)
        report.error(text::Code::out_of_range, items[max_buttons].span,
                     "There are too many buttons: got " + std::to_string(items.size()) + ", expected at most " +
                         std::to_string(max_buttons) + ". Remove some.");
    station.buttons.fill(ButtonAction::none);
    for (std::size_t i = 0; i < std::min(items.size(), max_buttons); ++i) {
        const std::optional<std::string> word = read_text(items[i], name, report);
        if (!word) continue;
        const auto* const found = std::find_if(std::begin(button_actions), std::end(button_actions),
                                               [&](const auto& one) { return *word == one.first; });
        if (found != std::end(button_actions)) {
            station.buttons[i] = found->second;
            continue;
        }
        std::vector<std::string> known;
        for (const auto& [action, ignored] : button_actions) known.emplace_back(action);
        refuse_unknown({.code = text::Code::unknown_word,
                        .span = items[i].span,
                        .subject = "The action `" + text::excerpt(*word, 40) + "` of a button",
                        .word = *word,
                        .known = std::move(known)},
                       report);
    }
}

/// The driver knows what its settings mean.
void read_settings(const Node& node, DeviceStation& station, Report& report) {
    UniqueIds ids("setting");
    for (const Node& item : read_named(&node, "settings", ids, report))
        if (std::optional<std::string> value = read_text(item, item.key, report))
            station.settings.emplace_back(item.key, *std::move(value));
}

/// A box that is thinner is a slip of the pen: no operation fits into it.
void check_workspace(const Node& node, bool has_scale, const DeviceStation& station, Report& report) {
    constexpr double thinnest = 10e-3;  // [m]
    if (!station.workspace) return;
    if (has_scale)
        report.error(
            text::Code::contradiction, node.span,
            "`workspace` and `scale` contradict each other: with a workspace, the scale is computed. Remove one "
            "of them.");
    const Vec3 size = station.workspace->high - station.workspace->low;
    if (std::min({size.x, size.y, size.z}) >= thinnest) return;
    report.error(text::Code::degenerate, node.span,
                 "The workspace is too thin: each coordinate of `to` must exceed that of `from` by 10 mm or more. "
                 "`kerf devices test ID` prints the range of each axis.");
}

DeviceStation read_device(const Node& node, Report& report) {
    DeviceStation station;
    MapReader map(node, shapes::station_device, "devices", report);
    shapes::station_device.fill(map, station);
    if (const Node* buttons = map.find("buttons")) read_buttons(*buttons, map.name_of("buttons"), station, report);
    for (const char* key : {"peer", "key_file", "motion"})
        if (std::string value = map.text(key); !value.empty()) station.settings.emplace_back(key, std::move(value));
    if (const Node* settings = map.find("settings")) read_settings(*settings, station, report);
    if (const Node* axes = map.find("axes"); axes != nullptr && std::abs(dot(station.right, station.up)) > 0.5)
        report.error(text::Code::degenerate, axes->span,
                     "`right` and `up` lead along one line. Write two perpendicular directions, as in "
                     "`{right: right, up: superior}`.");
    if (const Node* workspace = map.find("workspace"))
        check_workspace(*workspace, map.find("scale") != nullptr, station, report);
    map.finish();
    return station;
}

}  // namespace

text::Result<Station> read_station_text(const std::string& file, std::string text) {
    text::Diagnostics found;
    std::optional<Document> document = parse_document(file, std::move(text)).take(found);
    if (!document) return found;
    Report report(*document, found, &shapes::station);
    const Node* kind = document->root.find("kind");
    if (kind == nullptr || kind->text == "Station") correct_keys(document->root, shapes::station, report);
    MapReader map(document->root, shapes::station, "", report);
    if (!read_header(map, "Station", report)) return found;
    Station station;
    std::vector<std::string> seen;
    if (const Node* devices = map.find("devices"))
        for (const Node& node : read_list(*devices, "devices", report)) {
            station.devices.push_back(read_device(node, report));
            const std::string& id = station.devices.back().device;
            if (id.empty()) continue;
            if (std::find(seen.begin(), seen.end(), id) != seen.end())
                report.error(text::Code::duplicate_id, node.span,
                             "The device `" + text::excerpt(id, 40) + "` is there twice. Remove one.");
            seen.push_back(id);
        }
    map.finish();
    if (text::has_error(found)) return found;
    return {std::move(station), std::move(found)};
}

text::Result<Station> read_station(const std::string& file) {
    text::Result<std::string> text = read_text_file(file);
    return text ? read_station_text(file, *std::move(text)) : text.diagnostics();
}

}  // namespace kerf::documents
