// SPDX-License-Identifier: Apache-2.0
#include "devices/hid/hid_reader.h"

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

namespace kerf::hid {

namespace {

constexpr int wait_ms = 5;               // maximum wait before old values expire
constexpr int max_reports = 128;         // of one step: twice what the kernel keeps
constexpr double search_interval = 1.0;  // [s]
constexpr std::size_t max_size = 64;     // [bytes] of a report at full speed

kerf_device_state at_rest(std::uint64_t reports, std::uint32_t flags) noexcept {
    kerf_device_state state{};
    state.reports = reports;
    state.device_from_handle.rotation.w = 1.0;
    state.flags = flags;
    return state;
}

}  // namespace

HidReader::HidReader(std::unique_ptr<HidTransport> transport, const HidModel& model, HidDevice device)
    : transport_(std::move(transport)), model_(model), device_(std::move(device)), decoder_(model.decoder()) {}

std::string HidReader::open() {
    std::string refusal = transport_->open(device_.entry.path);
    if (refusal.empty()) begin();
    return refusal;
}

/// A device at rest sends nothing, so its state is valid at once.
void HidReader::begin() {
    decoder_ = model_.decoder();
    state_ = at_rest(state_.reports, KERF_DEVICE_VALID);
    is_open_ = true;
}

void HidReader::lose(double now) noexcept {
    transport_->close();
    state_ = at_rest(state_.reports, 0);
    is_open_ = false;
    next_search_ = now + search_interval;
}

bool HidReader::find_again(double now) noexcept {
    if (now < next_search_) return false;
    next_search_ = now + search_interval;
    try {
        for (const HidDevice& found : devices_of(model_, transport_->enumerate())) {
            if (found.id != device_.id || !transport_->open(found.entry.path).empty()) continue;
            device_.entry = found.entry;
            begin();
            return true;
        }
    } catch (const std::exception&) {
        return false;  // out of memory, perhaps: it tries again
    }
    return false;
}

bool HidReader::step(double now) noexcept {
    if (!is_open_) return find_again(now);
    std::array<std::uint8_t, max_size> bytes{};
    bool has_changed = false;
    for (int i = 0; i < max_reports; ++i) {
        const HidRead read = transport_->read(bytes, i == 0 ? wait_ms : 0);
        if (read.status == HidRead::Status::nothing) break;
        if (read.status == HidRead::Status::lost) {
            lose(now);
            return true;
        }
        if (decoder_->take({bytes.data(), std::min(read.size, bytes.size())}, now, state_)) {
            ++state_.reports;
            has_changed = true;
        } else {
            ++ignored_;
        }
    }
    return decoder_->expire(now, state_) || has_changed;
}

}  // namespace kerf::hid
