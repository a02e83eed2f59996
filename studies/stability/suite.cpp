// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/suite.h"

#include <algorithm>

#include "studies/stability/cutting.h"
#include "studies/stability/scenes.h"
#include "studies/stability/wall.h"

namespace kerf::stability {

namespace {

/// Runs the scenes of a hand at a port again, with ticks that a machine calls late: all without its pauses, and those
/// of a hand that keeps pushing with them. What is as printed is left out, and so is a hand that is led.
void check_late_ticks(Scope scope, const ToolUnderTest& tool, const Report& report) {
    const char* which = ", late ticks";
    const Report late = [&](Finding finding) {
        if (finding.method != Method::kerf || finding.hand == led) return;
        finding.scene += which;
        report(finding);
    };
    scope.clock = Clock::without_pauses;
    check_cutting(scope, tool, late);
    check_contact(scope, late);
    check_noise(scope, tool, late);
    check_re_entry(scope, tool, nullptr, late);
    check_breakthrough(scope, tool, late);
    check_switching_off(scope, tool, late);
    scope.clock = Clock::measured;
    which = ", late ticks and pauses";
    check_cutting(scope, tool, late);
    check_contact(scope, late);
}

}  // namespace

std::vector<Finding> run_suite(const PluginRegistry& plugins, const PluginRegistry& papers, const std::string& plugin,
                               bool is_quick, const Report& as_found, std::string& error) {
    std::vector<Finding> findings;
    const auto tool = find_tool(plugins, plugin, error);
    if (!tool) return findings;
    std::vector<ToolUnderTest> printed_laws;
    std::string why_not_there;  // the rows that want them have their own words
    for (const char* law : {"tsai_2007", "volumetric_drilling", "dental_implant"})
        if (const auto found = find_tool(papers, "papers.as_printed", why_not_there, law))
            printed_laws.push_back(*found);
    const ToolUnderTest* const printed = printed_laws.empty() ? nullptr : &printed_laws.front();
    const Report report = [&](const Finding& finding) {
        findings.push_back(finding);
        if (as_found) as_found(finding);
    };
    const Scope scope = Scope::of(is_quick);
    if (tool->lead > 0.0) {
        check_screw(scope, *tool, report);
        return findings;
    }
    check_cutting(scope, *tool, report);
    check_walls(scope, report);
    check_tunnelling(scope, *tool, report);
    check_creep(scope, *tool, printed, report);
    check_noise(scope, *tool, report);
    check_flat(scope, report);
    check_re_entry(scope, *tool, printed, report);
    check_breakthrough(scope, *tool, report);
    check_border(scope, *tool, printed, report);
    check_many_contacts(scope, report);
    check_switching_off(scope, *tool, report);
    check_missed_ticks(scope, report);
    check_loop_rate(scope, *tool, printed_laws, report);
    check_lever(scope, report);
    check_late_ticks(scope, *tool, report);
    return findings;
}

bool is_kerf_stable(const std::vector<Finding>& findings) {
    return std::none_of(findings.begin(), findings.end(), [](const Finding& finding) {
        return finding.method == Method::kerf && finding.outcome == Outcome::fail;
    });
}

}  // namespace kerf::stability
