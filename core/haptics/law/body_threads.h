// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kerf/math.hpp"

namespace kerf {

/// Returns the name of the first field that makes a thread unusable, or null for a sound thread.   [any] pure.
[[nodiscard]] const char* fault_of(const kerf_thread& thread) noexcept;

/// Pose of a tool in one body.
struct ToolInBody {
    std::uint16_t body;
    Pose body_from_tool;
};

/// The threads that taps and screws have cut into bone. They belong to bodies and move with them.
class BodyThreads {
public:
    BodyThreads() = default;
    BodyThreads(const BodyThreads& other) noexcept { *this = other; }
    /// Copies the used entries only: in lock-step the scene gets a copy in each tick that removes bone or is clear of
    /// bone.
    BodyThreads& operator=(const BodyThreads& other) noexcept;

    /// Writes the threads of the bodies in `near`, in the tool frame, at most `capacity` of them. Returns the number of
    /// all threads of these bodies, which may be larger.   [haptic, nonblocking]
    std::uint32_t write(std::span<const ToolInBody> near, kerf_thread* out, std::uint32_t capacity) const noexcept;
    /// Stores a thread that a law has cut or changed, given in the tool frame. Returns false, and stores nothing, if it
    /// is unsound or its body is not in `near`. Also if it is new and the table is full, or if no thread has its
    /// number. [haptic, nonblocking]
    [[nodiscard]] bool leave(const kerf_thread& thread, std::span<const ToolInBody> near) noexcept;
    /// Copies the threads of body `from` to body `to`, which was separated from it, until the table is full. The copies
    /// do not count in `volume`.   [haptic, nonblocking]
    void inherit(std::uint16_t from, std::uint16_t to) noexcept;

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// Returns thread `i`, with its pose in the body frame.
    [[nodiscard]] const kerf_thread& thread(std::size_t i) const noexcept { return kept_[i].thread; }
    [[nodiscard]] bool is_full() const noexcept { return count_ == kept_.size(); }
    /// Returns the volume of bone that the thread grooves have removed [m³].
    [[nodiscard]] double volume() const noexcept;

private:
    struct StoredThread {
        kerf_thread thread{};       ///< its member `tool_from_thread` stores body_from_thread here
        bool is_passed_on = false;  ///< a copy: the volume of its groove is counted with the original
    };
    std::array<StoredThread, KERF_MAX_THREADS> kept_{};  ///< the first `count_` are in use
    std::size_t count_ = 0;
};

}  // namespace kerf
