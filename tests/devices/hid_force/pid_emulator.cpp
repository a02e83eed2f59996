// SPDX-License-Identifier: Apache-2.0
#include "tests/devices/hid_force/pid_emulator.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

namespace kerf::test {

namespace {

using hid::ReportKind;

std::int64_t number_at(std::span<const std::uint8_t> report, At at) {
    std::int64_t value = 0;
    for (unsigned i = at.bits; i > 0; --i) {
        const unsigned bit = at.bit + i - 1;
        value = 2 * value + (report[bit / 8] >> (bit % 8) & 1);
    }
    return at.is_signed && value >= std::int64_t{1} << (at.bits - 1) ? value - (std::int64_t{1} << at.bits) : value;
}

void write_at(std::span<std::uint8_t> report, At at, std::int64_t value) {
    for (unsigned i = 0; i < at.bits; ++i) {
        const unsigned bit = at.bit + i;
        const auto mask = static_cast<std::uint8_t>(1u << (bit % 8));
        report[bit / 8] =
            static_cast<std::uint8_t>((value >> i & 1) != 0 ? report[bit / 8] | mask : report[bit / 8] & ~mask);
    }
}

}  // namespace

void PidEmulator::note(const std::string& what, std::span<const std::uint8_t> report) {
    if (fault_.empty()) fault_ = what + " in report " + std::to_string(report.empty() ? 0 : report[0]);
}

bool PidEmulator::is_known(ReportKind kind, std::span<const std::uint8_t> report) {
    const auto size = report.empty() ? firmware_.sizes.end() : firmware_.sizes.find({kind, report[0]});
    if (size == firmware_.sizes.end())
        note("unknown id", report);
    else if (size->second != report.size())
        note("wrong size", report);
    else
        return true;
    return false;
}

PidEmulator::Effect* PidEmulator::effect(std::span<const std::uint8_t> report, At block) {
    const auto found = effects_.find(number_at(report, block));
    if (found != effects_.end()) return &found->second;
    note("unknown block", report);
    return nullptr;
}

void PidEmulator::control(std::span<const std::uint8_t> report) {
    const auto& control = firmware_.control;
    const auto is = [&](unsigned number) {
        return control.is_mask ? (report[1] >> number & 1) != 0 : report[1] == number;
    };
    if (is(control.reset)) {
        effects_.clear();
        is_enabled_ = false;
    }
    if (is(control.stop_all) && control.stop_all_pauses)
        is_enabled_ = false;
    else if (is(control.stop_all))
        for (auto& [block, one] : effects_) one.is_playing = false;
    if (is(control.enable)) is_enabled_ = true;
    if (is(control.disable)) was_disabled_ = true;
}

void PidEmulator::set_effect(std::span<const std::uint8_t> report) {
    const auto& at = firmware_.effect;
    Effect* const one = effect(report, at.block);
    if (one == nullptr) return;
    if (number_at(report, at.type) != at.constant) note("wrong type", report);
    const std::int64_t counts = number_at(report, at.duration);
    one->duration =
        counts == (std::int64_t{1} << at.duration.bits) - 1 ? -1.0 : at.count_time * static_cast<double>(counts);
    one->gain = at.gain.bits > 0 ? static_cast<double>(number_at(report, at.gain)) / 255.0 : 1.0;
    // A direction is where a force comes from, so a positive one from the east pushes towards lower counts.
    if (at.direction.bits == 0) {
        one->sign = number_at(report, at.axis) != 0 ? -1.0 : 0.0;
    } else {
        const double circle = static_cast<double>(number_at(report, at.direction)) / at.full_circle;
        one->sign = number_at(report, at.direction_enable) != 0 ? -std::sin(2.0 * std::numbers::pi * circle) : 0.0;
    }
    one->is_set = true;
}

bool PidEmulator::take_output(std::span<const std::uint8_t> report) {
    const std::lock_guard lock(mutex_);
    outputs_.emplace_back(report.begin(), report.end());
    if (!is_known(ReportKind::output, report)) return true;  // a write never reports it
    if (report[0] == firmware_.control.id) {
        control(report);
    } else if (report[0] == firmware_.effect.id) {
        set_effect(report);
    } else if (report[0] == firmware_.force.id) {
        if (Effect* const one = effect(report, firmware_.force.block))
            one->magnitude = static_cast<double>(number_at(report, firmware_.force.magnitude)) / firmware_.force.full;
    } else if (report[0] == firmware_.operation.id) {
        Effect* const one = effect(report, firmware_.operation.block);
        const std::int64_t number = number_at(report, firmware_.operation.number);
        if (number != firmware_.operation.start && number != firmware_.operation.stop) note("wrong operation", report);
        if (one == nullptr) return true;
        one->is_playing = number == firmware_.operation.start;
        if (one->is_playing) one->started = clock_();
    } else if (report[0] == firmware_.free.id && firmware_.free.id != 0) {
        if (effect(report, firmware_.free.block) != nullptr) effects_.erase(number_at(report, firmware_.free.block));
    } else if (report[0] == firmware_.gain.id && firmware_.gain.id != 0) {
        gain_ = static_cast<double>(number_at(report, firmware_.gain.value)) / firmware_.gain.full;
    }
    return true;
}

bool PidEmulator::take_feature(std::span<const std::uint8_t> report) {
    const std::lock_guard lock(mutex_);
    if (!is_known(ReportKind::feature, report) || report[0] != firmware_.pool.create) return false;
    if (number_at(report, firmware_.pool.type) != firmware_.effect.constant) note("wrong type", report);
    created_ = 0;
    loads_left_ = pending_loads;
    if (effects_.size() >= max_blocks) return true;
    for (created_ = 1; effects_.contains(created_);) ++created_;
    effects_[created_] = {};
    return true;
}

std::size_t PidEmulator::give_feature(std::span<std::uint8_t> report) {
    const std::lock_guard lock(mutex_);
    if (!is_known(ReportKind::feature, report) || report[0] != firmware_.pool.load) return 0;
    const bool is_pending = loads_left_ > 0;
    if (is_pending) --loads_left_;
    write_at(report, firmware_.pool.block, is_pending ? 0 : created_);
    write_at(report, firmware_.pool.status,
             is_pending ? 0 : (created_ != 0 ? firmware_.pool.success : firmware_.pool.full));
    return report.size();
}

std::optional<std::vector<std::uint8_t>> PidEmulator::next_input() {
    const std::lock_guard lock(mutex_);
    if (inputs_.empty()) return std::nullopt;
    std::vector<std::uint8_t> report = std::move(inputs_.front());
    inputs_.pop_front();
    return report;
}

double PidEmulator::torque() const {
    const std::lock_guard lock(mutex_);
    if (!is_enabled_) return 0.0;
    double sum = 0.0;
    for (const auto& [block, one] : effects_) {
        const bool is_over = one.duration >= 0.0 && clock_() - one.started >= one.duration;
        if (one.is_set && one.is_playing && !is_over) sum += one.gain * one.sign * one.magnitude;
    }
    return firmware_.gain.is_ignored ? sum : sum * gain_.value_or(gain_at_start);
}

std::size_t PidEmulator::blocks() const {
    const std::lock_guard lock(mutex_);
    return effects_.size();
}
bool PidEmulator::was_disabled() const {
    const std::lock_guard lock(mutex_);
    return was_disabled_;
}
std::string PidEmulator::fault() const {
    const std::lock_guard lock(mutex_);
    return fault_;
}
std::vector<std::vector<std::uint8_t>> PidEmulator::outputs() const {
    const std::lock_guard lock(mutex_);
    return outputs_;
}

void PidEmulator::turn_to(std::int64_t counts) {
    std::vector<std::uint8_t> report(firmware_.sizes.at({ReportKind::input, firmware_.axis.id}));
    report[0] = firmware_.axis.id;
    write_at(report, firmware_.axis.value, counts);
    send_input(std::move(report));
}

void PidEmulator::send_input(std::vector<std::uint8_t> report) {
    const std::lock_guard lock(mutex_);
    inputs_.push_back(std::move(report));
}

void PidEmulator::lose_power() {
    const std::lock_guard lock(mutex_);
    effects_.clear();
    inputs_.clear();
    is_enabled_ = false;
    gain_.reset();
}

void PidTable::plug_in(const std::string& path, const std::string& serial) {
    const std::lock_guard lock(mutex);
    // hidapi lists a device once for each of its collections
    for (const std::uint16_t usage : {std::uint16_t{0x04}, std::uint16_t{0x21}})
        entries.push_back({.path = path,
                           .vendor = 0x1209,
                           .product = 0xffb0,
                           .usage_page = 0x01,
                           .usage = usage,
                           .serial = serial,
                           .name = "FFBoard"});
}

void PidTable::unplug() {
    {
        const std::lock_guard lock(mutex);
        entries.clear();
        is_open = false;
    }
    device->lose_power();
}

void PidTable::block_writes(double seconds) {
    const std::lock_guard lock(mutex);
    write_time = seconds;
}

bool PidTable::is_there(const std::string& path) const {
    const std::lock_guard lock(mutex);
    return std::any_of(entries.begin(), entries.end(), [&](const hid::HidEntry& entry) { return entry.path == path; });
}

std::vector<hid::HidEntry> PidTransport::enumerate() {
    const std::lock_guard lock(table_->mutex);
    ++table_->enumerations;
    return table_->entries;
}

std::string PidTransport::open(const std::string& path) {
    if (!table_->is_there(path)) return path + " is not there";
    const std::lock_guard lock(table_->mutex);
    if (!table_->refusal.empty()) return table_->refusal;
    if (table_->is_open) return path + " is in use by another program. End the other Kerf.";
    table_->is_open = true;
    path_ = path;
    return {};
}

hid::HidRead PidTransport::read(std::span<std::uint8_t> bytes, int timeout_ms) noexcept {
    using Status = hid::HidRead::Status;
    if (!table_->is_there(path_)) return {.status = Status::lost};
    const auto report = table_->device->next_input();
    if (!report) {
        std::this_thread::sleep_for(std::chrono::milliseconds(timeout_ms));
        return {};
    }
    const std::size_t size = std::min(report->size(), bytes.size());
    std::copy_n(report->begin(), size, bytes.begin());
    return {.status = Status::report, .size = size};
}

std::vector<std::uint8_t> PidTransport::descriptor(const std::string& path) {
    return table_->is_there(path) ? table_->device->firmware().descriptor : std::vector<std::uint8_t>{};
}

bool PidTransport::wait_for_device() {
    double time = 0.0;
    {
        const std::lock_guard lock(table_->mutex);
        time = table_->write_time;
        ++table_->writers;
    }
    if (time > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(time));
    {
        const std::lock_guard lock(table_->mutex);
        --table_->writers;
    }
    return table_->is_there(path_);
}

bool PidTransport::send(std::span<const std::uint8_t> report) noexcept {
    return wait_for_device() && table_->device->take_output(report);
}
bool PidTransport::send_feature(std::span<const std::uint8_t> report) noexcept {
    return wait_for_device() && table_->device->take_feature(report);
}
std::size_t PidTransport::get_feature(std::span<std::uint8_t> report) noexcept {
    return wait_for_device() ? table_->device->give_feature(report) : 0;
}

void PidTransport::close() noexcept {
    if (path_.empty()) return;
    const std::lock_guard lock(table_->mutex);
    table_->is_open = false;
    path_.clear();
}

}  // namespace kerf::test
