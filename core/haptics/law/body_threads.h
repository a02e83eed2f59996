// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kerf/math.hpp"

namespace kerf {

/// Returns the first field of a thread with which the host cannot keep it; null for a sound one.   [any] pure.
[[nodiscard]] const char* fault_of(const kerf_thread& thread) noexcept;

/// Where a tool is in a body.
struct ToolInBody {
    std::uint16_t body;
    Pose body_from_tool;
};

/// The threads that taps and screws have cut into bone. They belong to bodies and move with them.
class BodyThreads {
public:
    BodyThreads() = default;
    BodyThreads(const BodyThreads& other) noexcept { *this = other; }
    /// Copies what is in use: a loop tells its scene of them in each tick.
    BodyThreads& operator=(const BodyThreads& other) noexcept;

    /// Writes the threads in the bodies near a tool, in its frame, `capacity` at most. Returns how many there are.
    /// [haptic, nonblocking]
    std::uint32_t write(std::span<const ToolInBody> near, kerf_thread* out, std::uint32_t capacity) const noexcept;
    /// Keeps what a law has left of a thread, in the frame of the tool. An unsound one, one of a body that is not near,
    /// or one more than there is room for is not kept. Returns whether it is.   [haptic, nonblocking]
    [[nodiscard]] bool leave(const kerf_thread& thread, std::span<const ToolInBody> near) noexcept;
    /// Body `to` came of body `from`: the same threads run through it, as far as there is room.   [haptic, nonblocking]
    void pass_on(std::uint16_t from, std::uint16_t to) noexcept;

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// Of thread `i`; its pose is that in its body.
    [[nodiscard]] const kerf_thread& thread(std::size_t i) const noexcept { return kept_[i].thread; }
    [[nodiscard]] bool is_full() const noexcept { return count_ == kept_.size(); }
    /// Of bone that their grooves have taken [m³].
    [[nodiscard]] double volume() const noexcept;

private:
    struct Kept {
        kerf_thread thread{};       ///< `tool_from_thread` holds the body's pose of it
        bool is_passed_on = false;  ///< its groove is counted in another body
    };
    std::array<Kept, KERF_MAX_THREADS> kept_{};  ///< the first `count_` are in use
    std::size_t count_ = 0;
};

}  // namespace kerf
