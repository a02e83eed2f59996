// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "kerf/abi.h"
#include "kerf/exact_math.hpp"
#include "kerf/figure.hpp"

namespace kerf {

/// The solid of a tool, the result of its `outline()`. Points are (z, radius) in the tool frame [m], from the tip
/// backwards, z decreasing.
///
///     return revolution({{0, 0}, {-2_mm, 2_mm}}).cuts().to(-90_mm, 2_mm).gripped_at(-130_mm);
///
/// [main] pure.
class Outline {
public:
    static constexpr std::size_t capacity = 64;

    /// Appends a point.
    constexpr Outline& to(double z, double radius) noexcept {
        if (count_ < capacity) point_[count_] = {z, radius};
        ++count_;
        return *this;
    }
    /// Appends an arc about (`centre_z`, 0) in `pieces` chords: from the ball's tip, included, to the angle `end`
    /// [rad], measured from +z at the centre. `end` may be above π/2, behind the equator.
    Outline& ball(double centre_z, double radius, double end, std::size_t pieces = 12) noexcept {
        for (std::size_t i = 0; i <= pieces; ++i) {
            const SinCos angle = sin_cos_exact(end * static_cast<double>(i) / static_cast<double>(pieces));
            to(centre_z + radius * angle.cos, radius * angle.sin);
        }
        return *this;
    }
    /// Ends a part that removes bone while the law cuts: all points so far, or all since `safe()`. Later points remove
    /// none. Without a call, no part removes bone.
    constexpr Outline& cuts() noexcept {
        cutting_ = count_;
        if (has_gap_) ++gaps_;
        has_gap_ = false;
        return *this;
    }
    /// Ends a part that removes no bone. Before the first `cuts()`: the cutting part begins at the last point, with a
    /// flat front. Examples are a reamer behind its pilot and a saw with a safe end. After `cuts()`: the points since
    /// then are safe and another cutting part begins, as a second head behind a neck; at most KERF_MAX_GAPS times.
    constexpr Outline& safe() noexcept {
        if (cutting_ == 0) {
            safe_ = count_;
        } else if (gaps_ < KERF_MAX_GAPS) {
            gap_[gaps_] = {static_cast<std::uint32_t>(cutting_ - 1), static_cast<std::uint32_t>(count_ - 1)};
            has_gap_ = true;
        }
        return *this;
    }
    /// Adds a bore of this radius [m] through the cutting part: a trephine. The core in it is not cut.
    constexpr Outline& hollow(double radius) noexcept {
        bore_ = radius;
        return *this;
    }
    /// Sets the point of the axis at which the hand grips the tool: `z` < 0 [m].
    constexpr Outline& gripped_at(double z) noexcept {
        grip_z_ = z;
        return *this;
    }
    /// Sets two hands on the tool, as on a saw. Default: one hand.
    constexpr Outline& in_both_hands() noexcept {
        hands_ = 2;
        return *this;
    }
    struct Bending {
        double deflection;  ///< [m/N] of the tip, by a force across it
        double slope;       ///< [rad/N] of the tip, by the same force
    };
    /// Sets the bending of the shaft, clamped at the grip. A law's stiffness of contact behind the tip must not include
    /// it.
    constexpr Outline& bends(Bending bending) noexcept {
        bending_ = bending;
        return *this;
    }
    struct Weight {
        double mass;      ///< [kg] of the tool with its handpiece
        double centre_z;  ///< [m] position of the centre of mass on the axis
        double gyration;  ///< [m] radius of gyration about that centre, > 0
    };
    constexpr Outline& weighs(Weight weight) noexcept {
        weight_ = weight;
        return *this;
    }
    struct Thread {
        double radius;  ///< [m] over the crests
        double lead;    ///< [m] advance in one turn
    };
    /// Adds a thread around all points so far, except the cone of the tip from the first point to the second.
    constexpr Outline& threaded(Thread thread) noexcept {
        thread_ = thread;
        threaded_ = count_;
        return *this;
    }
    /// Makes the tool an implant: all points so far stay in bone when the driver leaves.
    constexpr Outline& stays() noexcept {
        stay_ = count_;
        return *this;
    }
    [[nodiscard]] constexpr const kerf_profile_point& last() const noexcept { return point_[count_ - 1]; }

    /// Writes the outline for the host. Returns KERF_OUT_OF_RANGE after `refuse`, KERF_CAPACITY for too many points.
    [[nodiscard]] kerf_status write(kerf_tool_shape& out) const noexcept {
        if (refusal_[0] != '\0') {
            std::copy(refusal_.begin(), refusal_.end(), out.refusal);
            return KERF_OUT_OF_RANGE;
        }
        if (count_ > capacity || count_ > out.profile_capacity) return KERF_CAPACITY;
        std::copy_n(point_.begin(), count_, out.profile);
        out.profile_count = static_cast<std::uint32_t>(count_);
        const std::size_t first = safe_ > 0 ? safe_ - 1 : 0;
        out.cutting_first = static_cast<std::uint32_t>(first);
        out.cutting_count = static_cast<std::uint32_t>(cutting_ > first ? cutting_ - first : 0);
        out.bore = bore_;
        std::copy_n(gap_.begin(), gaps_, out.gap);
        out.gap_count = static_cast<std::uint32_t>(gaps_);
        out.grip_z = grip_z_;
        out.hands = hands_;
        out.tip_deflection = bending_.deflection;
        out.tip_slope = bending_.slope;
        out.kind = kind_;
        out.kerf = kerf_;
        out.thickness = thickness_;
        out.mass = weight_.mass;
        out.centre_z = weight_.centre_z;
        out.gyration = weight_.gyration;
        out.thread_radius = thread_.radius;
        out.thread_lead = thread_.lead;
        out.stay_count = static_cast<std::uint32_t>(stay_);
        out.thread_count = static_cast<std::uint32_t>(threaded_);
        return KERF_OK;
    }

private:
    friend Outline revolution(std::initializer_list<kerf_profile_point> points) noexcept;
    friend Outline prism(double kerf, double thickness) noexcept;
    template <typename... Pieces>
    friend Outline refuse(const Pieces&... pieces) noexcept;

    std::array<kerf_profile_point, capacity> point_{};
    std::size_t count_ = 0, safe_ = 0, cutting_ = 0, stay_ = 0, threaded_ = 0;
    std::array<kerf_gap, KERF_MAX_GAPS> gap_{};
    std::size_t gaps_ = 0;
    bool has_gap_ = false;  ///< a gap that the next cuts() ends
    std::uint32_t kind_ = KERF_SOLID_REVOLUTION, hands_ = 1;
    double grip_z_ = 0.0, kerf_ = 0.0, thickness_ = 0.0, bore_ = 0.0;
    Thread thread_{};
    Weight weight_{};
    Bending bending_{};
    std::array<char, sizeof(kerf_tool_shape::refusal)> refusal_{};
};

/// Returns an outline turned about the tool's z axis.
[[nodiscard]] inline Outline revolution(std::initializer_list<kerf_profile_point> points = {}) noexcept {
    Outline outline;
    for (const kerf_profile_point& p : points) outline.to(p.z, p.radius);
    return outline;
}
/// Returns a blade: each radius is half of its width along x. The cutting part is `kerf` [m] thick across y, and the
/// blade behind it `thickness` [m].
[[nodiscard]] inline Outline prism(double kerf, double thickness) noexcept {
    Outline outline;
    outline.kind_ = KERF_SOLID_PRISM;
    outline.kerf_ = kerf;
    outline.thickness_ = thickness;
    return outline;
}

/// Returns an `outline()` that refuses parameters that conflict, although each is within its range. The text gives the
/// parameters, their values and the values that are needed. It is cut off at the size of kerf_tool_shape::refusal.
///
///     return refuse("`shoulder_diameter` is ", in_mm(3.0_mm), "; it needs more than `diameter`, ", in_mm(4.0_mm),
///     ".");
template <typename... Pieces>
[[nodiscard]] Outline refuse(const Pieces&... pieces) noexcept {
    Outline outline;
    std::size_t at = 0;
    const auto add = [&](std::string_view piece) {
        for (const char c : piece)
            if (at + 1 < outline.refusal_.size()) outline.refusal_[at++] = c;
    };
    (add(static_cast<std::string_view>(pieces)), ...);
    return outline;
}

}  // namespace kerf
