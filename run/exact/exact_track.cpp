// SPDX-License-Identifier: Apache-2.0
#include "run/exact/exact_track.h"

#include <algorithm>
#include <utility>

#include "core/remesh/accept.h"
#include "core/remesh/removal.h"

namespace kerf {
namespace {

constexpr int most_refusals = 4;  // of one result
constexpr const char* interrupted = "interrupted";

Box swept_by(const std::vector<CutRecord>& records, const std::vector<const ToolSolid*>& solids) {
    Box all = swept_box(*solids[records.front().solid], {records.front().from, records.front().to, 0});
    for (const CutRecord& record : records) {
        const Box box = swept_box(*solids[record.solid], {record.from, record.to, 0});
        all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y), std::min(all.low.z, box.low.z)};
        all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y),
                    std::max(all.high.z, box.high.z)};
    }
    return all;
}

/// Of each solid the strategies that cut patches.
std::vector<std::vector<NamedStrategy>> patch_strategies(const ExactTools& tools) {
    std::vector<std::vector<NamedStrategy>> all(tools.solids.size());
    for (std::size_t solid = 0; solid < all.size(); ++solid)
        for (const ExactStrategy& one : tools.strategies[solid]) {
            if (one.is_whole()) continue;
            const bool is_last = &one == &tools.strategies[solid].back();
            all[solid].push_back({one.id,
                                  [&tools, solid, one, is_last](const RemeshRequest& patch) {
                                      RemeshResult result = one.child->remesh(patch, tools.patch_limit);
                                      if (result.status == KERF_REMESH_DECLINED && is_last &&
                                          !tools.why_no_more[solid].empty())
                                          result.message += "; " + tools.why_no_more[solid];
                                      return result;
                                  },
                                  one.child->tolerance()});
        }
    return all;
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
            cutting_.give_up(swept_box(solid, {record.from, record.to, record.solid}),
                             "its instrument leaves no exact surface");
        }
    }
    done_ = history;
}

void ExactTrack::finish() {
    commit(joiner_.end());
    commit_waiting();
    if (is_checked_) return;
    is_checked_ = true;
    RemeshRequest all;
    all.base = mesh();
    if (std::string flaw = flaw_of_result(all, all.base); !flaw.empty())
        cutting_.give_up(bounds_of(all.base.mesh), std::move(flaw));
}

void ExactTrack::commit(const std::optional<CutStretch>& stretch) {
    if (!stretch || swept_.covers(*stretch)) return;
    swept_.add(*stretch);
    ++stretches_;
    is_checked_ = false;
    const Box box = swept_box(*tools_->solids[stretch->solid], *stretch);
    if (tools_->are_cancelled()) return cutting_.give_up(box, interrupted);
    cutting_.cut(*stretch);
}

void ExactTrack::commit_waiting() {
    if (waiting_.empty()) return;
    const std::vector<CutRecord> records = std::exchange(waiting_, {});
    RemeshRequest request;
    request.solids = tools_->solids;
    request.tolerance = tools_->tolerance;
    for (const CutStretch& stretch : stretches_of(records, tools_->solids, tools_->tolerance)) {
        if (swept_.covers(stretch)) continue;
        swept_.add(stretch);
        ++stretches_;
        request.cuts.push_back(stretch);
    }
    request.base = mesh();
    if (request.cuts.empty() || request.base.mesh.triangles.empty()) return;
    std::string why;
    const auto& strategies = tools_->strategies[records.front().solid];
    for (const ExactStrategy& strategy : strategies) {
        if (const auto cut = cut_whole(request, strategy, why)) return cutting_.replace(*cut);
        if (tools_->are_cancelled()) break;
        if (&strategy != &strategies.back()) ++handed_over_;
    }
    if (!tools_->why_no_more[records.front().solid].empty()) why += "; " + tools_->why_no_more[records.front().solid];
    cutting_.give_up(swept_by(records, tools_->solids), std::move(why));
}

std::optional<TaggedMesh> ExactTrack::cut_whole(const RemeshRequest& base, const ExactStrategy& strategy,
                                                std::string& why) {
    RemeshRequest request = base;
    RemeshChild& child = *strategy.child;
    tools_->report(0.0, "cutting " + std::to_string(request.base.mesh.triangles.size()) + " faces along " +
                            std::to_string(request.cuts.size()) + " straight stretches");
    for (int n = 0; n <= most_refusals; ++n) {
        if (tools_->are_cancelled()) {
            why = interrupted;
            break;
        }
        request.nudge_seed = static_cast<std::uint64_t>(n);
        RemeshResult result = child.remesh(request, tools_->limit);
        const double allowed = allowed_for(request, child.tolerance());
        const bool is_unchanged = result.status == KERF_REMESH_UNCHANGED;
        why = is_unchanged               ? flaw_of_unchanged(request, allowed)
              : result.status == KERF_OK ? flaw_of_result(request, result.mesh)
                                         : result.message;
        if (result.status == KERF_OK && why.empty()) why = flaw_of_removal(request, result.mesh, allowed);
        if (is_unchanged && why.empty()) return request.base;
        if (result.status == KERF_OK && why.empty()) return std::move(result.mesh);
        if (result.status == KERF_REMESH_DECLINED) break;
        ++refusals_;
        notes_.push_back("`" + strategy.id + "`: attempt " + std::to_string(n + 1) + " was refused: " + why + ".");
        if (!child.is_running() || result.status == KERF_REMESH_CANCELLED) break;
    }
    return std::nullopt;
}

std::vector<std::string> ExactTrack::notes() const {
    std::vector<std::string> all = notes_;
    for (const auto& [id, refused] : cutting_.refused())
        all.push_back("`" + id + "`: " + std::to_string(refused.count) +
                      (refused.count == 1 ? " result was refused: " : " results were refused, the first: ") +
                      refused.first + ".");
    return all;
}

ExactTrack::Moment ExactTrack::moment() {
    return {cutting_.moment(), done_, joiner_, waiting_, swept_, records_, stretches_};
}

void ExactTrack::go_back(const Moment& moment) {
    cutting_.go_back(moment.cutting);
    done_ = moment.done;
    joiner_ = moment.joiner;
    waiting_ = moment.waiting;
    swept_ = moment.swept;
    records_ = moment.records;
    stretches_ = moment.stretches;
    is_checked_ = false;
}

LocalCutting::Moment ExactTrack::shown() {
    const Moment before = moment();
    commit(joiner_.end());
    LocalCutting::Moment now = cutting_.moment();
    if (!waiting_.empty()) now.stale.push_back({swept_by(waiting_, tools_->solids), "it is cut at the end"});
    go_back(before);
    return now;
}

}  // namespace kerf
