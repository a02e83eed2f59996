// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "kerf/math.hpp"

namespace kerf::haply {

/// A stand-in for Haply's Inverse Service: a WebSocket server on this machine with an Inverse3 and a grip. It sends one
/// message when a client connects, then one for each message that it gets. Its messages have the keys of the maker's
/// pages "Simulation Channel" 3.1 and "WebSocket Protocol" 3.5. Any thread may call its functions.
class MockService {
public:
    struct Options {
        bool is_3_5 = true;        ///< 3.5 names its session and shows its force
        bool takes_vector = true;  ///< the word of a force command that it takes
        bool takes_values = false;
        bool is_calibrated = true, is_in_use = false, has_arm = true, has_grip = true;
        std::uint16_t port = 0;  ///< 0: any free one
    };
    explicit MockService(const Options& options);
    MockService() : MockService(Options{}) {}
    ~MockService();
    MockService(const MockService&) = delete;
    MockService& operator=(const MockService&) = delete;

    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    [[nodiscard]] std::uint16_t events_port() const noexcept { return events_port_; }

    /// Moves the handle; frame `device` of Kerf.
    void set_handle(const Pose& device_from_handle, std::uint32_t buttons);
    /// Returns the force of the newest command, frame `device` of Kerf; zero if none has come for 20 ms: the arm idles.
    [[nodiscard]] Vec3 force() const;
    /// Returns how many messages it has got.
    [[nodiscard]] std::uint64_t messages() const noexcept { return messages_.load(); }
    /// Returns the first message of the newest client.
    [[nodiscard]] std::string first_message() const;
    /// Returns the times between a state that it sent and the next command [s], since the last call.
    [[nodiscard]] std::vector<double> take_answer_times();

    /// What goes wrong from now on.
    enum class Fault : std::uint8_t { none, arm_unplugged, no_answers, no_number, not_json, half_a_message, too_long };
    void set_fault(Fault fault) noexcept { fault_.store(fault); }
    void set_calibrated(bool is_calibrated) noexcept { is_calibrated_.store(is_calibrated); }
    /// Sends an event to those who listen.
    void send_event(const std::string& name, const std::string& safety_type = "");
    /// Closes all connections.
    void hang_up() noexcept;

private:
    struct Server;
    friend struct Server;
    [[nodiscard]] std::string next_message(bool is_first);
    void take(const std::string& message);

    Options options_;
    std::uint16_t port_ = 0, events_port_ = 0;
    mutable std::mutex mutex_;
    Pose handle_{{0.0, 0.15, 0.12}, {1, 0, 0, 0}};
    std::uint32_t buttons_ = 0;
    Vec3 force_{};
    double force_time_ = 0.0, sent_time_ = 0.0;  ///< [s]
    std::string first_message_;
    std::vector<double> answer_times_;
    std::vector<std::string> events_;
    std::atomic<std::uint64_t> messages_{0};
    std::atomic<Fault> fault_{Fault::none};
    std::atomic<bool> is_calibrated_{true}, should_hang_up_{false}, is_ending_{false};
    std::unique_ptr<Server> server_;
    std::thread thread_;
};

}  // namespace kerf::haply
