// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/loop_tools.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>

#include "core/plugin/law_memory.h"
#include "core/plugin/plugin_call.h"

namespace kerf {

LoopTools::LoopTools(std::vector<Tool> tools) : tools_(std::move(tools)) {
    std::size_t size = 0;
    for (const Tool& tool : tools_)
        size = std::max<std::size_t>(size, tool.setup.force->force->state_size + tool.setup.force->force->state_align);
    memory_ = std::make_unique<LawMemory>(size);
    resist_times_.resize(tools_.size());
}

std::vector<const ToolSolid*> LoopTools::cutting_solids() const {
    std::vector<const ToolSolid*> solids;
    for (std::size_t number = 0; number < 2 * tools_.size(); ++number) solids.push_back(&solid(number));
    return solids;
}

void LoopTools::take(std::size_t tool) noexcept {
    in_hand_ = tool;
    law_ = {};
}

void LoopTools::begin(const kerf_bone_query& bone, double dt, std::uint64_t tick) noexcept {
    memory_->fit(*setup().force->force);
    solid_ = outline().solid();
    std::fill(std::begin(signals_), std::end(signals_), 0.0);
    drives_.fill(0.0);
    std::copy(setup().drives.begin(), setup().drives.end(), drives_.begin());
    const kerf_tick_in in = tick_in(bone, dt, tick);
    call_begin(*setup().force, in, memory_->state());
}

bool LoopTools::command_drive(std::size_t drive, double value) noexcept {
    if (drive >= setup().drives.size() || !(value == value)) return false;
    const kerf_drive& range = setup().tool->tool->drives[drive];
    const double wanted = std::clamp(value, range.min, range.max);
    return std::exchange(drives_[drive], wanted) != wanted;
}

bool LoopTools::is_driven() const noexcept {
    const auto end = drives_.begin() + static_cast<std::ptrdiff_t>(setup().drives.size());
    return std::any_of(drives_.begin(), end, [](double drive) { return drive != 0.0; });
}

kerf_tick_in LoopTools::tick_in(const kerf_bone_query& bone, double dt, std::uint64_t tick) const noexcept {
    kerf_tick_in in = tick_in_of(setup(), bone, dt);
    in.tick = tick;
    in.drive = drives_.data();
    in.outline = &solid_;
    return in;
}

bool LoopTools::evaluate(const Surroundings& around, double dt, std::uint64_t tick) noexcept {
    constexpr std::uint64_t ticks_to_repeat = 1024;  // a second: it shows in no percentile of the tick
    const LawFault fault = evaluate_law(*setup().force, tick_in(around.view.query(), dt, tick), *memory_, around,
                                        resist_times_[in_hand_], tick % ticks_to_repeat == ticks_to_repeat / 2, law_);
    return fault.what == LawFault::What::none || reject(fault);
}

kerf_status LoopTools::evaluate_with(const kerf_bone_query& bone, double dt, std::uint64_t tick,
                                     kerf_law& law) const noexcept {
    return call_resist(*setup().force, tick_in(bone, dt, tick), memory_->state(), law);
}

bool LoopTools::reject(LawFault fault) noexcept {
    fault.law = setup().force;
    fault_ = fault;
    return false;
}

CommittedLaw LoopTools::commit(const AppliedMotion& applied, const kerf_bone_query& bone, std::uint64_t tick) noexcept {
    kerf_advance advance{};
    advance.size = sizeof advance;
    advance.channel_count = law_.law_count;
    std::copy(applied.rate.begin(), applied.rate.end(), advance.rate);
    advance.channel = law_.channel.data();
    advance.lambda = applied.lambda;
    std::copy(applied.following.begin(), applied.following.end(), advance.following);
    advance.note = law_.note.data();

    kerf_commit_out& out = memory_->new_commit_out();
    const kerf_commit_out given = out;  // the plugin may have changed the pointers
    const kerf_tick_in in = tick_in(bone, applied.dt, tick);
    const kerf_status status = call_commit(*setup().force, in, advance, memory_->state(), out);
    CommittedLaw committed;
    if (const LawFault fault = fault_of_commit(*setup().force, status, *memory_); fault.what != LawFault::What::none) {
        committed.is_sound = reject(fault);
        return committed;
    }
    committed.action_count = std::min(out.action_count, KERF_MAX_ACTIONS);
    std::copy_n(given.action, committed.action_count, committed.action.begin());
    std::copy_n(given.signal, setup().force->force->signal_count, signals_);
    committed.thread = *given.thread;
    committed.has_thread = out.thread_count > 0;
    return committed;
}

std::vector<std::string> LoopTools::laws_over_budget() const {
    std::vector<std::string> lines;
    for (std::size_t t = 0; t < tools_.size(); ++t)
        if (std::string line = over_budget(resist_times_[t], *tools_[t].setup.force, clock_scale_); !line.empty())
            lines.push_back(std::move(line));
    return lines;
}

}  // namespace kerf
