// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kerf {

/// Points fixed to something that moves, and how far from all bone each was when it was last asked about: those that cannot have come
/// near since need not be asked again.
///
/// A distance changes by no more than `LiveBody::steepness` times the way, and cutting only makes it larger. Who brings bone nearer in
/// another way (moves a body, puts one in, takes a cut back) calls `forget`.
class Clearances {
public:
    explicit Clearances(std::size_t most);

    /// There are `count` points, at most as many as were said. Nothing is known of them.   [haptic, nonblocking]
    void begin(std::size_t count) noexcept;
    void forget() noexcept { begin(count_); }
    /// No distance has become less by more than this [m] since the last call.   [haptic, nonblocking]
    void move(double most) noexcept { moved_ += most; }

    /// Those that may be nearer than `margin` [m], until the next call. Pre: each of the last call's was noted.   [haptic, nonblocking]
    [[nodiscard]] std::span<const std::uint32_t> within(double margin) noexcept;
    /// One of those is not nearer now than this [m].   [haptic, nonblocking]
    void note(std::uint32_t point, double clear) noexcept;

private:
    static constexpr std::size_t group = 64;

    std::size_t count_ = 0;
    double moved_ = 0.0;
    std::vector<double> until_;    ///< of each point: how far all may have moved when it touches
    std::vector<double> soonest_;  ///< of each 64 of them
    std::vector<std::uint32_t> within_;
};

}  // namespace kerf
