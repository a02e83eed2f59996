// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "devices/hid/hid_transport.h"

namespace kerf::test {

using ReportBytes = std::vector<std::uint8_t>;

/// A system with HID devices that a test plugs in and out, on a virtual clock: only waiting takes time.
struct HidTable {
    double now = 0.0;  ///< [s]
    std::vector<hid::HidEntry> entries;
    std::string refusal;  ///< of each `open`
    std::deque<ReportBytes> queue;
    int searches = 0;

    void plug_in(const hid::HidEntry& entry) { entries.push_back(entry); }
    void unplug() {
        entries.clear();
        queue.clear();
    }
};

/// Pre: the table outlives it.
class ScriptedTransport final : public hid::HidTransport {
public:
    explicit ScriptedTransport(HidTable& table) : table_(&table) {}

    std::vector<hid::HidEntry> enumerate() override {
        ++table_->searches;
        return table_->entries;
    }
    std::string open(const std::string& path) override {
        if (!table_->refusal.empty()) return table_->refusal;
        if (!is_there(path)) return path + " is not there";
        path_ = path;
        return {};
    }
    hid::HidRead read(std::span<std::uint8_t> bytes, int timeout_ms) noexcept override {
        using Status = hid::HidRead::Status;
        if (!is_there(path_)) return {.status = Status::lost};
        if (table_->queue.empty()) {
            table_->now += 1e-3 * timeout_ms;
            return {};
        }
        const ReportBytes report = std::move(table_->queue.front());
        table_->queue.pop_front();
        const std::size_t size = std::min(report.size(), bytes.size());
        std::copy_n(report.begin(), size, bytes.begin());
        return {.status = Status::report, .size = size};
    }
    void close() noexcept override { path_.clear(); }

private:
    [[nodiscard]] bool is_there(const std::string& path) const noexcept {
        return std::any_of(table_->entries.begin(), table_->entries.end(),
                           [&](const hid::HidEntry& entry) { return entry.path == path; });
    }
    HidTable* table_;
    std::string path_;
};

/// A SpaceNavigator, as the system lists it.
inline hid::HidEntry space_navigator(const std::string& path, const std::string& serial = "") {
    return {.path = path,
            .vendor = 0x046d,
            .product = 0xc626,
            .usage_page = 0x01,
            .usage = 0x08,
            .serial = serial,
            .name = "SpaceNavigator"};
}

}  // namespace kerf::test
