// SPDX-License-Identifier: Apache-2.0
#include "bone/exact/exact_track.h"

#include <algorithm>
#include <utility>

#include "bone/remesh/accept.h"
#include "bone/remesh/removal.h"

namespace kerf::bone {
namespace {

constexpr int max_refusals = 4;  // of one result
constexpr const char* interrupted = "interrupted";

/// Returns the result of a strategy that no longer runs: it declines all later stretches.
RemeshResult declined_by_its_end() {
    RemeshResult result;
    result.status = KERF_REMESH_DECLINED;
    result.message = "its process is no longer running";
    return result;
}

Box swept_by(const std::vector<CutRecord>& records, const std::vector<const ToolSolid*>& solids) {
    Box all = swept_box(*solids[records.front().solid], {records.front().from, records.front().to, 0});
    for (const CutRecord& record : records) {
        const Box box = swept_box(*solids[record.solid], {record.from, record.to, 0});
        all = joined(all, box);
    }
    return all;
}

/// Returns the strategies for patches, for each solid.
std::vector<std::vector<NamedStrategy>> patch_strategies(const ExactTools& tools) {
    std::vector<std::vector<NamedStrategy>> all(tools.solids.size());
    for (std::size_t solid = 0; solid < all.size(); ++solid)
        for (const ExactStrategy& one : tools.strategies[solid]) {
            if (one.is_whole()) continue;
            all[solid].push_back({one.id,
                                  [&tools, one](const RemeshRequest& patch) {
                                      return one.child->is_running() ? one.child->remesh(patch, tools.patch_limit)
                                                                     : declined_by_its_end();
                                  },
                                  one.child->tolerance()});
        }
    return all;
}

bool has_whole(const std::vector<ExactStrategy>& strategies) {
    return std::any_of(strategies.begin(), strategies.end(), [](const ExactStrategy& one) { return one.is_whole(); });
}

void add_notes(const FailuresByStrategy& of, const char* what, std::vector<std::string>& notes) {
    for (const auto& [id, not_cut] : of)
        notes.push_back("`" + id + "` " + what + " " + std::to_string(not_cut.count) +
                        (not_cut.count == 1 ? " request: " : " requests, the first: ") + not_cut.first + ".");
}

void add(const FailuresByStrategy& more, FailuresByStrategy& all) {
    for (const auto& [id, not_cut] : more) {
        StrategyFailures& sum = all[id];
        if (sum.count == 0) sum.first = not_cut.first;
        sum.count += not_cut.count;
    }
}

}  // namespace

ExactTrack::ExactTrack(const TaggedMesh& mesh, CutHistory done, const ExactTools& tools, double apart)
    : tools_(&tools),
      apart_(apart),
      done_(std::move(done)),
      cutting_(mesh, tools.solids, tools.tolerance, patch_strategies(tools)),
      joiner_(tools.solids, tools.tolerance, tools.window),
      swept_(tools.solids, tools.tolerance, apart) {}

void ExactTrack::follow(const CutHistory& history) {
    const std::vector<CutRecord> records = history.records_after(done_);
    for (std::size_t n = 0; n < records.size(); ++n) {
        const CutRecord& record = records[n];
        const ToolSolid& solid = *tools_->solids[record.solid];
        if (solid.outline().empty()) continue;
        ++records_;
        const auto& strategies = tools_->strategies[record.solid];
        const bool is_whole = !strategies.empty() && strategies.front().is_whole();
        if (!is_whole ||
            (!waiting_.empty() && tools_->strategies[waiting_.front().solid].front().child != strategies.front().child))
            commit_waiting();
        if (is_whole) {
            commit(joiner_.end());
            waiting_.push_back(record);
        } else if (!strategies.empty()) {
            tools_->report(static_cast<double>(n) / static_cast<double>(records.size()),
                           "cutting along " + std::to_string(records.size()) + " records");
            commit(joiner_.push(record));
        } else {
            commit(joiner_.end());
            cutting_.mark_stale(swept_box(solid, {record.from, record.to, record.solid}),
                                "its instrument leaves no exact surface");
        }
    }
    done_ = history;
}

void ExactTrack::finish() {
    commit(joiner_.end());
    commit_waiting();
    commit_left_over();
    if (is_checked_) return;
    is_checked_ = true;
    RemeshRequest all;
    all.base = mesh();
    if (std::string flaw = flaw_of_result(all, all.base); !flaw.empty())
        cutting_.mark_stale(bounds_of(all.base.mesh), std::move(flaw));
}

void ExactTrack::mark_stale(const CutStretch& stretch, const std::string& why) {
    const std::string& no_more = tools_->why_no_more[stretch.solid];
    cutting_.mark_stale(swept_box(*tools_->solids[stretch.solid], stretch),
                        no_more.empty() ? why : why + "; " + no_more);
}

void ExactTrack::commit(const std::optional<CutStretch>& stretch) {
    if (!stretch || swept_.covers(*stretch)) return;
    swept_.add(*stretch);
    ++stretches_;
    is_checked_ = false;
    if (tools_->are_cancelled()) return mark_stale(*stretch, interrupted);
    std::string why;
    if (cutting_.cut(*stretch, why)) return;
    // The order of cuts has no effect, so all of these can wait until the end.
    if (has_whole(tools_->strategies[stretch->solid]))
        left_over_.push_back(*stretch);
    else
        mark_stale(*stretch, why);
}

RemeshRequest ExactTrack::whole_request() const {
    RemeshRequest request;
    request.solids = tools_->solids;
    request.tolerance = tools_->tolerance;
    return request;
}

void ExactTrack::commit_waiting() {
    if (waiting_.empty()) return;
    const std::vector<CutRecord> records = std::exchange(waiting_, {});
    RemeshRequest request = whole_request();
    for (const CutStretch& stretch : stretches_of(records, tools_->solids, tools_->tolerance)) {
        if (swept_.covers(stretch)) continue;
        swept_.add(stretch);
        ++stretches_;
        request.cuts.push_back(stretch);
    }
    if (request.cuts.empty()) return;
    std::string why;
    const std::vector<CutStretch> stretches = request.cuts;
    if (cut_whole(std::move(request), records.front().solid, why)) return;
    is_checked_ = false;
    for (const CutStretch& stretch : stretches)
        if (tools_->are_cancelled() || !cutting_.cut(stretch, why)) mark_stale(stretch, why);
}

void ExactTrack::commit_left_over() {
    std::vector<CutStretch> rest = std::exchange(left_over_, {});
    while (!rest.empty()) {
        const std::size_t solid = rest.front().solid;
        const auto others =
            std::stable_partition(rest.begin(), rest.end(), [&](const CutStretch& one) { return one.solid == solid; });
        RemeshRequest request = whole_request();
        request.cuts.assign(rest.begin(), others);
        rest.erase(rest.begin(), others);
        std::string why;
        const std::vector<CutStretch> stretches = request.cuts;
        handed_over_ += static_cast<int>(stretches.size());
        if (!cut_whole(std::move(request), solid, why))
            for (const CutStretch& stretch : stretches) mark_stale(stretch, why);
    }
}

bool ExactTrack::cut_whole(RemeshRequest request, std::size_t solid, std::string& why) {
    request.base = mesh();
    if (request.base.mesh.triangles.empty()) return true;
    const auto& strategies = tools_->strategies[solid];
    for (const ExactStrategy& strategy : strategies) {
        if (!strategy.is_whole()) continue;
        if (const auto cut = cut_whole(request, strategy, why)) {
            cutting_.replace(*cut);
            return true;
        }
        if (tools_->are_cancelled()) return false;
        if (&strategy != &strategies.back()) handed_over_ += static_cast<int>(request.cuts.size());
    }
    return false;
}

std::optional<TaggedMesh> ExactTrack::cut_whole(const RemeshRequest& base, const ExactStrategy& strategy,
                                                std::string& why) {
    RemeshRequest request = base;
    RemeshChild& child = *strategy.child;
    tools_->report(0.0, "cutting " + std::to_string(request.base.mesh.triangles.size()) + " faces along " +
                            std::to_string(request.cuts.size()) + " straight stretches");
    for (int n = 0; n <= max_refusals; ++n) {
        if (tools_->are_cancelled()) {
            why = interrupted;
            break;
        }
        request.nudge_seed = static_cast<std::uint64_t>(n);
        RemeshResult result = child.is_running() ? child.remesh(request, tools_->limit) : declined_by_its_end();
        const double allowed = allowed_for(request, child.tolerance());
        const bool is_unchanged = result.status == KERF_REMESH_UNCHANGED;
        why = is_unchanged               ? flaw_of_unchanged(request, allowed)
              : result.status == KERF_OK ? flaw_of_result(request, result.mesh)
                                         : result.message;
        if (result.status == KERF_OK && why.empty()) why = flaw_of_removal(request, result.mesh, allowed);
        if (is_unchanged && why.empty()) return request.base;
        if (result.status == KERF_OK && why.empty()) return std::move(result.mesh);
        const bool is_declined = result.status == KERF_REMESH_DECLINED;
        (is_declined ? declined_ : refused_)[strategy.id].add(why);
        if (is_declined) break;
        ++refusals_;
        if (!child.is_running() || result.status == KERF_REMESH_CANCELLED) break;
    }
    return std::nullopt;
}

std::vector<std::string> ExactTrack::notes() const {
    FailuresByStrategy refused = refused_, declined = declined_;
    add(cutting_.refused(), refused);
    add(cutting_.declined(), declined);
    std::vector<std::string> all;
    add_notes(refused, "failed on", all);
    add_notes(declined, "declined", all);
    return all;
}

ExactTrack::Moment ExactTrack::moment() {
    return {cutting_.moment(), done_, joiner_, waiting_, left_over_, swept_, records_, stretches_};
}

void ExactTrack::restore(const Moment& moment) {
    cutting_.restore(moment.cutting);
    done_ = moment.done;
    joiner_ = moment.joiner;
    waiting_ = moment.waiting;
    left_over_ = moment.left_over;
    swept_ = moment.swept;
    records_ = moment.records;
    stretches_ = moment.stretches;
    is_checked_ = false;
}

LocalCutting::Moment ExactTrack::shown() {
    const Moment before = moment();
    commit(joiner_.end());
    LocalCutting::Moment now = cutting_.moment();
    constexpr const char* at_the_end = "it is cut at the end";
    if (!waiting_.empty()) now.stale.push_back({swept_by(waiting_, tools_->solids), at_the_end});
    for (const CutStretch& stretch : left_over_)
        now.stale.push_back({swept_box(*tools_->solids[stretch.solid], stretch), at_the_end});
    restore(before);
    return now;
}

}  // namespace kerf::bone
