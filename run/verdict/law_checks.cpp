// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/law_checks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "text/quantity.h"

namespace kerf::run {

namespace {

// Below these, nothing resisted. Both [assumed]; bone that is crushed takes 1 mJ/mm³ and more, and a cutter that runs
// at 100 m/s and takes 10 mJ/mm³ is resisted with 1e-4 N·s/mm³.
constexpr double min_impulse = 1e-6 / 1e-9;  // [N·s/m³]
constexpr double min_work = 1e-4 / 1e-9;     // [J/m³] of a tool without a drive

session::MetricRow row(std::string id, double value, std::string unit, double per_unit, bool is_ok, std::string help) {
    session::MetricRow row;
    row.id = std::move(id);
    row.scope = session::simulation_scope;
    row.value = value;
    row.unit = std::move(unit);
    row.per_unit = per_unit;
    row.status = is_ok ? "ok" : "broken";
    row.help = std::move(help);
    return row;
}

}  // namespace

std::optional<std::string> LawChecks::follow(double removed, const LawLedger& ledger, bool is_driven,
                                             const std::string& law) {
    if (removed < last_.removed) restart(removed, ledger);
    if (removed - last_.removed < interval) return std::nullopt;
    const double volume = removed - before_.removed, impulse = ledger.impulse() - before_.impulse,
                 work = ledger.work() - before_.work;
    const bool is_second = before_.removed < last_.removed;
    const bool is_odd = is_second && (impulse < min_impulse * volume || (!is_driven && work < min_work * volume));
    before_ = std::exchange(last_, {removed, ledger.impulse(), ledger.work()});
    if (!is_odd) return std::nullopt;
    of_tool_ += removed - before_.removed;
    largest_ = std::max(largest_, of_tool_);
    law_ = law;
    return judge_tool(removed, max_volume_at_once);
}

std::optional<std::string> LawChecks::end_tool(double removed) { return judge_tool(removed, max_volume); }

std::optional<std::string> LawChecks::judge_tool(double removed, double largest) {
    if (of_tool_ < largest || of_tool_ < max_fraction * (removed - start_) || std::exchange(is_reported_, true))
        return std::nullopt;
    was_reported_ = true;
    return law_ + ": it removed " + text::quantity_text(std::round(1e10 * of_tool_) * 1e-10, "mm3") +
           " of bone without force, of " + text::quantity_text(std::round(1e10 * (removed - start_)) * 1e-10, "mm3") +
           " in all. Add a channel where the tool removes bone";
}

void LawChecks::restart(double removed, const LawLedger& ledger) {
    last_ = before_ = {removed, ledger.impulse(), ledger.work()};
    start_ = removed;
    of_tool_ = 0.0;
    is_reported_ = false;
}

void LawChecks::note(const std::string& id, const std::string& detail) {
    if (id == "haptics.quarantined" && faults_++ == 0) first_fault_ = detail;
    const bool is_first = id == forceless || (id == "haptics.law_made_energy" && made_++ == 0);
    if (is_first) reasons_.push_back("The force law is unsound. " + detail + ".");
}

void LawChecks::judge(bool has_reason, session::RunSummary& summary) const {
    if (faults_ == 0 && reasons_.empty()) return;
    summary.verdict = session::Verdict::invalid;
    std::vector<std::string> reasons;
    if (faults_ > 0 && !has_reason) reasons.push_back("The force law or the solve failed for a time. " + first_fault_);
    reasons.insert(reasons.end(), reasons_.begin(), reasons_.end());
    summary.reasons.insert(summary.reasons.begin() + (has_reason ? 1 : 0), reasons.begin(), reasons.end());
}

std::vector<session::MetricRow> LawChecks::rows(const LawLedger& ledger) const {
    return {row("haptics.law-faults", static_cast<double>(faults_), "", 1.0, faults_ == 0,
                "How often a force law was unsound; each time the force is released."),
            row("haptics.law-energy", ledger.largest().made, "mJ", 1e-3, made_ == 0,
                "Most that a force law gave the tool in one second beyond what it had taken."),
            row("bone.without-force", largest_, "mm3", 1e-9, !was_reported_,
                "Bone that one tool removed while its force law did not resist.")};
}

}  // namespace kerf::run
