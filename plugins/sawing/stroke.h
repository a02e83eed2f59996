// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

/// The oscillation: how fast the teeth go, and how thick a chip they take.
namespace kerf::sawing {

/// x = (S/2) sin φ, so that the teeth go at V = π u S cos φ: 2 S u in the mean.
struct Stroke {
    double length;  ///< S [m], from one turning point of a tooth to the other
    double pitch;   ///< p [m]
    double rate;    ///< u [1/s] > 0

    [[nodiscard]] double mean_speed() const noexcept { return 2.0 * length * rate; }  ///< [m/s]
};

/// Chip thickness for each metre a second of feed [s], at |cos φ| of the oscillation.
///
///     t/f = min(p/|V|, 1/(2u))
///
/// Each tooth takes what the feed has gained since the tooth before it passed, p/|V| ago. At the turning points no
/// tooth passes any more: a tooth takes no more than the advance of half a cycle.   [any] pure.
///
/// Source: band sawing's f p/V [ko-kim-1999, as quoted by hsieh-2006]; the cap is ours (validation C.7).
[[nodiscard]] double chip_per_feed(const Stroke& stroke, double cos_phase) noexcept;

/// The oscillation in two parts, for forces averaged over it: the quarter next to the turning points, and the rest. In
/// each all chips are as thick as in the mean. The mean of 1 − e^(−t/t_e) over the true oscillation is met within 3.1 %
/// for 1 mm … 1.41 mm of pitch and 3 mm … 5.2 mm of stroke; that of t, to the sum's 0.2 %.
struct StrokePart {
    double share;          ///< [–] of the time
    double chip_per_feed;  ///< [s]
};
inline constexpr std::size_t part_count = 2;
[[nodiscard]] std::array<StrokePart, part_count> parts_of(const Stroke& stroke) noexcept;

/// Of the whole oscillation, in the mean [s].   [any] pure.
[[nodiscard]] double mean_chip_per_feed(const Stroke& stroke) noexcept;

}  // namespace kerf::sawing
