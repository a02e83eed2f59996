// SPDX-License-Identifier: Apache-2.0
// The driver over real sockets: a program of the test is the device.
#include "devices/udp/udp_device.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/udp/datagram.h"
#include "tests/support/temporary_folder.h"

namespace kerf::udp {
namespace {

using namespace std::chrono_literals;

/// A program that drives a device.
class Program {
public:
    explicit Program(std::uint16_t port, std::optional<Key> key = {})
        : key_(key), fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
        to_.sin_family = AF_INET;
        to_.sin_port = htons(port);
        to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    }
    ~Program() { close(fd_); }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(const Content& content) { send({.session = session, .sequence = ++sequence}, content); }
    void send(const Header& header, const Content& content) {
        Bytes bytes{};
        send_bytes({bytes.data(), encode({.header = header, .content = content}, key_ ? &*key_ : nullptr, bytes)});
    }
    void send_bytes(std::span<const std::uint8_t> bytes) const {
        static_cast<void>(
            sendto(fd_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to_), sizeof to_));
    }
    /// Returns the next datagram of Kerf; nothing if none comes within a second.
    std::optional<Datagram> receive() {
        std::array<std::uint8_t, 512> bytes{};
        for (int i = 0; i < 1000; ++i) {
            const ssize_t size = recv(fd_, bytes.data(), bytes.size(), 0);
            DatagramFault fault{};
            if (size > 0) return decode({bytes.data(), static_cast<std::size_t>(size)}, key_ ? &*key_ : nullptr, fault);
            std::this_thread::sleep_for(1ms);
        }
        return std::nullopt;
    }
    /// Sends `content` until a datagram comes. Returns it.
    std::optional<Datagram> send_until_answered(const Content& content) {
        for (int i = 0; i < 5; ++i) {
            send(content);
            if (auto answer = receive()) return answer;
        }
        return std::nullopt;
    }
    /// Sends hello. Returns whether Kerf has taken the device.
    bool connect() {
        session = 0;
        kerf_device_facts facts{};
        facts.abilities = KERF_DEVICE_POSITION | KERF_DEVICE_FORCE;
        facts.button_count = 1;
        facts.peak_force = 8.0;
        facts.continuous_force = 2.0;
        facts.largest_stiffness = 800.0;
        facts.mass = 0.1;
        facts.resolution = 1e-5;
        const auto answer = send_until_answered(Hello{.name = "test rig", .facts = facts});
        if (!answer || !std::holds_alternative<Welcome>(answer->content)) return false;
        session = answer->header.session;
        return session != 0;
    }
    std::uint64_t session = 0, sequence = 0;

private:
    std::optional<Key> key_;
    int fd_;
    sockaddr_in to_{};
};

/// Returns a port that is free at present.
std::uint16_t free_port() {
    const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof any;
    EXPECT_EQ(bind(fd, reinterpret_cast<sockaddr*>(&any), size), 0);
    EXPECT_EQ(getsockname(fd, reinterpret_cast<sockaddr*>(&any), &size), 0);
    close(fd);
    return ntohs(any.sin_port);
}

using Settings = std::vector<std::pair<std::string, std::string>>;

/// Opens the driver. Throws what the driver throws.
std::unique_ptr<DeviceLink> open(std::uint16_t port, const Settings& settings = {}, double wait = 10.0,
                                 const char* id = "") {
    std::vector<kerf_device_setting> texts;
    for (const auto& [key, value] : settings) texts.push_back({key.c_str(), value.c_str()});
    kerf_device_open_in in{};
    in.id = id;
    in.settings = texts.data();
    in.setting_count = static_cast<std::uint32_t>(texts.size());
    return Udp{.port = static_cast<double>(port), .wait = wait}.open(DeviceRequest(in, nullptr, nullptr));
}

/// Returns why the driver cannot be opened.
std::string refusal_of(std::uint16_t port, const Settings& settings, double wait = 0.05) {
    try {
        static_cast<void>(open(port, settings, wait));
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return {};
}

struct Connected {
    std::uint16_t port = free_port();
    Program program{port};
    std::unique_ptr<DeviceLink> link;

    Connected() {
        auto opening = std::async(std::launch::async, [this] { return open(port); });
        EXPECT_TRUE(program.connect());
        link = opening.get();
    }
};

PoseReport pose_at(double x, std::uint32_t buttons = 0) {
    return {.device_from_handle = {{x, 0, 0}, {1, 0, 0, 0}}, .buttons = buttons};
}

/// Returns whether a state comes that fulfils a condition within a second.
bool comes(DeviceLink& link, const std::function<bool(const kerf_device_state&)>& is_wanted) {
    for (int i = 0; i < 1000; ++i) {
        if (is_wanted(link.read())) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

/// Returns the command of a tick with this force along x [N].
kerf_device_command command_with(double force) {
    kerf_device_command command{};
    command.force = {force, 0.0, 0.0};
    command.device_from_tool.rotation.w = 1.0;
    return command;
}

TEST(UdpDevice, ExchangesPosesAndForces) {
    Connected rig;
    EXPECT_STREQ(rig.link->facts().name, "test rig");
    EXPECT_EQ(rig.link->read().flags, 0u) << "no pose has come";

    kerf_device_command command{};
    command.tick = 12;
    command.force = {1.0, -2.0, 3.0};
    command.device_from_tool.rotation.w = 1.0;
    command.flags = KERF_DEVICE_RUNNING;
    rig.link->write(command);
    const auto answer = rig.program.send_until_answered(pose_at(0.25, 1));
    ASSERT_TRUE(answer && std::holds_alternative<ForceCommand>(answer->content));
    const auto& force = std::get<ForceCommand>(answer->content);
    EXPECT_EQ(force.answered, rig.program.sequence);
    EXPECT_EQ(force.command.tick, 12u);
    EXPECT_EQ(force.command.force.y, -2.0);

    const kerf_device_state state = rig.link->read();
    EXPECT_EQ(state.flags, std::uint32_t{KERF_DEVICE_VALID});
    EXPECT_EQ(state.device_from_handle.position.x, 0.25);
    EXPECT_EQ(state.buttons, 1u);
    std::this_thread::sleep_for(30ms);
    EXPECT_GE(rig.link->read().age, 30e-3) << "the device is silent";
}

TEST(UdpDevice, ReportsNothingThatTheDeviceDoesNotState) {
    Connected rig;  // without rotation, with one button
    PoseReport turned = pose_at(0.25, 0xff);
    turned.device_from_handle.rotation = {0.6, 0.8, 0.0, 0.0};
    ASSERT_TRUE(rig.program.send_until_answered(turned));
    const kerf_device_state state = rig.link->read();
    EXPECT_EQ(state.device_from_handle.rotation.w, 1.0);
    EXPECT_EQ(state.device_from_handle.rotation.x, 0.0);
    EXPECT_EQ(state.buttons, 1u);
}

TEST(UdpDevice, SendsNoForceThatTheLoopHasNotRenewed) {
    Connected rig;
    rig.link->write(command_with(5.0));
    std::this_thread::sleep_for(60ms);
    const auto answer = rig.program.send_until_answered(pose_at(0.1));
    ASSERT_TRUE(answer && std::holds_alternative<ForceCommand>(answer->content));
    EXPECT_EQ(std::get<ForceCommand>(answer->content).command.force.x, 0.0) << "the loop is silent";
}

TEST(UdpDevice, IgnoresStrangersAndWhatItHasSeen) {
    Connected rig;
    ASSERT_TRUE(rig.program.send_until_answered(pose_at(0.1)));
    const std::uint64_t session = rig.program.session, sequence = rig.program.sequence;
    rig.program.send({.session = session, .sequence = sequence}, pose_at(0.2));      // seen before
    rig.program.send({.session = session, .sequence = sequence - 1}, pose_at(0.3));  // late
    rig.program.send({.session = session + 1, .sequence = 1000}, pose_at(0.4));      // of another session
    Program stranger(rig.port);
    stranger.send({.session = session, .sequence = 1000}, pose_at(0.5));  // from another port
    const std::uint8_t garbage[] = {'K', 'E', 'R', 'F', 1, 3, 88, 0, 7};
    for (int i = 0; i < 100; ++i) rig.program.send_bytes(garbage);
    rig.program.send_bytes(std::vector<std::uint8_t>(2000, 0xff));
    ASSERT_TRUE(rig.program.send_until_answered(pose_at(0.6)));
    const kerf_device_state state = rig.link->read();
    EXPECT_EQ(state.device_from_handle.position.x, 0.6);
    EXPECT_EQ(state.reports, 2u) << "two poses were the device's";
}

TEST(UdpDevice, TakesTheDeviceAgainAfterItLeft) {
    Connected rig;
    ASSERT_TRUE(rig.program.send_until_answered(pose_at(0.1)));
    rig.program.send(Goodbye{});
    EXPECT_TRUE(comes(*rig.link, [](const kerf_device_state& s) { return s.flags == 0; }));
    std::this_thread::sleep_for(50ms);
    Program again(rig.port);
    ASSERT_TRUE(again.connect());
    EXPECT_NE(again.session, rig.program.session);
    ASSERT_TRUE(again.send_until_answered(pose_at(0.7)));
    EXPECT_EQ(rig.link->read().device_from_handle.position.x, 0.7);
}

TEST(UdpDevice, SendsZeroForceAndGoodbyeWhenItIsClosed) {
    Connected rig;
    rig.link->write(command_with(5.0));
    ASSERT_TRUE(rig.program.send_until_answered(pose_at(0.1)));
    rig.link.reset();
    std::optional<double> last_force;
    bool has_left = false;
    while (!has_left) {
        const auto datagram = rig.program.receive();
        ASSERT_TRUE(datagram);
        if (const auto* force = std::get_if<ForceCommand>(&datagram->content)) last_force = force->command.force.x;
        has_left = std::holds_alternative<Goodbye>(datagram->content);
    }
    EXPECT_EQ(last_force, 0.0);
}

TEST(UdpDevice, WithAKeyTakesOnlyItsHolder) {
    const test::TemporaryFolder folder;
    const std::string file = folder.path() + "/key";
    std::ofstream(file) << "000102030405060708090a0b0c0d0e0f\n";
    Key key{};
    for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::uint8_t>(i);
    const std::uint16_t port = free_port();
    auto opening = std::async(std::launch::async, [&] { return open(port, {{"key_file", file}}); });
    Program keyless(port), holder(port, key);
    kerf_device_facts facts{};
    keyless.send(Hello{.name = "keyless", .facts = facts});
    EXPECT_TRUE(holder.connect());
    const auto link = opening.get();
    EXPECT_STREQ(link->facts().name, "test rig");
    ASSERT_TRUE(holder.send_until_answered(pose_at(0.3)));
    keyless.send({.session = holder.session, .sequence = 1000}, pose_at(0.9));
    ASSERT_TRUE(holder.send_until_answered(pose_at(0.4)));
    EXPECT_EQ(link->read().device_from_handle.position.x, 0.4);
}

TEST(UdpDevice, TakesThePortOfItsId) {
    const std::uint16_t port = free_port();
    const std::string id = "port-" + std::to_string(port);
    Program program(port);
    auto opening = std::async(std::launch::async, [&] { return open(4190, {}, 10.0, id.c_str()); });
    EXPECT_TRUE(program.connect());
    EXPECT_NE(opening.get(), nullptr);
    for (const char* wrong : {"port-", "port-80", "port-99999", "port-4190x", "4190", "p"})
        EXPECT_THROW(static_cast<void>(open(4190, {}, 0.05, wrong)), std::runtime_error) << wrong;
}

TEST(UdpDevice, GivesTheReasonIfItCannotBeOpened) {
    const std::uint16_t port = free_port();
    EXPECT_NE(refusal_of(port, {}).find("no device said hello on UDP port " + std::to_string(port)), std::string::npos);
    EXPECT_NE(refusal_of(port, {{"peer", "192.168.1.7"}}).find("`key_file`"), std::string::npos);
    const test::TemporaryFolder folder;
    std::ofstream(folder.path() + "/key") << "secret\n";
    EXPECT_NE(refusal_of(port, {{"key_file", folder.path() + "/key"}}).find("32 hexadecimal digits"),
              std::string::npos);
    EXPECT_NE(refusal_of(port, {{"key_file", folder.path() + "/none"}}).find("cannot be read"), std::string::npos);
    std::ofstream(folder.path() + "/good") << "000102030405060708090a0b0c0d0e0f\n";
    EXPECT_NE(refusal_of(port, {{"key_file", folder.path() + "/good"}, {"peer", "lab-pc"}}).find("IPv4"),
              std::string::npos);

    Connected other;
    EXPECT_NE(refusal_of(other.port, {}).find("cannot be opened"), std::string::npos);
    const auto found = Udp{.port = static_cast<double>(other.port), .wait = 1.0}.find();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found.front().problem.find("Another Kerf may use it"), std::string::npos);
}

}  // namespace
}  // namespace kerf::udp
