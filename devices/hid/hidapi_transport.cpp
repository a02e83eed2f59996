// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <hidapi.h>
#include <linux/hidraw.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "devices/hid/hid_nodes.h"
#include "devices/hid/hid_transport.h"

namespace kerf::hid {

namespace {

/// Returns a text as UTF-8; "" for null.
std::string utf8(const wchar_t* text) {
    std::string out;
    for (; text != nullptr && *text != L'\0'; ++text) {
        const auto c = static_cast<char32_t>(*text);
        if (c < 0x80) {
            out += static_cast<char>(c);
        } else if (c < 0x800) {
            out += static_cast<char>(0xc0u | c >> 6);
            out += static_cast<char>(0x80u | (c & 0x3fu));
        } else if (c > 0xffff) {
            out += '?';
        } else {
            out += static_cast<char>(0xe0u | (c >> 12 & 0x0fu));
            out += static_cast<char>(0x80u | (c >> 6 & 0x3fu));
            out += static_cast<char>(0x80u | (c & 0x3fu));
        }
    }
    return out;
}

/// A descriptor of a node, with an advisory lock: a second Kerf does not take the same device.
class LockedNode {
public:
    ~LockedNode() { close(); }
    LockedNode() = default;
    LockedNode(const LockedNode&) = delete;
    LockedNode& operator=(const LockedNode&) = delete;

    /// Returns the reason if it cannot. hidapi 0.13 gives none, and reads freed memory of a node that is no hidraw.
    [[nodiscard]] std::string open(const std::string& path) {
        close();
        fd_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
        if (fd_ < 0) return refusal_of_node(path, errno);
        int size = 0;
        if (ioctl(fd_, HIDIOCGRDESCSIZE, &size) < 0) return closed(path + " is no HID device.");
        if (flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return {};
        return closed(path + " is in use by another program. End the other Kerf.");
    }
    void close() noexcept {
        if (fd_ >= 0) ::close(fd_);
        fd_ = -1;
    }

    [[nodiscard]] bool write(std::span<const std::uint8_t> report) const noexcept {
        for (;;) {
            const ssize_t size = ::write(fd_, report.data(), report.size());
            if (size < 0 && errno == EINTR) continue;
            return size == static_cast<ssize_t>(report.size());
        }
    }
    /// Returns the size that the kernel returns; below 0: it cannot.
    [[nodiscard]] int send_feature(std::span<const std::uint8_t> report) const noexcept {
        return ioctl(fd_, HIDIOCSFEATURE(report.size()), report.data());
    }
    [[nodiscard]] int get_feature(std::span<std::uint8_t> report) const noexcept {
        return ioctl(fd_, HIDIOCGFEATURE(report.size()), report.data());
    }

private:
    std::string closed(std::string reason) noexcept {
        close();
        return reason;
    }
    int fd_ = -1;
};

/// hidapi frees its last error in each of these calls, without a lock, and every driver has a thread of its own.
/// Plugins have no variable in common, so the lock is on the folder of the nodes.
class OneCallAtATime {
public:
    OneCallAtATime() : fd_(::open("/sys/class/hidraw", O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        if (fd_ >= 0) flock(fd_, LOCK_EX);
    }
    ~OneCallAtATime() {
        if (fd_ >= 0) ::close(fd_);
    }
    OneCallAtATime(const OneCallAtATime&) = delete;
    OneCallAtATime& operator=(const OneCallAtATime&) = delete;

private:
    int fd_;
};

class HidapiTransport final : public HidTransport {
public:
    ~HidapiTransport() override { HidapiTransport::close(); }

    std::vector<HidEntry> enumerate() override {
        const OneCallAtATime alone;
        std::vector<HidEntry> entries;
        hid_device_info* const all = hid_enumerate(0, 0);
        for (const hid_device_info* one = all; one != nullptr; one = one->next)
            entries.push_back({.path = one->path != nullptr ? one->path : "",
                               .vendor = one->vendor_id,
                               .product = one->product_id,
                               .usage_page = one->usage_page,
                               .usage = one->usage,
                               .serial = utf8(one->serial_number),
                               .name = utf8(one->product_string)});
        hid_free_enumeration(all);
        return entries;
    }
    std::string open(const std::string& path) override {
        close();
        if (std::string refusal = node_.open(path); !refusal.empty()) return refusal;
        const OneCallAtATime alone;
        device_ = hid_open_path(path.c_str());
        if (device_ != nullptr) return {};
        node_.close();
        return path + " cannot be opened by hidapi. Plug the device in again.";
    }
    HidRead read(std::span<std::uint8_t> bytes, int timeout_ms) noexcept override {
        if (device_ == nullptr) return {.status = HidRead::Status::lost};
        errno = 0;
        const int size = hid_read_timeout(device_, bytes.data(), bytes.size(), timeout_ms);
        if (size > 0) return {.status = HidRead::Status::report, .size = static_cast<std::size_t>(size)};
        // hidapi also returns -1 when a signal has interrupted the wait.
        if (size == 0 || errno == EINTR) return {};
        return {.status = HidRead::Status::lost};
    }
    /// hidapi 0.13 has no function for it.
    std::vector<std::uint8_t> descriptor(const std::string& path) override {
        const std::string name = path.substr(path.rfind('/') + 1);
        std::ifstream in("/sys/class/hidraw/" + name + "/device/report_descriptor", std::ios::binary);
        const std::vector<char> bytes(std::istreambuf_iterator<char>(in), {});
        return {bytes.begin(), bytes.end()};
    }
    // hidapi keeps one error text for all calls on a device, without a lock, and its reads may run in another thread.
    // So these use the node itself, as hidapi does inside.
    bool send(std::span<const std::uint8_t> report) noexcept override { return node_.write(report); }
    bool send_feature(std::span<const std::uint8_t> report) noexcept override {
        return node_.send_feature(report) >= 0;
    }
    std::size_t get_feature(std::span<std::uint8_t> report) noexcept override {
        return static_cast<std::size_t>(std::max(node_.get_feature(report), 0));
    }
    void close() noexcept override {
        if (device_ != nullptr) hid_close(device_);
        device_ = nullptr;
        node_.close();
    }

private:
    hid_device* device_ = nullptr;
    LockedNode node_;
};

}  // namespace

// hid_exit() is never called: another driver in this process may still use the library.
std::unique_ptr<HidTransport> make_hidapi_transport() { return std::make_unique<HidapiTransport>(); }
std::string hidapi_version() { return hid_version_str(); }

}  // namespace kerf::hid
