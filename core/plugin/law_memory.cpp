// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/law_memory.h"

#include <algorithm>

namespace kerf {

namespace {

static_assert(KERF_MAX_CHANNELS == 16 && KERF_MAX_ACTIONS == 8, "the messages have the numbers");

constexpr std::size_t in_front = 64;  // bytes that stay zero

template <class T>
T* made(GuardedMemory& memory, std::size_t count, const char* beyond) {
    constexpr std::size_t before = (in_front + sizeof(T) - 1) / sizeof(T);
    return static_cast<T*>(memory.allocate((before + count) * sizeof(T), alignof(T), beyond)) + before;
}

}  // namespace

LawMemory::LawMemory(std::size_t state_size)
    : state_end_(made<std::byte>(memory_, std::max<std::size_t>(1, state_size),
                                 "touched memory beyond its state, of `state_size` bytes") +
                 std::max<std::size_t>(1, state_size)),
      state_(state_end_),
      signals_end_(made<double>(memory_, KERF_MAX_SIGNALS,
                                "touched memory beyond `signal`, which has as many elements as it declares signals") +
                   KERF_MAX_SIGNALS),
      signals_(signals_end_),
      law_(made<kerf_law>(memory_, 1, "touched memory beyond `note`, which has `KERF_NOTE_BYTES` bytes")),
      channel_(
          made<kerf_channel>(memory_, KERF_MAX_CHANNELS, "touched memory beyond `channel`, which has 16 elements")),
      out_(made<kerf_commit_out>(memory_, 1, "touched memory beyond `kerf_commit_out`")),
      action_(made<kerf_action>(memory_, KERF_MAX_ACTIONS, "touched memory beyond `action`, which has 8 elements")),
      thread_(made<kerf_thread>(memory_, 1, "touched memory beyond `thread`, which has 1 element")) {}

void LawMemory::fit(const kerf_force& force) noexcept {
    const std::size_t alignment = force.state_align;
    state_ = state_end_ - (force.state_size + alignment - 1) / alignment * alignment;
    signals_ = signals_end_ - force.signal_count;
    std::fill(signals_, signals_end_, 0.0);
    static_cast<void>(take_underrun());  // of a state and signals of other sizes
}

const char* LawMemory::take_underrun() noexcept {
    struct Array {
        void* begin;
        const char* name;
    };
    const char* found = nullptr;
    for (const auto& [begin, name] : {Array{channel_, "channel"},
                                      {state_, "state"},
                                      {action_, "action"},
                                      {signals_, "signal"},
                                      {thread_, "thread"}}) {
        auto* const front = static_cast<std::byte*>(begin) - in_front;
        if (std::all_of(front, front + in_front, [](std::byte b) { return b == std::byte{}; })) continue;
        std::fill_n(front, in_front, std::byte{});
        found = name;
    }
    return found;
}

kerf_law& LawMemory::new_law() noexcept {
    std::fill_n(channel_, KERF_MAX_CHANNELS, kerf_channel{});
    *law_ = {sizeof(kerf_law), 0, channel_, {}, {}};
    return *law_;
}

kerf_commit_out& LawMemory::new_commit_out() noexcept {
    std::fill_n(action_, KERF_MAX_ACTIONS, kerf_action{});
    *thread_ = {};
    *out_ = {sizeof(kerf_commit_out), 0, action_, signals_, thread_, 0, 0};
    return *out_;
}

}  // namespace kerf
