// SPDX-License-Identifier: Apache-2.0
#include "app/describe.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "documents/yaml/read_map.h"
#include "kerf/remesh.h"
#include "session/recorder.h"
#include "text/quantity.h"
#include "text/source.h"

namespace kerf::app {

namespace {

/// Escapes control characters: the text comes from a plugin.
std::string shown_text(const std::string& text) { return kerf::text::shown(text); }

const char* kind_of(const ComponentInfo& component) {
    switch (component.kind) {
        case KERF_KIND_TOOL:
            return "tool";
        case KERF_KIND_FORCE:
            return "force";
        case KERF_KIND_DEVICE:
            return "device";
        default:
            return "strategy";
    }
}

/// The id as a procedure writes it in `remeshing:`; for tools and laws, its two keys joined by `/`.
std::string full_id(const ComponentInfo& component) {
    return component.kind == KERF_KIND_REMESHER ? component.full_id() : component.plugin + "/" + component.id;
}

/// In the plugin's own unit; SI if it is unknown.
std::string shown(double value, const std::string& unit) {
    return text::quantity_text(value, unit.empty() || parse_unit(unit) ? unit : "(SI)");
}

/// Whether `wanted` names a component: by its full id or the last part of it.
bool names(const ComponentInfo& component, const std::string& wanted) {
    return component.kind == KERF_KIND_REMESHER ? component.matches_id(wanted)
                                                : full_id(component) == wanted || component.id == wanted;
}

/// Whether `wanted` names a plugin: by its id or the last part of it.
bool names_plugin(const std::string& id, const std::string& wanted) {
    return id == wanted || (!wanted.empty() && id.ends_with("." + wanted));
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string about_values(const char* title, const std::vector<ParameterInfo>& values) {
    if (values.empty()) return {};
    std::string text = std::string("  ") + title + "\n";
    for (const ParameterInfo& p : values) {
        text += "    " + padded(p.id, 20) + padded(shown(p.def, p.display_unit), 16) + "from " +
                shown(p.min, p.display_unit) + " to " + shown(p.max, p.display_unit) + "\n        " + p.help + "\n";
        if (p.least > 0.0) text += "        does not cut below " + shown(p.least, p.display_unit) + "\n";
        if (!p.source.empty()) text += "        source: " + p.source + "\n";
    }
    return text;
}

std::string about(const ComponentInfo& component) {
    std::string text = full_id(component) + "  (" + kind_of(component) + ")\n  " + component.help + "\n";
    if (component.kind == KERF_KIND_REMESHER)
        text += std::string("  gets ") +
                (component.scope == KERF_REMESH_PATCH ? "the faces near each cut" : "the whole mesh") +
                (component.kernel.empty() ? "" : "; results depend on " + component.kernel) + "\n";
    if (component.feed == KERF_FEED_SIDE) text += "  fed across its axis, towards its x\n";
    if (component.feed == KERF_FEED_TURN) text += "  fed by turning\n";
    if (!component.does_not.empty()) text += "  does not " + documents::listed(component.does_not) + "\n";
    if (!component.strategies.empty())
        text += "  strategies that suit it: " + documents::listed(component.strategies) + "\n";
    text += about_values("parameters, with default and range", component.parameters);
    text += about_values("drives, with default and range", component.drives);
    if (!component.signals.empty()) text += "  signals, recorded each tick\n";
    for (const SignalInfo& s : component.signals)
        text += "    " + padded(s.id, 20) + (s.display_unit.empty() ? "no unit" : s.display_unit) + "\n        " +
                s.help + "\n";
    if (!component.events.empty()) text += "  events\n";
    for (const EventInfo& e : component.events)
        text += "    " + e.id + (e.is_damage ? "  (fails the step)" : "") + "\n        " + e.help + "\n";
    if (!component.features.empty()) text += "  features that `kerf plan` may switch off\n";
    for (const FeatureInfo& f : component.features)
        text += "    " + padded(f.id, 20) + component.parameters[f.param].id + " " +
                shown(f.off, component.parameters[f.param].display_unit) + "\n        " + f.help + "\n";
    return text;
}

std::string about(const PluginText& plugin, const BadgeWords& badge) {
    const std::string words = badge ? badge(plugin.id) : "";
    return "plugin " + plugin.id + " " + plugin.version + ", licence " + plugin.licence + "\n" +
           (words.empty() ? "" : "  " + words + "\n");
}

}  // namespace

std::string list_of_components(const PluginRegistry& plugins, const BadgeWords& badge) {
    std::string text;
    for (const ComponentInfo& component : plugins.catalog())
        text += padded(kind_of(component), 9) + full_id(component) + "  " + component.help + "\n";
    for (const PluginText& plugin : plugins.listed())
        if (const std::string words = badge ? badge(plugin.id) : ""; !words.empty())
            text += padded("plugin", 9) + plugin.id + "  " + words + "\n";
    return shown_text(text);
}

std::optional<std::string> description_of(const PluginRegistry& plugins, const std::string& wanted, std::string& error,
                                          const BadgeWords& badge) {
    std::string text;
    for (const PluginText& plugin : plugins.listed()) {
        const std::string& id = plugin.id;
        std::string components;
        for (const ComponentInfo& component : plugins.catalog())
            if (component.plugin == id && (wanted.empty() || names_plugin(id, wanted) || names(component, wanted)))
                components += "\n" + about(component);
        if (!components.empty()) text += (text.empty() ? "" : "\n") + about(plugin, badge) + components;
    }
    if (!text.empty()) return shown_text(text) + "\n" + session::notice_line + ".\n";

    std::vector<std::string> known;
    for (const PluginText& plugin : plugins.listed()) known.push_back(plugin.id);
    for (const ComponentInfo& component : plugins.catalog()) known.push_back(full_id(component));
    error =
        "there is no plugin or component `" + kerf::text::shown(wanted) + "`. " +
        documents::write_instead(wanted, known) +
        (plugins.plugins().empty() ? " No plugin was found: name the folder that holds some in KERF_PLUGIN_PATH." : "");
    return std::nullopt;
}

}  // namespace kerf::app
