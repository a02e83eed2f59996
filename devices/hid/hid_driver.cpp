// SPDX-License-Identifier: Apache-2.0
#include "devices/hid/hid_driver.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "devices/hid/hid_reader.h"
#include "devices/realtime/raised_thread.h"
#include "kerf/device_exchange.hpp"

namespace kerf::hid {

namespace {

constexpr auto lost_wait = std::chrono::milliseconds(20);  // between two checks of a lost device

/// Reads a device on its own thread. Takes no force.
class HidLink final : public DeviceLink {
public:
    HidLink(std::unique_ptr<HidReader> reader, const kerf_device_facts& facts)
        : reader_(std::move(reader)), facts_(facts), exchange_(reader_->state()) {
        thread_ = std::thread([this] { read_all(); });
    }
    ~HidLink() override {
        is_ending_.store(true, std::memory_order_relaxed);
        thread_.join();
    }

    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return exchange_.read(); }
    void write(const kerf_device_command& /*command*/) noexcept override {}

private:
    void read_all() noexcept {
        raise_device_thread();
        double time = device_time();
        while (!is_ending_.load(std::memory_order_relaxed)) {
            const std::uint64_t reports = reader_->state().reports;
            const bool has_changed = reader_->step(device_time());
            if (reader_->state().reports != reports) time = device_time();
            if (has_changed) exchange_.put(reader_->state(), time);
            if (!reader_->is_open()) std::this_thread::sleep_for(lost_wait);
        }
    }

    std::unique_ptr<HidReader> reader_;
    kerf_device_facts facts_;
    DeviceExchange exchange_;
    std::atomic<bool> is_ending_{false};
    std::thread thread_;
};

std::string name_of(const HidModel& model, const HidEntry& entry) {
    return entry.name.empty() ? std::string(model.name) : entry.name;
}

}  // namespace

std::vector<DeviceFound> find_devices(const HidModel& model, HidTransport* transport) {
    if (transport == nullptr) return {{.id = "any", .name = model.name, .problem = lacks_hidapi}};
    std::vector<DeviceFound> found;
    for (const HidDevice& device : devices_of(model, transport->enumerate())) {
        found.push_back({.id = device.id,
                         .name = name_of(model, device.entry) + ", " + device.entry.path,
                         .problem = transport->open(device.entry.path)});
        transport->close();
    }
    return found;
}

std::unique_ptr<DeviceLink> open_device(const HidModel& model, std::unique_ptr<HidTransport> transport,
                                        const DeviceRequest& request) {
    if (transport == nullptr) throw std::runtime_error(lacks_hidapi);
    const std::vector<HidDevice> devices = devices_of(model, transport->enumerate());
    if (devices.empty())
        throw std::runtime_error(std::string("no ") + model.name +
                                 " is connected. Plug one in; `kerf devices doctor` lists the nodes of all devices.");
    const std::string id = request.id();
    const auto device =
        std::find_if(devices.begin(), devices.end(), [&](const HidDevice& one) { return id.empty() || one.id == id; });
    if (device == devices.end())
        throw std::runtime_error(std::string("no ") + model.name + " with the id `" + id +
                                 "` is connected; there is `" + devices.front().id + "`. `kerf devices` lists all.");
    auto reader = std::make_unique<HidReader>(std::move(transport), model, *device);
    if (const std::string refusal = reader->open(); !refusal.empty()) throw std::runtime_error(refusal);
    kerf_device_facts facts = model.facts(device->entry);
    detail::copy_text(facts.name, name_of(model, device->entry));
    return std::make_unique<HidLink>(std::move(reader), facts);
}

}  // namespace kerf::hid
