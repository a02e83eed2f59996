// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace kerf::hid {

/// A HID device that the system lists.
struct HidEntry {
    std::string path;  ///< of its node: "/dev/hidraw3"
    std::uint16_t vendor = 0, product = 0;
    std::uint16_t usage_page = 0, usage = 0;  ///< of its first collection
    std::string serial{}, name{};             ///< may be empty
};

/// The result of a read.
struct HidRead {
    enum class Status : std::uint8_t { report, nothing, lost };
    Status status = Status::nothing;
    std::size_t size = 0;  ///< [bytes] of the report
};

/// Access to the HID devices of the system, at most one of them open. One thread calls all functions, but another one
/// may read while it sends.
class HidTransport {
public:
    HidTransport() = default;
    virtual ~HidTransport() = default;
    HidTransport(const HidTransport&) = delete;
    HidTransport& operator=(const HidTransport&) = delete;

    /// Returns the devices that are connected now. A path may be there several times. May take 0.3 s.
    [[nodiscard]] virtual std::vector<HidEntry> enumerate() = 0;
    /// Opens the device at a path. Returns the reason if it cannot, and what to do; empty on success.
    [[nodiscard]] virtual std::string open(const std::string& path) = 0;
    /// Waits for a report of the open device, cut to the size of `bytes`.
    [[nodiscard]] virtual HidRead read(std::span<std::uint8_t> bytes, int timeout_ms) noexcept = 0;
    /// Returns the report descriptor of the device at a path, which need not be open; empty if it has none.
    [[nodiscard]] virtual std::vector<std::uint8_t> descriptor(const std::string& /*path*/) { return {}; }
    /// Sends an output report, whose first byte is its id. May block for seconds. Returns whether the device took it.
    [[nodiscard]] virtual bool send(std::span<const std::uint8_t> /*report*/) noexcept { return false; }
    /// Sends a feature report, whose first byte is its id. May block for seconds. Returns whether the device took it.
    [[nodiscard]] virtual bool send_feature(std::span<const std::uint8_t> /*report*/) noexcept { return false; }
    /// Reads the feature report whose id is the first byte. May block for seconds. Returns its size; 0 if it cannot.
    [[nodiscard]] virtual std::size_t get_feature(std::span<std::uint8_t> /*report*/) noexcept { return 0; }
    /// Closes the open device, if there is one.
    virtual void close() noexcept = 0;
};

/// Returns the transport over hidapi, or null if this build lacks hidapi.   [any]
[[nodiscard]] std::unique_ptr<HidTransport> make_hidapi_transport();
/// Returns the version of hidapi; empty if this build lacks hidapi.   [any]
[[nodiscard]] std::string hidapi_version();
/// The message of a build without hidapi, and what to do.
inline constexpr const char* lacks_hidapi =
    "this build of Kerf lacks hidapi. Install the package `libhidapi-dev`, configure and build Kerf again.";

}  // namespace kerf::hid
