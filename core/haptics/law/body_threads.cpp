// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/body_threads.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

bool is_at_least(double value, double minimum) noexcept { return std::isfinite(value) && value >= minimum; }

bool is_pose(const kerf_pose& pose) noexcept {
    const auto& [p, q] = pose;
    const double size = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::abs(size - 1.0) < 1e-6;
}

const ToolInBody* in_body(std::span<const ToolInBody> near, std::int32_t body) noexcept {
    const auto at = std::find_if(near.begin(), near.end(), [&](const ToolInBody& b) { return b.body == body; });
    return at != near.end() ? &*at : nullptr;
}

}  // namespace

const char* fault_of(const kerf_thread& thread) noexcept {
    constexpr double widest = 0.1;  // [m]
    if (!is_pose(thread.tool_from_thread)) return "tool_from_thread";
    if (!(is_at_least(thread.lead, 0.0) && thread.lead > 0.0)) return "lead";
    if (!(is_at_least(thread.core, 0.0) && thread.core < widest)) return "core";
    if (!(is_at_least(thread.radius, thread.core) && thread.radius < widest)) return "radius";
    if (!std::isfinite(thread.from)) return "from";
    if (!is_at_least(thread.to, thread.from)) return "to";
    if (!std::isfinite(thread.tapped_to)) return "tapped_to";
    if (!is_at_least(thread.tapped_radius, 0.0)) return "tapped_radius";
    if (!is_at_least(thread.volume, 0.0)) return "volume";
    if (!std::isfinite(thread.slip_from)) return "slip_from";
    if (!(is_at_least(thread.slip_step, 0.0) && thread.slip_step > 0.0)) return "slip_step";
    for (const double slip : thread.slip)
        if (!is_at_least(slip, 0.0)) return "slip";
    return nullptr;
}

BodyThreads& BodyThreads::operator=(const BodyThreads& other) noexcept {
    count_ = other.count_;
    std::copy_n(other.kept_.begin(), count_, kept_.begin());
    return *this;
}

std::uint32_t BodyThreads::write(std::span<const ToolInBody> near, kerf_thread* out,
                                 std::uint32_t capacity) const noexcept {
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        const kerf_thread& thread = kept_[i].thread;
        const ToolInBody* const at = in_body(near, thread.body);
        if (at == nullptr) continue;
        if (found < capacity) {
            out[found] = thread;
            out[found].tool_from_thread = inverse(at->body_from_tool) * thread.tool_from_thread;
        }
        ++found;
    }
    return found;
}

bool BodyThreads::leave(const kerf_thread& thread, std::span<const ToolInBody> near) noexcept {
    const ToolInBody* const at = in_body(near, thread.body);
    if (at == nullptr || fault_of(thread) != nullptr) return false;
    const bool is_new = thread.number == KERF_NEW_THREAD;
    if (is_new ? is_full() : thread.number >= count_) return false;
    const std::size_t number = is_new ? count_++ : thread.number;
    StoredThread& kept = kept_[number];
    if (is_new) kept.is_passed_on = false;
    kept.thread = thread;
    kept.thread.number = static_cast<std::uint32_t>(number);
    Pose& pose = kept.thread.tool_from_thread;
    pose = at->body_from_tool * pose;
    pose.rotation = normalized(pose.rotation);
    return true;
}

void BodyThreads::inherit(std::uint16_t from, std::uint16_t to) noexcept {
    const std::size_t before = count_;
    for (std::size_t i = 0; i < before && !is_full(); ++i) {
        if (kept_[i].thread.body != from) continue;
        StoredThread& copy = kept_[count_];
        copy = {kept_[i].thread, true};
        copy.thread.body = to;
        copy.thread.number = static_cast<std::uint32_t>(count_++);
    }
}

double BodyThreads::volume() const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < count_; ++i)
        if (!kept_[i].is_passed_on) sum += kept_[i].thread.volume;
    return sum;
}

}  // namespace kerf
