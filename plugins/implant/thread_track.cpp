// SPDX-License-Identifier: Apache-2.0
#include "thread_track.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace kerf::implant {

namespace {

// Limits within which a thread is the tool's own [judgement]
constexpr double same_lead = 0.02;  // [–] of the lead
constexpr double max_tilt = 0.17;   // [–] sine of 10°
constexpr double within = 1.0;      // [–] leads before its beginning

double across(Vec3 v) noexcept { return std::sqrt(v.x * v.x + v.y * v.y); }

}  // namespace

ThreadTrack::ThreadTrack(const kerf_thread& thread) noexcept
    : thread_(thread),
      thread_from_tool_(inverse(thread.tool_from_thread)),
      axis_(rotate(thread.tool_from_thread.rotation, {0, 0, 1})),
      is_there_(true) {}

ThreadTrack ThreadTrack::found(const BoneQuery& bone, const ScrewThread& tool, std::uint32_t held) noexcept {
    std::array<kerf_thread, KERF_MAX_THREADS> all;
    const std::size_t count = bone.threads(all);
    ThreadTrack best;
    double nearest = tool.depth(tool.first_crest());  // [m] if farther from the axis, the crests meet other bone
    bool is_crossed = false;
    for (std::size_t i = 0; i < count; ++i) {
        const ThreadTrack track(all[i]);
        if (all[i].number == held && track.axis_.z > 0.0) return track;
        if (track.axis_.z <= 0.0 || across(track.axis_) > max_tilt) continue;
        const double front = track.depth_of({0, 0, tool.first_crest()});
        if (front < all[i].from - within * all[i].lead) continue;
        const double offset = across(track.offset(tool.first_crest()));
        if (offset > nearest) continue;
        if (std::abs(all[i].lead - tool.lead()) > same_lead * tool.lead()) {
            is_crossed = is_crossed || front > all[i].from;
            continue;
        }
        nearest = offset;
        best = track;
    }
    best.is_crossed_ = is_crossed;
    return best;
}

ThreadTrack ThreadTrack::begun(const ScrewThread& tool, double leading, std::int32_t body) noexcept {
    kerf_thread thread{};
    thread.tool_from_thread = identity_pose();
    thread.lead = tool.lead();
    thread.radius = 0.5 * tool.outer;
    thread.core = 0.5 * tool.core;
    thread.from = thread.to = leading;
    thread.tapped_to = thread.from;
    thread.slip_from = thread.from - tool.lead();
    thread.slip_step = std::max(0.5 * tool.pitch, (tool.length + 2.0 * tool.lead()) / KERF_THREAD_BINS);
    thread.body = body;
    thread.number = KERF_NEW_THREAD;
    return ThreadTrack(thread);
}

double ThreadTrack::fraction_tapped(double z, double outer_radius, double core_radius) const noexcept {
    if (!is_there_ || z > thread_.tapped_to || thread_.tapped_to <= thread_.from || outer_radius <= core_radius)
        return 0.0;
    return std::clamp((thread_.tapped_radius - core_radius) / (outer_radius - core_radius), 0.0, 1.0);
}

std::size_t ThreadTrack::bin_of(double z) const noexcept {
    const double bin = std::floor((z - thread_.slip_from) / thread_.slip_step);
    return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(KERF_THREAD_BINS - 1)));
}

void ThreadTrack::add_slip(double from, double to, double slip) noexcept {
    if (slip <= 0.0) return;
    for (std::size_t bin = bin_of(from); bin <= bin_of(to); ++bin) thread_.slip[bin] += slip;
}

Vec3 ThreadTrack::offset(double z) const noexcept {
    const Vec3 origin = thread_.tool_from_thread.position;
    const Vec3 there = origin + ((z - origin.z) / axis_.z) * axis_;
    return {-there.x, -there.y, 0.0};
}

void ThreadTrack::yield_plastically(Vec3 offset, Vec3 inclination, double z) noexcept {
    if (offset == Vec3{} && inclination == Vec3{}) return;
    Pose& pose = thread_.tool_from_thread;
    const Quat turn = quat_from_rotation_vector(inclination);
    const Vec3 pivot{0, 0, z};
    pose.position = pivot + rotate(turn, pose.position - pivot) + offset;
    pose.rotation = normalized(turn * pose.rotation);
}

}  // namespace kerf::implant
