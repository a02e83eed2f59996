// SPDX-License-Identifier: Apache-2.0
#include "core/session/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/procedure/plain_numbers.h"
#include "core/session/content_hash.h"
#include "core/session/recorder.h"
#include "core/session/report_data.h"
#include "core/session/report_page.h"

namespace kerf {
namespace {

constexpr std::size_t most_events_listed = 500;

std::string with_unit(const std::string& number, const std::string& unit) {
    return unit.empty() ? number : number + " " + html_escaped(unit_for_people(unit));
}

struct VerdictWord {
    const char* symbol;
    const char* word;
};

VerdictWord for_people(Verdict verdict) {
    switch (verdict) {
        case Verdict::pass:
            return {"✓", "Pass"};
        case Verdict::fail:
            return {"✗", "Fail"};
        case Verdict::incomplete:
            return {"…", "Incomplete"};
        case Verdict::invalid:
            break;
    }
    return {"!", "Invalid"};
}

std::string header_html(const RunSummary& summary) {
    const VerdictWord verdict = for_people(summary.verdict);
    std::string subtitle;
    const auto add = [&](const std::string& what) {
        if (!what.empty()) subtitle += (subtitle.empty() ? "" : " · ") + html_escaped(what);
    };
    add(summary.anatomy);
    add(summary.rehearsal.empty() ? "" : "rehearsal " + summary.rehearsal);
    add(summary.variant.empty() ? "" : "variant " + summary.variant);
    add(summary.procedure_version.empty() ? "" : "version " + summary.procedure_version);

    std::string html = "<header class=\"top\"><div><h1>" + html_escaped(summary.procedure) + "</h1><p class=\"soft\">" +
                       subtitle + "</p></div><div class=\"verdict " + to_text(summary.verdict) +
                       "\"><span class=\"word\">" + verdict.symbol + " " + verdict.word +
                       "</span><p class=\"score\">Score " + sensible_number(std::round(summary.score)) +
                       " of 100</p></div></header>\n";
    html += std::string("<ul class=\"reasons ") + to_text(summary.verdict) + "\">";
    for (const std::string& reason : summary.reasons) html += "<li>" + html_escaped(reason) + "</li>";
    if (summary.reasons.empty())
        html += summary.verdict == Verdict::pass ? "<li>Every step was done and no limit was broken.</li>"
                                                 : "<li>No reason was recorded.</li>";
    return html + "</ul>\n";
}

/// 1/128 says more than 0.00782.
std::string force_scale_text(double scale) {
    const bool is_reduced = scale > 0.0 && scale < 0.5;
    return is_reduced ? "1/" + sensible_number(1.0 / scale) : sensible_number(scale);
}

/// The colours of the tissues, and what they stand for here.
std::string legend_html(const RunSummary& summary, const char* title) {
    if (summary.tissues.empty()) return {};
    std::string html = std::string("<div class=\"legend\"><span>") + title + ":</span>";
    for (std::size_t i = 0; i < summary.tissues.size(); ++i)
        html += "<span><i style=\"background:" + std::string(tissue_colour(i)) + "\"></i>" +
                html_escaped(summary.tissues[i]) + "</span>";
    return html + "</div>";
}

std::string facts_html(const RunSummary& summary) {
    std::string html = "<section><h2>The run</h2><dl class=\"facts\">";
    const auto add = [&](const char* name, const std::string& safe_value) {
        if (!safe_value.empty()) html += std::string("<div><dt>") + name + "</dt><dd>" + safe_value + "</dd></div>";
    };
    add("Duration", sensible_number(summary.duration) + " s");
    add("Bone removed", sensible_number(summary.removed * 1e9) + " mm³");
    for (const auto& [tissue, volume] : summary.removed_by_tissue)
        add(("of it " + html_escaped(tissue)).c_str(), sensible_number(volume * 1e9) + " mm³");
    add("Hand", html_escaped(summary.hand));
    add("Device", html_escaped(summary.device));
    add("Force scale", force_scale_text(summary.force_scale) + " device newton per bone newton");
    if (summary.coupling_stiffness > 0.0)
        add("Coupling", sensible_number(summary.coupling_stiffness * 1e-3) + " N/mm at the device");
    add("Ticks", std::to_string(summary.ticks));
    add("Hash", summary.hash == 0 ? "" : "<code>" + hex16(summary.hash) + "</code>");
    return html + "</dl><p class=\"soft small\" style=\"margin:12px 0 0\">Forces are those of the bone, in newtons; "
                  "the hand felt them "
                  "times the force scale.</p></section>\n";
}

std::string metric_row_html(const MetricRow& metric) {
    const double value = metric.value / metric.per_unit;
    const bool is_uncertain = metric.uncertainty > 0.0;
    const double uncertainty = is_uncertain ? metric.uncertainty / metric.per_unit : -1.0;
    std::string number = sensible_number(value, uncertainty);
    if (is_uncertain) number += " ± " + sensible_number(uncertainty, uncertainty);

    std::string scope = html_escaped(metric.scope);
    if (metric.occurrences > 1)
        scope += ", " + std::to_string(metric.occurrence) + " of " + std::to_string(metric.occurrences);
    const bool is_known_status = metric.status == "ok" || metric.status == "broken" || metric.status == "info";
    return "<tr><td><code>" + html_escaped(metric.id) + "</code>" +
           (metric.help.empty() ? "" : "<br><span class=\"soft small\">" + html_escaped(metric.help) + "</span>") +
           "</td><td>" + scope + "</td><td class=\"number\">" + with_unit(number, metric.unit) + "</td><td class=\"" +
           (is_known_status ? metric.status : "info") + "\">" + html_escaped(metric.status) + "</td></tr>";
}

std::string metrics_html(const RunSummary& summary, bool of_simulation, const char* title) {
    std::string rows;
    for (const MetricRow& metric : summary.metrics)
        if (is_of_simulation(metric) == of_simulation) rows += metric_row_html(metric);
    if (rows.empty()) return {};
    return std::string("<section><h2>") + title +
           "</h2><div class=\"wide\"><table><thead><tr><th>Metric</th><th>Where</th>"
           "<th class=\"number\">Value</th><th>Status</th></tr></thead><tbody>" +
           rows + "</tbody></table></div></section>\n";
}

std::string steps_html(const RunSummary& summary) {
    if (summary.steps.empty()) return {};
    std::string html =
        "<section><h2>Steps</h2><div class=\"wide\"><table><thead><tr><th>Step</th><th>Done</th>"
        "<th class=\"number\">From</th><th class=\"number\">To</th><th>Limits broken</th></tr></thead><tbody>";
    for (const StepRow& step : summary.steps) {
        std::string limits;
        for (const std::string& limit : step.broken_limits)
            limits += (limits.empty() ? "" : "<br>") + html_escaped(limit);
        const bool was_begun = step.end > step.start || step.done;
        html += "<tr><td>" + html_escaped(step.title.empty() ? step.id : step.title) + "</td><td class=\"" +
                (step.done ? "ok\">✓ done" : "soft\">not done") + "</td><td class=\"number\">" +
                (was_begun ? sensible_number(step.start) + " s" : "–") + "</td><td class=\"number\">" +
                (was_begun ? sensible_number(step.end) + " s" : "–") + "</td><td class=\"" +
                (limits.empty() ? "soft\">none" : "broken\">" + limits) + "</td></tr>";
    }
    return html + "</tbody></table></div></section>\n";
}

std::string plots_html(const RunSummary& summary, const DrawnRun& run) {
    std::string html = "<section class=\"plots\"><h2>Forces</h2>";
    if (run.ticks() == 0) return html + "<p>No ticks were recorded.</p></section>\n";

    html += "<noscript><figure>" + thrust_over_depth_svg(run.pictured()) +
            "<figcaption class=\"soft small\">Scripts are off: the other plots and the bone in 3D are not "
            "shown.</figcaption></figure></noscript>";
    html += "<div class=\"script\"><p class=\"soft small hint\">Drag to zoom, double-click to see everything again.</p>"
            "<div class=\"readout\" id=\"readout\" aria-live=\"off\"></div>"
            "<canvas class=\"plot tall\" id=\"plot-depth\" role=\"img\" aria-label=\"Thrust over depth\"></canvas>";
    html += legend_html(summary, "Tissue first met at each depth");
    html += "<h3>Over time</h3>";
    constexpr std::array<const char*, 4> names{"Thrust over time", "Torque over time", "Lateral force over time",
                                               "Depth over time"};
    for (std::size_t i = 0; i < names.size(); ++i)
        html += std::string("<canvas class=\"plot") + (i == 0 ? " named" : "") + "\" id=\"plot-" +
                std::to_string(i + 1) + "\" role=\"img\" aria-label=\"" + names[i] + "\"></canvas>";
    html += "<canvas class=\"plot strip\" id=\"plot-strip\" role=\"img\" aria-label=\"Tissue under the tip over "
            "time\"></canvas>";

    html += legend_html(summary, "Tissue under the tip");

    if (!summary.signals.empty()) {
        html += "<h3><label>Signal of the force model <select id=\"signal\">";
        std::string options;
        for (std::size_t i = 0; i < std::min<std::size_t>(summary.signals.size(), most_signal_columns); ++i)
            options += "<option value=\"" + std::to_string(i) + "\" title=\"" + html_escaped(summary.signals[i].help) +
                       "\">" + html_escaped(summary.signals[i].id) + "</option>";
        html += options + "</select></label> <label>over <select id=\"signal-over\"><option value=\"\">time</option>" +
                options +
                "</select></label></h3><canvas class=\"plot\" id=\"plot-5\" role=\"img\" aria-label=\"Signal of the "
                "force model\"></canvas>";
    }
    return html + "</div></section>\n";
}

std::string bone_html() {
    std::string html = "<section><h2>The bone after the run</h2><p id=\"bone-text\">The bone in 3D needs scripts. The "
                       "same surface is in bone.stl.</p>"
                       "<div id=\"bone-view\" hidden><div class=\"bone\"><canvas id=\"bone\" role=\"img\" "
                       "aria-label=\"The bone in 3D\"></canvas>"
                       "<svg viewBox=\"0 0 74 74\" aria-hidden=\"true\">";
    for (const auto& [name, colour] : {std::pair{"L", "#c0504d"}, {"P", "#5a9a4a"}, {"S", "#4a7ebb"}})
        html += std::string("<line id=\"axis-") + name + "\" x1=\"37\" y1=\"37\" x2=\"37\" y2=\"37\" stroke=\"" +
                colour + "\" stroke-width=\"2\"/><text id=\"axis-name-" + name + "\">" + name + "</text>";
    return html + "</svg></div><div class=\"controls\"><label>Cut away <input type=\"range\" id=\"cut-at\" min=\"0\" "
                  "max=\"100\" step=\"0.5\" "
                  "value=\"0\"></label><label>across <select id=\"cut-axis\"><option value=\"0\">left – "
                  "right</option><option value=\"1\">front – "
                  "back</option><option value=\"2\">head – foot</option></select></label><label><input "
                  "type=\"checkbox\" id=\"cut-flip\"> from "
                  "the other side</label><span class=\"soft small\">Drag to turn, wheel to zoom, Shift and drag to "
                  "move, double-click to begin "
                  "again. L left, P posterior, S superior.</span></div></div></section>\n";
}

std::string events_html(const DrawnRun& run) {
    const std::vector<EventRow>& events = run.events();
    if (events.empty()) return {};
    std::string html = "<section><details><summary>" + std::to_string(run.event_count()) +
                       (run.event_count() == 1 ? " event" : " events") +
                       "</summary><div class=\"wide\"><table><thead><tr><th "
                       "class=\"number\">Time</th><th>Event</th><th>Detail</th></tr></thead><tbody>";
    for (std::size_t i = 0; i < std::min(events.size(), most_events_listed); ++i) {
        const PlainNumbers point;
        char time[40];
        std::snprintf(time, sizeof time, "%.2f s", events[i].time);
        html += "<tr><td class=\"number\">" + std::string(time) + "</td><td><code>" + html_escaped(events[i].id) +
                "</code></td><td>" + html_escaped(events[i].detail) + "</td></tr>";
    }
    html += "</tbody></table></div>";
    if (run.event_count() > most_events_listed)
        html +=
            "<p class=\"soft small\">The first " + std::to_string(most_events_listed) + "; session.db holds all.</p>";
    return html + "</details></section>\n";
}

std::string footer_html(const RunSummary& summary) {
    std::string html = std::string("<footer><p><strong>") + notice_line + ".</strong></p><p>";
    for (std::size_t i = 0; i < summary.versions.size(); ++i)
        html += (i == 0 ? "" : " · ") + html_escaped(summary.versions[i].first + " " + summary.versions[i].second);
    return html + "</p></footer>\n";
}

}  // namespace

std::string report_html(const RunSummary& summary, const DrawnRun& run) {
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
                       "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
                       "'unsafe-inline'; script-src 'unsafe-inline'\">"
                       "<title>" +
                       html_escaped(summary.procedure) + ": " + to_text(summary.verdict) + "</title><style>";
    html += report_style;
    html += "</style></head><body><main>\n";
    html += header_html(summary);
    html += facts_html(summary);
    html += metrics_html(summary, false, "Measured");
    html += steps_html(summary);
    html += plots_html(summary, run);
    html += bone_html();
    html += metrics_html(summary, true, "Checks of the simulation");
    html += events_html(run);
    html += "</main>\n" + footer_html(summary);
    html +=
        "<script type=\"application/json\" id=\"run-data\">" + report_data_json(summary, run) + "</script>\n<script>";
    html += report_script;
    return html + "</script></body></html>\n";
}

}  // namespace kerf
