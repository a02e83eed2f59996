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

/// The solid of a tool, as its `outline()` returns it. Points are (z, radius) in the tool frame [m], from the tip
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
    /// Appends an arc of a ball about (`centre_z`, 0), from its tip to the polar angle `end` [rad], in `pieces` chords;
    /// the first point, at its tip, too. `end` may lie behind the equator.
    Outline& ball(double centre_z, double radius, double end, std::size_t pieces = 12) noexcept {
        for (std::size_t i = 0; i <= pieces; ++i) {
            const SinCos angle = sin_cos_exact(end * static_cast<double>(i) / static_cast<double>(pieces));
            to(centre_z + radius * angle.cos, radius * angle.sin);
        }
        return *this;
    }
    /// All that is listed so far removes bone while the law cuts; what follows does not. Never called: nothing does.
    /// After `safe()` a further part cuts.
    constexpr Outline& cuts() noexcept {
        cutting_ = count_;
        if (has_gap_) ++gaps_;
        has_gap_ = false;
        return *this;
    }
    /// What is listed so far is safe: it removes no bone. The region that does begins at its last point, with a flat
    /// front: a reamer behind its pilot, a file behind its tip, a saw with a safe end. After `cuts()`, what is listed
    /// since then is safe, and a further part that cuts begins: a second head behind a neck. At most KERF_MAX_GAPS
    /// times.
    constexpr Outline& safe() noexcept {
        if (cutting_ == 0) {
            safe_ = count_;
        } else if (gaps_ < KERF_MAX_GAPS) {
            gap_[gaps_] = {static_cast<std::uint32_t>(cutting_ - 1), static_cast<std::uint32_t>(count_ - 1)};
            has_gap_ = true;
        }
        return *this;
    }
    /// A bore of this radius [m] goes through all that removes bone: a trephine. What is in it stays.
    constexpr Outline& hollow(double radius) noexcept {
        bore_ = radius;
        return *this;
    }
    /// The hand holds the tool on its axis at `z` < 0 [m].
    constexpr Outline& gripped_at(double z) noexcept {
        grip_z_ = z;
        return *this;
    }
    /// Both hands hold it there, as a saw; a drill is held in one.
    constexpr Outline& in_both_hands() noexcept {
        hands_ = 2;
        return *this;
    }
    struct Bending {
        double deflection;  ///< [m/N] of the tip, by a force across it
        double slope;       ///< [rad/N] of the tip, by the same force
    };
    /// The shaft bends, held at the grip. What touches the bone behind the tip must leave this out.
    constexpr Outline& bends(Bending bending) noexcept {
        bending_ = bending;
        return *this;
    }
    struct Weight {
        double mass;      ///< [kg] of the tool with its handpiece
        double centre_z;  ///< [m] where its centre lies on the axis
        double gyration;  ///< [m] its radius of gyration about that centre, > 0
    };
    constexpr Outline& weighs(Weight weight) noexcept {
        weight_ = weight;
        return *this;
    }
    struct Thread {
        double radius;  ///< [m] over the crests
        double lead;    ///< [m] in one turn
    };
    /// All that is listed so far, behind the tip's cone, has a thread around it.
    constexpr Outline& threaded(Thread thread) noexcept {
        thread_ = thread;
        threaded_ = count_;
        return *this;
    }
    /// All that is listed so far stays in bone when its driver leaves: an implant.
    constexpr Outline& stays() noexcept {
        stay_ = count_;
        return *this;
    }
    [[nodiscard]] constexpr const kerf_profile_point& last() const noexcept { return point_[count_ - 1]; }

    /// Writes it into what the host gave.
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
    bool has_gap_ = false;  ///< one more, which the next cuts() ends
    std::uint32_t kind_ = KERF_SOLID_REVOLUTION, hands_ = 1;
    double grip_z_ = 0.0, kerf_ = 0.0, thickness_ = 0.0, bore_ = 0.0;
    Thread thread_{};
    Weight weight_{};
    Bending bending_{};
    std::array<char, sizeof(kerf_tool_shape::refusal)> refusal_{};
};

/// Turned about the tool's z axis.
[[nodiscard]] inline Outline revolution(std::initializer_list<kerf_profile_point> points = {}) noexcept {
    Outline outline;
    for (const kerf_profile_point& p : points) outline.to(p.z, p.radius);
    return outline;
}
/// A blade: each radius is half of its width along x. What cuts is `kerf` [m] thick across y, the blade behind it
/// `thickness` [m].
[[nodiscard]] inline Outline prism(double kerf, double thickness) noexcept {
    Outline outline;
    outline.kind_ = KERF_SOLID_PRISM;
    outline.kerf_ = kerf;
    outline.thickness_ = thickness;
    return outline;
}

/// What `outline()` returns for parameters that do not go together, each within its range: which, what they are, and
/// what is needed. Text beyond the room for it is cut off.
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
