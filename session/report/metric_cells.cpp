// SPDX-License-Identifier: Apache-2.0
#include "session/report/metric_cells.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

#include "session/report/report_data.h"

namespace kerf::session {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 34> names{{
    {"axis-in-bone", "Planned axis in bone"},
    {"bone.balance", "Balance of volumes"},
    {"bone.crumb-volume", "Volume of crumbs"},
    {"bone.grooves", "Grooves of threads"},
    {"breach", "Breach"},
    {"depth", "Depth"},
    {"depth-in-air", "Depth gained in air"},
    {"duration", "Duration"},
    {"end-offset", "Offset at the end"},
    {"entry", "Contact with bone"},
    {"entry-offset", "Offset at the entry"},
    {"excess-removal", "Bone removed beyond the plan"},
    {"flatness", "Unevenness of the cut"},
    {"gertzbein-robbins", "Breach of the thread, Gertzbein–Robbins"},
    {"haptics.port-energy", "Energy balance of the device"},
    {"heary", "Breach of the thread, Heary"},
    {"held", "Piece held"},
    {"hole-angle", "Angle to the planned axis"},
    {"image.shots", "Radiographs taken"},
    {"lateral-force", "Force across the shaft"},
    {"moved", "Piece moved"},
    {"narrowest-offset", "Offset at the narrowest bone"},
    {"offset", "Largest offset of the tip"},
    {"plane-angle", "Angle to the planned plane"},
    {"plane-offset", "Offset from the planned plane"},
    {"plunge", "Plunge past a far face"},
    {"plunge.hand", "Plunge of the hand"},
    {"removed", "Bone removed in the step"},
    {"removed-volume", "Bone removed"},
    {"separated", "Bone apart"},
    {"speed", "Speed of the tip"},
    {"thrust", "Thrust"},
    {"time-in-air", "Time in air"},
    {"torque", "Torque"},
}};

}  // namespace

std::string words_of(std::string_view id) {
    std::string words(id);
    for (char& c : words)
        if (c == '-' || c == '_' || c == '.') c = ' ';
    return words;
}

std::string capitalised(std::string words) {
    if (!words.empty()) words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
    return words;
}

std::string name_of(std::string_view id) {
    for (const auto& [known, name] : names)
        if (known == id) return std::string(name);
    const auto behind = [&](std::string_view prefix) { return words_of(id.substr(prefix.size())); };
    if (id.starts_with("clearance.")) return "Clearance to " + behind("clearance.");
    if (id.starts_with("breach-")) return "Breach of " + std::string(id.substr(7, id.size() - 9)) + "\u00a0mm";
    if (id.starts_with("measure.")) return capitalised(behind("measure."));
    if (id.starts_with("breach.")) return "Breach, " + behind("breach.");
    if (id.starts_with("gertzbein-robbins.")) return "Breach of the thread, " + behind("gertzbein-robbins.");
    return capitalised(id.starts_with("left.")     ? behind("left.") + " at the release"
                       : id.starts_with("signal.") ? behind("signal.")
                                                   : words_of(id));
}

std::string_view short_id(const MetricRow& metric) {
    const std::string_view id = metric.id;
    const bool has_step =
        id.size() > metric.scope.size() && id.starts_with(metric.scope) && id[metric.scope.size()] == '.';
    return has_step ? id.substr(metric.scope.size() + 1) : id;
}

std::string with_unit(const std::string& number, const std::string& unit) {
    if (unit.empty()) return number;
    const std::string shown = html_escaped(unit_for_people(unit));
    return number + (shown == "°" ? "" : "\u00a0") + shown;
}

std::string value_html(const MetricRow& metric, std::span<const double> bounds, bool with_uncertainty) {
    const bool is_uncertain = metric.uncertainty > 0.0;
    const double uncertainty = is_uncertain ? metric.uncertainty / metric.per_unit : -1.0;
    std::string number = sensible_number(metric.value / metric.per_unit, uncertainty, bounds);
    if (is_uncertain && with_uncertainty) number += " ± " + sensible_number(uncertainty, uncertainty);
    return with_unit(number, metric.unit);
}

std::string what_html(const std::string& name, std::string_view id, const std::string& help) {
    return "<th scope=\"row\">" + html_escaped(name) + " <code>" + html_escaped(id) + "</code>" +
           (help.empty() ? "" : "<p class=\"soft small\">" + html_escaped(help) + "</p>") + "</th>";
}

std::string row_html(const std::string& what, const std::string& measured, const std::string& bound, RowResult result) {
    return std::string("<tr") + (result.is_failed ? " class=\"failed\"" : "") + ">" + what +
           "<td class=\"number\" data-label=\"Measured\">" + (measured.empty() ? "–" : measured) + "</td><td>" + bound +
           "</td><td class=\"" + result.css + "\">" + result.text + "</td></tr>\n";
}

std::string metric_row_html(const MetricRow& metric) {
    std::string name = name_of(short_id(metric));
    if (metric.occurrences > 1)
        name += ", " + std::to_string(metric.occurrence) + " of " + std::to_string(metric.occurrences);
    const std::string what = what_html(name, metric.id, metric.help);
    if (metric.status == "broken") return row_html(what, value_html(metric), "", {"broken", "✗ broken", true});
    if (metric.status == "ok") return row_html(what, value_html(metric), "", {"ok", "✓ ok"});
    const std::string status = metric.status == "info" ? "" : html_escaped(metric.status);
    return row_html(what, value_html(metric), "", {"soft", status.c_str()});
}

std::string table_html(const std::string& rows) {
    return "<table class=\"stack\"><thead><tr><th scope=\"col\">Quantity</th><th scope=\"col\" class=\"number\">"
           "Measured</th><th scope=\"col\">Goal or limit</th><th scope=\"col\">Result</th></tr></thead><tbody>\n" +
           rows + "</tbody></table>\n";
}

}  // namespace kerf::session
