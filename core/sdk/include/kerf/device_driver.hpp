// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "kerf/device.h"
#include "kerf/plugin.hpp"

/// Drivers of haptic devices as plain structs, for KERF_PLUGIN. Draft: it may change in any version.
///
///     struct Stylus {
///         double rate;                                       // members are parameters
///         static constexpr auto about();
///         std::vector<DeviceFound> find() const;             // may allocate and throw
///         std::unique_ptr<DeviceLink> open(const DeviceRequest&) const;   // may wait, allocate and throw
///     };
///
/// An exception that leaves `open` refuses the device, with its text as the reason.
namespace kerf {

/// An open device. Its destructor sends a zero force and frees all.
class DeviceLink {
public:
    virtual ~DeviceLink() = default;
    [[nodiscard]] virtual kerf_device_facts facts() const = 0;
    /// Returns the newest report.   [haptic, nonblocking]
    [[nodiscard]] virtual kerf_device_state read() noexcept = 0;
    /// Takes the force of a tick.   [haptic, nonblocking]
    virtual void write(const kerf_device_command& command) noexcept = 0;
    /// Returns why the device is lost or makes no force now, and what to do; empty if nothing is wrong.   [main]
    [[nodiscard]] virtual std::string problem() { return {}; }
};

struct DeviceFound {
    std::string id, name, problem;
};

/// Which device to open, with the station's settings. A view of the call.
class DeviceRequest {
public:
    DeviceRequest(const kerf_device_open_in& in, std::int32_t (*should_end)(void*), void* context) noexcept
        : in_(&in), should_end_(should_end), context_(context) {}

    /// Returns the id of the device; empty: any.
    [[nodiscard]] std::string id() const { return in_->id; }
    /// Returns a setting; empty if the station has none of this name.
    [[nodiscard]] std::string setting(std::string_view key) const {
        for (std::uint32_t i = 0; i < in_->setting_count; ++i)
            if (key == in_->settings[i].key) return in_->settings[i].value;
        return {};
    }
    /// Throws std::runtime_error, with the known ones, if the station has a setting that is neither a parameter of the
    /// driver nor among `known`.
    void require_known_settings(std::initializer_list<std::string_view> known) const {
        for (std::uint32_t i = 0; i < in_->setting_count; ++i) {
            const std::string_view key = in_->settings[i].key;
            if (std::find(known.begin(), known.end(), key) != known.end()) continue;
            std::string text = "the station has the setting `" + std::string(key.substr(0, 40)) +
                               "`, which the driver does not have. Known are its parameters";
            for (const std::string_view name : known) text += ", `" + std::string(name) + "`";
            throw std::runtime_error(text + ". Correct or remove it.");
        }
    }
    /// Returns whether the user no longer waits: then throw soon.
    [[nodiscard]] bool is_cancelled() const { return should_end_ != nullptr && should_end_(context_) != 0; }

private:
    const kerf_device_open_in* in_;
    std::int32_t (*should_end_)(void*);
    void* context_;
};

template <class T>
concept DeviceComponent = requires(const T& driver, const DeviceRequest& request) {
    T::about();
    { driver.find() } -> std::same_as<std::vector<DeviceFound>>;
    { driver.open(request) } -> std::same_as<std::unique_ptr<DeviceLink>>;
};

namespace detail {

/// Copies a text, cut to the size of its array between two characters.
template <std::size_t size>
void copy_text(char (&to)[size], std::string_view from) noexcept {
    std::size_t count = std::min(from.size(), size - 1);
    while (count < from.size() && count > 0 && (static_cast<unsigned char>(from[count]) & 0xc0u) == 0x80u) --count;
    std::memcpy(to, from.data(), count);
    to[count] = '\0';
}

template <DeviceComponent Driver>
struct ComponentTable<Driver> {
    static std::span<const double> values(const double* params) noexcept {
        return {params, Tables<Driver>::params.size()};
    }
    static std::uint32_t find(const double* params, kerf_device_found* found, std::uint32_t capacity) noexcept {
        try {
            std::uint32_t count = 0;
            for (const DeviceFound& device : value_of<Driver>(values(params)).find()) {
                if (count == capacity) break;
                kerf_device_found& out = found[count++];
                copy_text(out.id, device.id);
                copy_text(out.name, device.name);
                copy_text(out.problem, device.problem);
            }
            return count;
        } catch (...) {
            return 0;
        }
    }
    static kerf_status open(const kerf_device_open_in* in, std::int32_t (*is_cancelled)(void*), void* context,
                            kerf_device_open_out* out) noexcept {
        *out = {};
        try {
            auto link = value_of<Driver>(values(in->params)).open(DeviceRequest(*in, is_cancelled, context));
            if (link == nullptr) throw std::runtime_error("the driver gave no device");
            out->facts = link->facts();
            out->device = link.release();
            return KERF_OK;
        } catch (const std::exception& e) {
            copy_text(out->message, e.what());
        } catch (...) {
            copy_text(out->message, "it threw an object that is not a std::exception");
        }
        return KERF_FAILED;
    }
    static void read(void* device, kerf_device_state* state) noexcept {
        *state = static_cast<DeviceLink*>(device)->read();
    }
    static void write(void* device, const kerf_device_command* command) noexcept {
        static_cast<DeviceLink*>(device)->write(*command);
    }
    static void close(void* device) noexcept { delete static_cast<DeviceLink*>(device); }
    static void problem(void* device, char text[240]) noexcept {
        char(&to)[240] = *reinterpret_cast<char(*)[240]>(text);
        try {
            copy_text(to, static_cast<DeviceLink*>(device)->problem());
        } catch (...) {
            copy_text(to, "");
        }
    }

    static constexpr std::uint32_t kind = KERF_KIND_DEVICE, version = KERF_DEVICE_VERSION;
    static constexpr kerf_device table{.size = sizeof(kerf_device),
                                       .reserved = 0,
                                       .layout = KERF_DEVICE_LAYOUT_INIT,
                                       .find = &find,
                                       .open = &open,
                                       .read = &read,
                                       .write = &write,
                                       .close = &close,
                                       .problem = &problem};
    static constexpr void put_into(kerf_component& component) noexcept { component.device = &table; }
};

}  // namespace detail

}  // namespace kerf
