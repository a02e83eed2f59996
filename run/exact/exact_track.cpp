// SPDX-License-Identifier: Apache-2.0
#include "run/exact/exact_track.h"

#include <algorithm>
#include <utility>

#include "core/remesh/accept.h"

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

AskStrategy strategy_of(const ExactTools& tools) {
    return [&tools](const RemeshRequest& patch) {
        const auto solid = std::find(tools.solids.begin(), tools.solids.end(), patch.solids.front());
        RemeshChild& strategy = *tools.strategies[static_cast<std::size_t>(solid - tools.solids.begin())];
        RemeshResult result = strategy.remesh(patch, tools.patch_limit);
        if (result.status == KERF_REMESH_DECLINED && !tools.why_no_otherwise.empty())
            result.message += "; " + tools.why_no_otherwise;
        return result;
    };
}
AskStrategy fallback_of(const ExactTools& tools) {
    if (tools.otherwise == nullptr) return {};
    return [&tools](const RemeshRequest& patch) { return tools.otherwise->remesh(patch, tools.patch_limit); };
}

}  // namespace

ExactTrack::ExactTrack(const TaggedMesh& mesh, CutHistory done, const ExactTools& tools, double apart)
    : tools_(&tools),
      apart_(apart),
      done_(std::move(done)),
      cutting_(mesh, tools.solids, tools.tolerance, strategy_of(tools), fallback_of(tools)),
      joiner_(tools.solids, tools.tolerance, tools.window),
      swept_(tools.solids, tools.tolerance, apart) {}

void ExactTrack::follow(const CutHistory& history) {
    const std::vector<CutRecord> records = history.records_after(done_);
    for (std::size_t n = 0; n < records.size(); ++n) {
        const CutRecord& record = records[n];
        const ToolSolid& solid = *tools_->solids[record.solid];
        if (solid.outline().empty()) continue;
        ++records_;
        RemeshChild* const strategy = tools_->strategies[record.solid];
        const bool is_whole = strategy != nullptr && strategy->scope() == KERF_REMESH_WHOLE;
        if (!is_whole || (!waiting_.empty() && tools_->strategies[waiting_.front().solid] != strategy))
            commit_waiting();
        if (is_whole) {
            commit(joiner_.end());
            waiting_.push_back(record);
        } else if (strategy != nullptr) {
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
    if (const auto cut = cut_whole(request, *tools_->strategies[records.front().solid], why))
        cutting_.replace(*cut);
    else
        cutting_.give_up(swept_by(records, tools_->solids), std::move(why));
}

std::optional<TaggedMesh> ExactTrack::cut_whole(const RemeshRequest& base, RemeshChild& child, std::string& why) {
    RemeshRequest request = base;
    tools_->report(0.0, "cutting " + std::to_string(request.base.mesh.triangles.size()) + " faces along " +
                            std::to_string(request.cuts.size()) + " straight stretches");
    for (int n = 0; n <= most_refusals; ++n) {
        if (tools_->are_cancelled()) {
            why = interrupted;
            break;
        }
        request.nudge_seed = static_cast<std::uint64_t>(n);
        RemeshResult result = child.remesh(request, tools_->limit);
        if (result.status == KERF_REMESH_UNCHANGED) return request.base;
        why = result.status == KERF_OK ? flaw_of_result(request, result.mesh) : result.message;
        if (result.status == KERF_OK && why.empty()) return std::move(result.mesh);
        ++refusals_;
        notes_.push_back("Attempt " + std::to_string(n + 1) + " was refused: " + why + ".");
        if (!child.is_running() || result.status == KERF_REMESH_CANCELLED) break;
    }
    return std::nullopt;
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
