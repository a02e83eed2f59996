// SPDX-License-Identifier: Apache-2.0
#include "session/report/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string_view>
#include <vector>

#include "kerf/assert.hpp"
#include "session/content_hash.h"
#include "session/recorder.h"
#include "session/report/force_charts.h"
#include "session/report/report_data.h"
#include "session/report/report_overview.h"
#include "session/report/report_page.h"
#include "session/report/report_score.h"
#include "session/report/report_steps.h"
#include "session/report/report_zones.h"
#include "session/report/timeline.h"
#include "text/plain_numbers.h"

namespace kerf::session {
namespace {

constexpr std::size_t max_listed_events = 500;

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

/// Returns the procedure's title, or its id if no title was recorded.
const std::string& heading(const RunSummary& summary, const RecordedProcedure& procedure) {
    return procedure.title.empty() ? summary.procedure : procedure.title;
}

/// Returns escaped text, with text between backticks as code.
std::string marked(const std::string& text) {
    std::string html;
    bool is_code = false;
    const std::string safe = html_escaped(text);
    for (std::size_t i = 0; i < safe.size(); ++i) {
        const bool is_paired = is_code || safe.find('`', i + 1) != std::string::npos;
        if (safe[i] != '`' || !is_paired) {
            html += safe[i];
            continue;
        }
        html += is_code ? "</code>" : "<code>";
        is_code = !is_code;
    }
    return html;
}

/// Returns titles for people, and ids in small print.
std::string titles_html(const RunSummary& summary, const RecordedProcedure& procedure) {
    std::string html = "<h1>" + html_escaped(heading(summary, procedure)) + "</h1>";
    const auto add_title = [&](const char* what, const std::string& title) {
        if (!title.empty())
            html += std::string("<p><span class=\"soft\">") + what + ":</span> " + html_escaped(title) + "</p>";
    };
    add_title("Variant", procedure.variant_title);
    add_title(summary.leader.empty() ? "Rehearsal" : "Actions of", procedure.rehearsal_title);

    std::string ids;
    const auto add_id = [&](const char* what, const std::string& id) {
        if (!id.empty()) ids += (ids.empty() ? "" : " · ") + html_escaped(what + id);
    };
    add_id("", procedure.title.empty() ? "" : summary.procedure);
    add_id("version ", summary.procedure_version);
    add_id("variant ", summary.variant);
    add_id("rehearsal ", summary.rehearsal);
    add_id("anatomy ", summary.anatomy);
    return html + "<p class=\"soft small\">" + ids + "</p>";
}

std::string header_html(const RunSummary& summary, const RecordedProcedure& procedure) {
    const VerdictWord verdict = for_people(summary.verdict);
    std::string html = "<header class=\"top\"><div>" + titles_html(summary, procedure) + "</div><div class=\"verdict " +
                       to_text(summary.verdict) + "\"><span class=\"word\">" + verdict.symbol + " " + verdict.word +
                       "</span><p class=\"score\">Score " + sensible_number(std::round(summary.score)) +
                       " of 100</p></div></header>\n";
    html += std::string("<ul class=\"reasons ") + to_text(summary.verdict) + "\" aria-label=\"Reasons\">";
    for (const std::string& reason : summary.reasons) html += "<li>" + marked(reason) + "</li>";
    if (summary.reasons.empty())
        html += summary.verdict == Verdict::pass ? "<li>Every step was done and no limit was broken.</li>"
                                                 : "<li>No reason was recorded.</li>";
    return html + "</ul>\n";
}

/// Returns a scale below 0.5 as a fraction: 1/128 is clearer than 0.00782.
std::string force_scale_text(double scale) {
    const bool is_reduced = scale > 0.0 && scale < 0.5;
    return is_reduced ? "1/" + sensible_number(1.0 / scale) : sensible_number(scale);
}

/// Returns the legend of the tissues' colours.
std::string legend_html(const RunSummary& summary, const char* title) {
    if (summary.tissues.empty()) return {};
    std::string html = std::string("<div class=\"legend\"><span>") + title + ":</span>";
    for (std::size_t i = 0; i < summary.tissues.size(); ++i)
        html += "<span><i style=\"background:" + colour_of_tissue(summary.tissues, i) + "\"></i>" +
                html_escaped(summary.tissues[i]) + "</span>";
    return html + "</div>";
}

/// A list of facts without empty values.
class FactList {
public:
    void add(const std::string& name, const std::string& safe_value) {
        if (!safe_value.empty()) html_ += "<div><dt>" + html_escaped(name) + "</dt><dd>" + safe_value + "</dd></div>";
    }
    [[nodiscard]] std::string html() const { return "<dl class=\"facts\">" + html_ + "</dl>"; }

private:
    std::string html_;
};

std::string facts_html(const RunSummary& summary) {
    FactList facts;
    facts.add("Duration", sensible_number(summary.duration) + " s");
    facts.add("Bone removed", sensible_number(summary.removed * 1e9) + " mm³");
    for (const auto& [tissue, volume] : summary.removed_by_tissue)
        facts.add("of it " + tissue, sensible_number(volume * 1e9) + " mm³");
    if (!summary.parent.empty())
        facts.add("Continues", "the first " + sensible_number(1e-3 * static_cast<double>(summary.parent_ticks)) +
                                   " s of session " + html_escaped(summary.parent));
    facts.add("Hand", html_escaped(summary.leader.empty() ? summary.hand : summary.leader));
    if (!summary.leader_setup.empty()) facts.add("Its setup", html_escaped(summary.leader_setup));
    facts.add("Device", html_escaped(summary.device));
    facts.add("Force scale", force_scale_text(summary.force_scale) + " device newton per bone newton");
    return "<section><h2>The run</h2>" + facts.html() + "</section>\n";
}

/// Returns the facts about the quality of the simulation, not of the operation.
std::string simulation_html(const RunSummary& summary) {
    FactList facts;
    if (summary.coupling_stiffness > 0.0)
        facts.add("Coupling", sensible_number(summary.coupling_stiffness * 1e-3) + " N/mm at the device");
    facts.add("Ticks", std::to_string(summary.ticks));
    facts.add("Hash", summary.hash == 0 ? "" : "<code>" + hex16(summary.hash) + "</code>");
    return "<section><details><summary>Checks of the simulation</summary>" + checks_html(summary) + facts.html() +
           "</details></section>\n";
}

/// Returns the maximum loads in words, for readers without the plots.
std::string peaks_html(const std::vector<TickRow>& rows) {
    double thrust = 0.0, torque = 0.0, lateral = 0.0;
    for (const TickRow& row : rows) {
        thrust = std::max(thrust, row.thrust);
        torque = std::max(torque, std::abs(row.torque));
        lateral = std::max(lateral, lateral_force(row));
    }
    return "<p>Greatest thrust " + sensible_number(thrust) + "\u00a0N, torque about the shaft " +
           sensible_number(torque * 1e3) + "\u00a0N·mm, force across the shaft " + sensible_number(lateral) +
           "\u00a0N.</p><p class=\"soft small\">Forces are those of the bone. The hand felt them times the force "
           "scale.</p>";
}

std::string plots_html(const RunSummary& summary, const DrawnRun& run, const RecordedProcedure& procedure) {
    std::string html = "<section class=\"plots\"><h2>Forces</h2>";
    if (run.ticks() == 0) return html + "<p>No ticks were recorded.</p></section>\n";

    html += peaks_html(run.plotted());
    html += "<noscript><p class=\"soft small\">Scripts are off: the plots over time and the bone in 3D are not "
            "shown.</p></noscript>";
    html += "<p class=\"soft small\">Each step over the depth along its own axis. A number is a deduction at its "
            "moment.</p>";
    html += force_charts_html(summary, run, procedure, moments_of(summary));
    html += legend_html(summary, "Tissue first met at each depth");
    html += "<div class=\"script\"><h3>One step, to zoom in</h3><div class=\"controls\"><label>Step <select "
            "id=\"depth-step\"></select></label><label>load <select id=\"depth-load\"><option "
            "value=\"thrust\">thrust</option><option value=\"torque\">torque about the shaft</option><option "
            "value=\"lateral\">force across the shaft</option></select></label></div>"
            "<p class=\"soft small hint\">Drag to zoom, double-click to see everything again.</p>"
            "<div class=\"readout\" id=\"readout\" aria-live=\"off\"></div>"
            "<canvas class=\"plot tall\" id=\"plot-depth\" role=\"img\" aria-label=\"A load of one step over "
            "depth\"></canvas><div class=\"legend\" id=\"depth-legend\"></div>";
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
        for (std::size_t i = 0; i < std::min<std::size_t>(summary.signals.size(), max_signal_columns); ++i)
            options += "<option value=\"" + std::to_string(i) + "\" title=\"" + html_escaped(summary.signals[i].help) +
                       "\">" + html_escaped(summary.signals[i].id) + "</option>";
        html += options + "</select></label> <label>over <select id=\"signal-over\"><option value=\"\">time</option>" +
                options +
                "</select></label></h3><canvas class=\"plot\" id=\"plot-5\" role=\"img\" aria-label=\"Signal of the "
                "force model\"></canvas>";
    }
    return html + "</div></section>\n";
}

std::string events_html(const DrawnRun& run) {
    const std::vector<EventRow>& events = run.events();
    if (events.empty()) return {};
    std::string html = "<section><details><summary>" + std::to_string(run.event_count()) +
                       (run.event_count() == 1 ? " event" : " events") +
                       "</summary><div class=\"wide\"><table><thead><tr><th "
                       "class=\"number\">Time</th><th>Event</th><th>Detail</th></tr></thead><tbody>";
    for (std::size_t i = 0; i < std::min(events.size(), max_listed_events); ++i) {
        const text::PlainNumbers point;
        char time[40];
        std::snprintf(time, sizeof time, "%.2f s", events[i].time);
        html += "<tr><td class=\"number\">" + std::string(time) + "</td><td><code>" + html_escaped(events[i].id) +
                "</code></td><td>" + html_escaped(events[i].detail) + "</td></tr>";
    }
    html += "</tbody></table></div>";
    if (run.event_count() > max_listed_events)
        html +=
            "<p class=\"soft small\">The first " + std::to_string(max_listed_events) + "; session.db holds all.</p>";
    return html + "</details></section>\n";
}

std::string versions_html(const RunSummary& summary) {
    std::string html;
    for (std::size_t i = 0; i < summary.versions.size(); ++i)
        html += (i == 0 ? "" : " · ") + html_escaped(summary.versions[i].first + " " + summary.versions[i].second);
    return html;
}

/// Returns the skeleton with each `{{name}}` replaced by the part of that name. Text of the parts is not replaced
/// again.
std::string filled(std::string_view skeleton, const std::map<std::string_view, std::string>& parts) {
    std::string page;
    for (std::size_t at = 0; at < skeleton.size();) {
        const std::size_t begin = skeleton.find("{{", at), end = skeleton.find("}}", begin);
        page += skeleton.substr(at, begin - at);
        if (begin == std::string_view::npos || end == std::string_view::npos) break;
        const auto part = parts.find(skeleton.substr(begin + 2, end - begin - 2));
        KERF_ASSERT(part != parts.end(), "give report.html only the parts that report_html makes");
        if (part != parts.end()) page += part->second;
        at = end + 2;
    }
    return page;
}

}  // namespace

std::string report_html(const RunSummary& summary, const DrawnRun& run, const RecordedProcedure& procedure) {
    return filled(report_skeleton,
                  {{"title", html_escaped(heading(summary, procedure)) + ": " + to_text(summary.verdict)},
                   {"style", std::string(report_style)},
                   {"header", header_html(summary, procedure) + score_html(summary, run)},
                   {"bone-legend", legend_html(summary, "Tissue") + zone_legend_html(summary)},
                   {"approaches", approaches_html(summary)},
                   {"forces", plots_html(summary, run, procedure)},
                   {"holes", holes_html(summary)},
                   {"measures", measures_html(summary)},
                   {"steps", steps_html(summary, run, procedure)},
                   {"facts", facts_html(summary)},
                   {"checks", simulation_html(summary)},
                   {"events", events_html(run)},
                   {"notice", notice_line},
                   {"versions", versions_html(summary)},
                   {"data", report_data_json(summary, run, procedure)},
                   {"script", std::string(report_script)}});
}

}  // namespace kerf::session
