// SPDX-License-Identifier: Apache-2.0
#include "udp_device.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "datagram.h"
#include "devices/realtime/raised_thread.h"
#include "kerf/device_buttons.hpp"
#include "kerf/device_exchange.hpp"

namespace kerf::udp {

namespace {

constexpr int poll_ms = 5;  // maximum wait before it checks for the end of the run
constexpr std::uint32_t period_us = 1000, watchdog_ms = 20;
static_assert(1e-3 * watchdog_ms == DeviceExchange::silence);
constexpr const char* guide = "docs/guide/devices.md";

/// A socket of this process; closed with this object.
class Socket {
public:
    /// Throws std::runtime_error if the port cannot be had.
    Socket(std::uint16_t port, bool is_open_to_others)
        : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
        sockaddr_in here{};
        here.sin_family = AF_INET;
        here.sin_port = htons(port);
        here.sin_addr.s_addr = htonl(is_open_to_others ? INADDR_ANY : INADDR_LOOPBACK);
        if (fd_ >= 0 && bind(fd_, reinterpret_cast<const sockaddr*>(&here), sizeof here) == 0) return;
        const int error = errno;
        if (fd_ >= 0) close(fd_);
        throw std::runtime_error("UDP port " + std::to_string(port) + " cannot be opened (" + std::strerror(error) +
                                 "). Another Kerf may use it: end it, or write another port, as in `udp/port-5000`.");
    }
    ~Socket() { close(fd_); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    /// Waits until a datagram may have come.
    void wait(int milliseconds) const noexcept {
        pollfd one{fd_, POLLIN, 0};
        static_cast<void>(poll(&one, 1, milliseconds));
    }
    /// Returns the size of the next datagram, which is cut to the size of `bytes`; nothing if there is none.
    [[nodiscard]] std::optional<std::size_t> receive(std::span<std::uint8_t> bytes, sockaddr_in& from) const noexcept {
        for (;;) {
            socklen_t size = sizeof from;
            const ssize_t got = recvfrom(fd_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
            if (got >= 0) return static_cast<std::size_t>(got);
            if (errno == ECONNREFUSED || errno == EINTR)
                continue;  // of an earlier datagram to a program that has ended
            return std::nullopt;
        }
    }
    void send(std::span<const std::uint8_t> bytes, const sockaddr_in& to) const noexcept {
        static_cast<void>(
            sendto(fd_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to));
    }

private:
    int fd_;
};

bool are_same(const sockaddr_in& a, const sockaddr_in& b) noexcept {
    return a.sin_port == b.sin_port && a.sin_addr.s_addr == b.sin_addr.s_addr;
}

/// The other end, and the sequence of its last datagram.
struct Peer {
    sockaddr_in address{};
    std::uint64_t session = 0, last_sequence = 0;
    kerf_device_facts facts{};
};

/// Which programs may connect.
struct Door {
    std::optional<in_addr_t> only;  ///< address of the one machine; nothing: this machine
    std::optional<Key> key;

    [[nodiscard]] bool admits(const sockaddr_in& from) const noexcept { return !only || from.sin_addr.s_addr == *only; }
    [[nodiscard]] const Key* key_or_null() const noexcept { return key ? &*key : nullptr; }
};

Key read_key(const std::string& file) {
    std::ifstream in(file);
    std::string digits;
    if (!(in >> digits)) throw std::runtime_error("the key file " + file + " cannot be read. Check `key_file`.");
    Key key{};
    const auto value = [&](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    bool is_key = digits.size() == 2 * key.size();
    for (std::size_t i = 0; is_key && i < digits.size(); ++i) {
        is_key = value(digits[i]) >= 0;
        key[i / 2] = static_cast<std::uint8_t>(16 * key[i / 2] + value(digits[i]));
    }
    if (!is_key)
        throw std::runtime_error("the key file " + file +
                                 " must begin with 32 hexadecimal digits. Make one with `head -c "
                                 "16 /dev/urandom | od -An -tx1 | tr -d ' \\n'`.");
    return key;
}

Door door_of(const DeviceRequest& request) {
    Door door;
    if (const std::string file = request.setting("key_file"); !file.empty()) door.key = read_key(file);
    if (const std::string peer = request.setting("peer"); !peer.empty()) {
        in_addr address{};
        if (inet_pton(AF_INET, peer.c_str(), &address) != 1)
            throw std::runtime_error("`peer` is `" + peer + "`. Write an IPv4 address, as in `peer: 192.168.1.7`.");
        if (!door.key)
            throw std::runtime_error("`peer` needs a `key_file`: anyone on the network could move the tool. Set it; " +
                                     std::string(guide) + " shows how.");
        door.only = address.s_addr;
    }
    return door;
}

constexpr std::string_view id_prefix = "port-";

/// Returns the port that the id of a device names; an empty id means `usual`. Throws if it names none.
std::uint16_t port_of(std::string_view id, std::uint16_t usual) {
    if (id.empty()) return usual;
    std::uint16_t number = 0;
    const std::string_view digits = id.substr(std::min(id.size(), id_prefix.size()));
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (!id.starts_with(id_prefix) || status != std::errc{} || end != digits.data() + digits.size() || number < 1024)
        throw std::runtime_error("its id is `" + std::string(id) +
                                 "`. Write `port-` and a number from 1024 to 65535, as in "
                                 "`udp/port-4190`.");
    return number;
}

/// Reads the datagrams of one peer and answers each pose with the newest force. Except for `read` and `write`, its
/// functions run on its own thread.
class Link final : public DeviceLink {
public:
    Link(std::uint16_t port, const Door& door) : door_(door), socket_(port, door_.only.has_value()) {}
    ~Link() override {
        is_ending_.store(true, std::memory_order_relaxed);
        if (thread_.joinable()) thread_.join();
        if (peer_.session == 0) return;
        for (int i = 0; i < 3; ++i) send(ForceCommand{.answered = peer_.last_sequence, .command = command_at_rest()});
        send(Goodbye{});
    }

    /// Waits for the first hello. Throws if none comes.
    void wait_for_device(double seconds, const DeviceRequest& request, std::uint16_t port) {
        for (const double end = device_time() + seconds; peer_.session == 0;) {
            if (request.is_cancelled()) throw std::runtime_error("interrupted before a device said hello");
            if (device_time() > end)
                throw std::runtime_error("no device said hello on UDP port " + std::to_string(port) + " within " +
                                         std::to_string(static_cast<int>(seconds)) + " s" +
                                         (refused_ != DatagramFault::none
                                              ? "; the last datagram was refused: " + std::string(text_of(refused_))
                                              : std::string()) +
                                         ". Start the device's program; " + guide + " states what it must send.");
            socket_.wait(poll_ms);
            take_all();
        }
        facts_ = peer_.facts;
        is_in_use_ = true;
        thread_ = std::thread([this] { exchange(); });
    }

    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return exchange_.read(); }
    void write(const kerf_device_command& command) noexcept override { exchange_.write(command); }

private:
    void exchange() noexcept {
        raise_device_thread();
        while (!is_ending_.load(std::memory_order_relaxed)) {
            socket_.wait(poll_ms);
            if (take_all()) send(ForceCommand{.answered = peer_.last_sequence, .command = exchange_.command()});
        }
    }

    /// Takes the datagrams that have come, at most 64, so that a flood delays no force. Returns whether a new pose was
    /// among them.
    bool take_all() noexcept {
        bool has_pose = false;
        sockaddr_in from{};
        std::array<std::uint8_t, max_size + 1> bytes;  // one more, so that a longer datagram is not one of ours
        for (int i = 0; i < 64; ++i) {
            const auto size = socket_.receive(bytes, from);
            if (!size) break;
            if (!door_.admits(from)) continue;
            const auto datagram = decode({bytes.data(), *size}, door_.key_or_null(), refused_);
            if (datagram) has_pose |= take(*datagram, from);
        }
        if (has_pose) {
            arrived_time_ = device_time();
            exchange_.put(newest_, arrived_time_);
        }
        return has_pose;
    }

    bool take(const Datagram& datagram, const sockaddr_in& from) noexcept {
        if (const auto* hello = std::get_if<Hello>(&datagram.content)) {
            welcome(*hello, datagram.header, from);
            return false;
        }
        const Header& header = datagram.header;
        if (peer_.session == 0 || header.session != peer_.session || !are_same(from, peer_.address) ||
            header.sequence <= peer_.last_sequence)
            return false;  // of a stranger, of an earlier session, late, or seen before
        if (!std::holds_alternative<Goodbye>(datagram.content) && !std::holds_alternative<PoseReport>(datagram.content))
            return false;
        peer_.last_sequence = header.sequence;
        if (std::holds_alternative<Goodbye>(datagram.content)) {
            newest_.flags = 0;
            exchange_.put(newest_, device_time());
        }
        const auto* pose = std::get_if<PoseReport>(&datagram.content);
        if (pose == nullptr) return false;
        ++newest_.reports;
        take(*pose);
        return true;
    }

    /// Takes of a pose what the device states that it has.
    void take(const PoseReport& pose) noexcept {
        const kerf_device_facts& facts = peer_.facts;
        newest_.device_from_handle = pose.device_from_handle;
        if ((facts.abilities & KERF_DEVICE_ROTATION) == 0) newest_.device_from_handle.rotation = {1.0, 0.0, 0.0, 0.0};
        newest_.buttons = pose.buttons & button_bits(facts.button_count);
        newest_.flags = KERF_DEVICE_VALID;
    }

    /// Takes the first peer, or the same device again after its program was started anew. A second one must wait until
    /// the first is silent. While the device is in use, its limits must stay the same.
    void welcome(const Hello& hello, const Header& header, const sockaddr_in& from) noexcept {
        const bool is_known = peer_.session != 0, is_silent = device_time() - arrived_time_ > 1e-3 * watchdog_ms;
        const bool is_same = is_known && are_same(from, peer_.address);
        if (is_known && !is_same && !is_silent) return;
        if (is_in_use_ && std::memcmp(&hello.facts, &facts_, sizeof facts_) != 0) return;
        if (!is_same || is_silent || header.sequence > hello_sequence_) {
            std::uint64_t session = 0;
            while (session == 0)
                if (getrandom(&session, sizeof session, 0) != sizeof session) session = 0;
            peer_ = {.address = from, .session = session, .last_sequence = 0, .facts = hello.facts};
            hello_sequence_ = header.sequence;
        }
        arrived_time_ = device_time();
        send(Welcome{period_us, watchdog_ms});
    }

    void send(const Content& content) noexcept {
        Bytes bytes;
        const std::size_t size = encode({.header = {.session = peer_.session, .sequence = ++sent_}, .content = content},
                                        door_.key_or_null(), bytes);
        socket_.send({bytes.data(), size}, peer_.address);
    }

    Door door_;
    Socket socket_;
    Peer peer_;
    kerf_device_facts facts_{};
    kerf_device_state newest_ = state_without_report();
    double arrived_time_ = 0.0;
    std::uint64_t sent_ = 0, hello_sequence_ = 0;
    bool is_in_use_ = false;  ///< the loop has its limits
    DatagramFault refused_ = DatagramFault::none;
    DeviceExchange exchange_;
    std::atomic<bool> is_ending_{false};
    std::thread thread_;
};

}  // namespace

std::vector<DeviceFound> Udp::find() const {
    DeviceFound found{.id = std::string(id_prefix) + std::to_string(static_cast<int>(port)),
                      .name = "a program that sends to UDP port " + std::to_string(static_cast<int>(port)),
                      .problem = {}};
    try {
        const Socket trial(static_cast<std::uint16_t>(port), false);
    } catch (const std::exception& e) {
        found.problem = e.what();
    }
    return {found};
}

std::unique_ptr<DeviceLink> Udp::open(const DeviceRequest& request) const {
    const std::uint16_t number = port_of(request.id(), static_cast<std::uint16_t>(port));
    auto link = std::make_unique<Link>(number, door_of(request));
    link->wait_for_device(wait, request, number);
    return link;
}

}  // namespace kerf::udp
