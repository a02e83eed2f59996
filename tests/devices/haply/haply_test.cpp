// SPDX-License-Identifier: Apache-2.0
// The driver over real sockets, against a stand-in for the maker's service.
#include "devices/haply/haply.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/devices/driver_rig.h"
#include "tests/devices/haply/mock_service.h"

namespace kerf::haply {
namespace {

using namespace std::chrono_literals;
using Settings = test::DriverSettings;
using test::comes, test::has, test::is_valid;

Haply driver_at(std::uint16_t port, std::uint16_t events_port = 1) {
    return {.port = static_cast<double>(port),
            .events_port = static_cast<double>(events_port),
            .wait = 20.0,
            .peak_force = 4.0,
            .continuous_force = 2.0,
            .stiffness = 800.0};
}

std::unique_ptr<DeviceLink> open(const Haply& driver, const Settings& settings = {}) {
    return test::open_device(driver, settings);
}
std::unique_ptr<DeviceLink> open(const MockService& service) {
    return open(driver_at(service.port(), service.events_port()));
}

std::string refusal_of(const Haply& driver, const Settings& settings = {}, const char* id = "") {
    return test::refusal_of_device(driver, settings, id);
}

bool is_lost(const kerf_device_state& state) { return !is_valid(state); }

/// A program on a port of its own that is no service: it accepts, and sends `words` if there are any.
class OtherProgram {
public:
    explicit OtherProgram(std::string words)
        : words_(std::move(words)), fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in any{};
        any.sin_family = AF_INET;
        any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof any;
        EXPECT_EQ(bind(fd_, reinterpret_cast<sockaddr*>(&any), size), 0);
        EXPECT_EQ(listen(fd_, 4), 0);
        EXPECT_EQ(getsockname(fd_, reinterpret_cast<sockaddr*>(&any), &size), 0);
        port_ = ntohs(any.sin_port);
        thread_ = std::thread([this] {
            for (int one = 0; (one = accept(fd_, nullptr, nullptr)) >= 0;) {
                if (!words_.empty()) static_cast<void>(send(one, words_.data(), words_.size(), MSG_NOSIGNAL));
                accepted_.push_back(one);
            }
        });
    }
    ~OtherProgram() {
        shutdown(fd_, SHUT_RDWR);
        thread_.join();
        close(fd_);
        for (const int one : accepted_) close(one);
    }
    OtherProgram(const OtherProgram&) = delete;
    OtherProgram& operator=(const OtherProgram&) = delete;
    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }

private:
    std::string words_;
    int fd_;
    std::uint16_t port_ = 0;
    std::vector<int> accepted_;
    std::thread thread_;
};

TEST(Haply, ExchangesPosesAndForces) {
    MockService service;
    const auto link = open(service);
    EXPECT_STREQ(link->facts().name, "Inverse3 049D");
    EXPECT_EQ(link->facts().abilities, std::uint32_t{KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE});
    EXPECT_EQ(link->facts().button_count, 3u);
    const Pose handle{{0.0123456789012345, -0.2, 0.3}, normalized(Quat{0.9, 0.1, -0.2, 0.3})};
    service.set_handle(handle, 5u);
    const Vec3 force{0.1, -1.0 / 3.0, 2.0 / 3.0};
    ASSERT_TRUE(comes(*link, force, [&](const kerf_device_state& state) {
        return state.device_from_handle.position.x == handle.position.x && service.force() == force;
    }));
    const kerf_device_state state = link->read();
    EXPECT_EQ(length(state.device_from_handle.position - handle.position), 0.0) << "to the bit";
    EXPECT_NEAR(state.device_from_handle.rotation.x, handle.rotation.x, 1e-15);
    EXPECT_NEAR(state.device_from_handle.rotation.z, handle.rotation.z, 1e-15);
    EXPECT_EQ(state.buttons, 5u);
    EXPECT_TRUE(has(service.first_message(), "\"kerf\"")) << service.first_message();
    EXPECT_EQ(link->problem(), "");
}

TEST(Haply, TakesBothWordsAndBothVersions) {
    for (const MockService::Options& options :
         {MockService::Options{.is_3_5 = true, .takes_vector = false, .takes_values = true},
          MockService::Options{.is_3_5 = false, .takes_vector = false, .takes_values = true}}) {
        MockService service(options);
        const auto link = open(service);
        EXPECT_TRUE(comes(*link, {0, 1, 0}, [&](const auto&) { return service.force() == Vec3{0, 1, 0}; }));
        EXPECT_EQ(has(service.first_message(), "basis"), options.is_3_5);
    }
    MockService of_none({.takes_vector = false, .takes_values = false});
    EXPECT_TRUE(has(refusal_of(driver_at(of_none.port())), "no force for any command"));
    MockService stated({.takes_vector = false, .takes_values = true});
    const auto link = open(driver_at(stated.port()), {{"service", "3.1"}});
    EXPECT_TRUE(comes(*link, {0, 1, 0}, [&](const auto&) { return stated.force() == Vec3{0, 1, 0}; }));
}

TEST(Haply, SendsNoForceThatTheLoopHasNotRenewed) {
    MockService service;
    const auto link = open(service);
    ASSERT_TRUE(comes(*link, {3, 0, 0}, [&](const auto&) { return service.force() == Vec3{3, 0, 0}; }));
    const std::uint64_t before = service.messages();
    for (int i = 0; i < 5000 && service.force() != Vec3{}; ++i) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(length(service.force()), 0.0) << "the loop is silent";
    for (int i = 0; i < 5000 && service.messages() < before + 100; ++i) std::this_thread::sleep_for(1ms);
    EXPECT_GE(service.messages(), before + 100) << "but the driver still sends";
}

TEST(Haply, SendsAZeroForceWhenItIsClosed) {
    MockService service;
    auto link = open(service);
    ASSERT_TRUE(comes(*link, {3, 0, 0}, [&](const auto&) { return service.force() == Vec3{3, 0, 0}; }));
    link.reset();
    EXPECT_EQ(length(service.force()), 0.0);
}

TEST(Haply, LosesAnArmAndTakesItBack) {
    using Fault = MockService::Fault;
    for (const auto& [fault, word] : {std::pair{Fault::arm_unplugged, "unplugged"},
                                      {Fault::no_number, "no position"},
                                      {Fault::not_json, "none of Haply's"}}) {
        MockService service;
        const auto link = open(service);
        ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
        service.set_fault(fault);
        ASSERT_TRUE(comes(*link, {1, 0, 0}, is_lost)) << word;
        EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return has(link->problem(), word); }))
            << link->problem();
        EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return service.force() == Vec3{}; })) << word;
        service.set_fault(Fault::none);
        EXPECT_TRUE(comes(*link, {1, 0, 0}, is_valid)) << word;
        EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return link->problem().empty(); })) << link->problem();
    }
}

TEST(Haply, IsSilentWhileTheServiceIs) {
    using Fault = MockService::Fault;
    for (const Fault fault : {Fault::no_answers, Fault::half_a_message, Fault::too_long}) {
        MockService service;
        const auto link = open(service);
        ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
        service.set_fault(fault);
        EXPECT_TRUE(comes(*link, {1, 0, 0}, [](const auto& state) { return is_lost(state) || state.age > 20e-3; }))
            << "the host then counts it as lost";
        service.set_fault(Fault::none);
        EXPECT_TRUE(comes(*link, {1, 0, 0}, [](const auto& state) { return is_valid(state) && state.age < 20e-3; }))
            << static_cast<int>(fault);
    }
}

TEST(Haply, ConnectsAgainToAServiceThatWasRestarted) {
    auto service = std::make_unique<MockService>();
    const std::uint16_t port = service->port();
    const auto link = open(*service);
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    service.reset();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_lost));
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return !link->problem().empty(); }));
    EXPECT_TRUE(has(link->problem(), "systemctl start")) << link->problem();
    service = std::make_unique<MockService>(MockService::Options{.port = port});
    EXPECT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return service->force() == Vec3{1, 0, 0}; }));
}

TEST(Haply, RefusesWithTheReason) {
    const auto refusal = [](const MockService::Options& options, const char* id = "") {
        const MockService service(options);
        return refusal_of(driver_at(service.port()), {}, id);
    };
    EXPECT_TRUE(has(refusal({.is_calibrated = false}), "inkwell"));
    EXPECT_TRUE(has(refusal({.is_in_use = true}), "another program drives the arm"));
    EXPECT_TRUE(has(refusal({.has_arm = false}), "no Inverse3"));
    EXPECT_TRUE(has(refusal({}, "0000"), "there is `049D`"));
    EXPECT_EQ(refusal({.has_grip = false}), "") << "without a grip the tool keeps its direction";
    const MockService service;
    EXPECT_TRUE(has(refusal_of(driver_at(service.port()), {{"service", "9"}}), "3.1 or 3.5"));
    EXPECT_TRUE(has(refusal_of(driver_at(service.port()), {{"prot", "9"}}), "`prot`"));
}

TEST(Haply, RefusesAPortWithoutAService) {
    const std::uint16_t closed = OtherProgram("").port();
    const std::string refusal = refusal_of(driver_at(closed));
    EXPECT_TRUE(has(refusal, std::to_string(closed).c_str()) && has(refusal, "systemctl start")) << refusal;
    const OtherProgram silent("");
    EXPECT_TRUE(has(refusal_of(driver_at(silent.port())), "does not answer")) << "it accepts and is silent";
    const OtherProgram web("HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\nhi");
    EXPECT_NE(refusal_of(driver_at(web.port())), "");
    const OtherProgram garbage(std::string(100'000, '\x7f'));
    EXPECT_NE(refusal_of(driver_at(garbage.port())), "");
}

TEST(Haply, NamesTheEventsOfTheArm) {
    MockService service;
    const auto link = open(service);
    service.send_event("device-safety-triggered", "ebrake_triggered");
    EXPECT_TRUE(comes(*link, {}, [&](const auto&) { return has(link->problem(), "emergency brake"); }));
}

TEST(Haply, ListsTheArmsOfTheService) {
    const MockService service({.is_calibrated = false});
    const std::vector<DeviceFound> found = driver_at(service.port()).find();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().id, "049D");
    EXPECT_TRUE(has(found.front().problem, "inkwell"));
    EXPECT_EQ(service.messages(), 0u) << "a list makes no force";
    EXPECT_TRUE(driver_at(OtherProgram("").port()).find().empty());
    const OtherProgram silent("");
    EXPECT_TRUE(driver_at(silent.port()).find().empty());
}

}  // namespace
}  // namespace kerf::haply
