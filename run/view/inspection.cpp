// SPDX-License-Identifier: Apache-2.0
#include "run/view/inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/haptics/law/channel.h"
#include "run/view/bone_slice.h"
#include "run/view/law_samples.h"

namespace kerf::run {

namespace {

constexpr std::uint64_t slice_interval = 64;  // [ticks]
constexpr int slice_edge = 81;                // samples; the middle one lies on the tool's axis
constexpr double slice_steps = 0.5;           // [–] step of a slice, in voxels

/// Slice through the axis: x to the right, the tool's tip downwards.
const Pose tool_from_along{{}, {std::sqrt(0.5), -std::sqrt(0.5), 0, 0}};
/// Slice across the tip, seen along the tool.
const Pose tool_from_across{{}, {0, 1, 0, 0}};

const char* wall_name(std::uint32_t id) {
    switch (static_cast<OwnContact>(id)) {
        case OwnContact::guide_front:
        case OwnContact::guide_rear:
            return "sleeve";
        case OwnContact::metal:
            return "metal";
        case OwnContact::region:
            return "region";
        case OwnContact::held:
            break;
    }
    return "held body";
}

/// Returns the point of the line of a channel's force that is nearest to a sample at which bone touches, else to the
/// tip. A torque alone has no line.
Vec3 point_of(const ViewedChannel& channel, const std::vector<ViewedSample>& samples) {
    const double square = dot(channel.along, channel.along);
    constexpr double torque_alone = 1e-12;
    if (square < torque_alone) return {};
    const Vec3 foot = (1.0 / square) * cross(channel.along, channel.about);
    double nearest = HUGE_VAL;
    Vec3 point = foot;
    for (const ViewedSample& sample : samples) {
        if (sample.engagement <= 0.0) continue;
        const Vec3 on_line = foot + (dot(sample.point - foot, channel.along) / square) * channel.along;
        const double distance = length(sample.point - on_line);
        if (distance >= nearest) continue;
        nearest = distance;
        point = on_line;
    }
    return point;
}

/// Returns whether the tool rested in the tick: no channel had a force.
bool has_rested(const TickResult& result) {
    return result.is_quarantined || result.is_closed_or_closing || result.has_event(TickResult::anchored_again);
}

void add_samples(const Simulation& simulation, ViewedInspection& inspection) {
    LawSamples samples(simulation.bone().query());
    std::array<kerf_channel, KERF_MAX_CHANNELS> channels{};
    kerf_law law{sizeof(kerf_law), 0, channels.data(), {}, {}};
    static_cast<void>(simulation.evaluate_with(samples.query(), law));  // its points are of use with any status
    inspection.samples = samples.points();
    inspection.sample_count = samples.count();
}

ViewedCoupling viewed_coupling(const Simulation& simulation, const TickResult& result, const Pose& world_from_handle) {
    const Pose& tool = simulation.world_from_tool();
    const CoupledPoses coupled = simulation.coupled();
    const Pose unstretched = world_from_handle * inverse(simulation.grasp());
    ViewedCoupling viewed{.world_from_handle = world_from_handle,
                          .world_from_unstretched = unstretched,
                          .grip_of_tool = tool * coupled.grip,
                          .grip_of_hand = unstretched * coupled.grip,
                          .stretch = rotate(tool.rotation, coupled.stretch),
                          .twist = length(coupled.twist),
                          .force = linear(result.limited_on_hand),
                          .torque = angular(result.limited_on_hand),
                          .max_force = coupled.max_force.across,
                          .max_torque_across = coupled.max_torque.across,
                          .max_torque_along = coupled.max_torque.along,
                          .device_force = length(linear(result.command.wrench))};
    // The release damper acts along the shaft, so it has no torque about the grip.
    constexpr double equal = 1e-6;  // [N], [N·m]
    viewed.is_saturated = length(linear(result.coupled_on_hand) + result.released_on_hand - viewed.force) > equal ||
                          length(angular(result.coupled_on_hand) - viewed.torque) > equal;
    return viewed;
}

}  // namespace

std::vector<ViewedChannel> viewed_channels(const Simulation& simulation, const TickResult& result) {
    const EvaluatedLaw& law = simulation.law();
    const double dt = Simulation::dt / result.parts;
    std::vector<ViewedChannel> viewed;
    for (std::uint32_t c = 0; c < law.count; ++c) {
        const kerf_channel& channel = law.channel[c];
        const Vec6 d = direction(channel);
        const double rate = dot(d, simulation.last_rate());
        const ChannelForce force = has_rested(result) ? ChannelForce{} : channel_force(channel, rate, dt);
        viewed.push_back({.kind = static_cast<ViewedChannel::Kind>(channel.kind),
                          .wall = c < law.law_count ? nullptr : wall_name(channel.id),
                          .id = channel.id,
                          .along = linear(d),
                          .about = angular(d),
                          .rate = rate,
                          .force = force.lambda,
                          .slope = force.slope,
                          .depth = channel.delta,
                          .gap = channel.gap});
    }
    return viewed;
}

void Inspector::renew_slices(const Simulation& simulation) {
    if (along_ != nullptr && simulation.ticks() < slices_due_) return;
    slices_due_ = simulation.ticks() + slice_interval;
    const double step = slice_steps * spacing_;
    along_ = std::make_shared<ViewedSlice>(bone_slice(simulation, tool_from_along, step, slice_edge));
    across_ = std::make_shared<ViewedSlice>(bone_slice(simulation, tool_from_across, step, slice_edge));
}

std::shared_ptr<const ViewedInspection> Inspector::inspect(const Simulation& simulation, const TickResult& result,
                                                           const Pose& world_from_handle) {
    auto inspection = std::make_shared<ViewedInspection>();
    inspection->tick = simulation.ticks();
    inspection->tool = simulation.tool();
    inspection->world_from_tool = simulation.world_from_tool();
    add_samples(simulation, *inspection);
    inspection->channels = viewed_channels(simulation, result);
    Vec3 of_channels{};
    for (ViewedChannel& channel : inspection->channels) {
        channel.point = point_of(channel, inspection->samples);
        of_channels = of_channels + channel.force * channel.along;
    }
    inspection->following =
        rotate(conjugate(result.world_from_tool.rotation), linear(result.bone_on_tool)) + of_channels;
    const std::uint32_t signals = simulation.setup().force->force->signal_count;
    std::copy_n(simulation.signals(), std::min<std::size_t>(signals, max_viewed_signals), inspection->signals.begin());
    inspection->parts = result.parts;
    inspection->coupling = viewed_coupling(simulation, result, world_from_handle);
    renew_slices(simulation);
    inspection->along = along_;
    inspection->across = across_;
    return inspection;
}

}  // namespace kerf::run
