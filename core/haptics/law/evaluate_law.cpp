// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/evaluate_law.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "core/haptics/law/channel.h"
#include "core/haptics/law/metal_wall.h"
#include "core/haptics/law/region_wall.h"
#include "core/plugin/plugin_call.h"

namespace kerf {

namespace {

constexpr double max_wrench = 1e5;  // [N] or [N·m]: far beyond any tool that is held in hands

/// Returns the first fault in the plugin's answer, or `What::none`.
LawFault fault_of(const kerf_component& force, kerf_status status, const kerf_law& law,
                  const kerf_channel* channels) noexcept {
    using What = LawFault::What;
    if (take_changed_floating_point(force)) return {.what = What::floating_point, .law = &force};
    if (status != KERF_OK) return {.what = What::status, .law = &force, .value = static_cast<double>(status)};
    if (law.count > KERF_MAX_CHANNELS)
        return {.what = What::count, .law = &force, .value = static_cast<double>(law.count)};
    for (std::uint32_t c = 0; c < law.count; ++c)
        if (const ChannelFault fault = kerf::fault_of(channels[c]); fault.field != nullptr)
            return {.what = What::channel,
                    .law = &force,
                    .index = c,
                    .id = channels[c].id,
                    .field = fault.field,
                    .expected = fault.expected,
                    .value = fault.value};
    for (std::uint32_t i = 0; i < 6; ++i)
        if (!(std::abs(law.wrench[i]) <= max_wrench))
            return {.what = What::wrench, .law = &force, .index = i, .value = law.wrench[i]};
    return {};
}

/// Returns whether a second call of `resist` gives the same channels and wrench, to the bit. Not the note: it may have
/// bytes that no one set.
bool gives_again(const kerf_component& force, const kerf_tick_in& in, LawMemory& memory,
                 const EvaluatedLaw& first) noexcept {
    kerf_law& law = memory.new_law();
    const kerf_channel* const channels = law.channel;
    return call_resist(force, in, memory.state(), law) == KERF_OK && law.count == first.law_count &&
           std::memcmp(channels, first.channel.data(), law.count * sizeof(kerf_channel)) == 0 &&
           std::memcmp(law.wrench, first.wrench.data(), sizeof law.wrench) == 0;
}

void add_walls(const Surroundings& around, EvaluatedLaw& law) noexcept {
    const auto next = [&]() -> kerf_channel* { return law.channel.data() + law.count; };
    const ToolSolid& cutting = around.outline.cutting;
    for (const LiveBody* body : around.view.near())
        if (region_wall(*body->bone, body->view, cutting, body->body_from(around.world_from_tool), *next())) {
            ++law.count;
            law.is_at_region_wall = true;
            break;
        }
    for (const LiveBody* body : around.view.near())
        if (!body->is_cuttable && metal_wall(*body, around.outline, *next())) {
            law.metal_channel = static_cast<int>(law.count++);
            break;
        }
    if (around.guide && around.guide->body < around.bodies.size()) {
        const Pose body_from_tool = around.bodies[around.guide->body]->body_from(around.world_from_tool);
        law.count += static_cast<std::uint32_t>(
            guide_wall(*around.guide, around.outline.whole, inverse(body_from_tool), next()));
    }
    if (around.held.is_any())
        law.count += static_cast<std::uint32_t>(around.held.add_contact(around.bodies, around.world_from_tool, next()));
}

}  // namespace

LawFault evaluate_law(const kerf_component& force, const kerf_tick_in& in, LawMemory& memory,
                      const Surroundings& around, CallTimes& times, bool is_repeated, EvaluatedLaw& result) noexcept {
    kerf_law& law = memory.new_law();
    const kerf_channel* const channels = law.channel;
    const std::uint64_t begun = clock_count();
    const kerf_status status = call_resist(force, in, memory.state(), law);
    times.add(clock_count() - begun);
    result.count = result.law_count = 0;
    result.is_at_region_wall = false;
    result.metal_channel = -1;
    if (const LawFault fault = fault_of(force, status, law, channels); fault.what != LawFault::What::none) return fault;
    if (const char* array = memory.take_underrun())
        return {.what = LawFault::What::underrun, .law = &force, .field = array};
    result.count = result.law_count = law.count;
    std::copy_n(channels, law.count, result.channel.begin());
    std::copy(std::begin(law.wrench), std::end(law.wrench), result.wrench.begin());
    std::copy(std::begin(law.note), std::end(law.note), result.note.begin());
    if (is_repeated && !gives_again(force, in, memory, result)) {
        result.count = result.law_count = 0;
        return {.what = LawFault::What::impure, .law = &force};
    }
    add_walls(around, result);
    return {};
}

LawFault fault_of_commit(const kerf_component& force, kerf_status status, LawMemory& memory) noexcept {
    using What = LawFault::What;
    if (take_changed_floating_point(force)) return {.what = What::floating_point, .law = &force};
    if (status != KERF_OK) return {.what = What::commit_status, .law = &force, .value = static_cast<double>(status)};
    if (const char* array = memory.take_underrun()) return {.what = What::underrun, .law = &force, .field = array};
    for (std::uint32_t i = 0; i < force.force->signal_count; ++i)
        if (const double value = memory.signals()[i]; !std::isfinite(value))
            return {.what = What::signal, .law = &force, .index = i, .value = value};
    return {};
}

}  // namespace kerf
