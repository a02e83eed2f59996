// SPDX-License-Identifier: Apache-2.0
#include "haply.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "arm_session.h"
#include "devices/realtime/raised_thread.h"
#include "kerf/device_exchange.hpp"
#include "service_list.h"
#include "web_sockets.h"

namespace kerf::haply {

namespace {

constexpr std::size_t simulation = 0, events = 1;  // slots of the connections
constexpr double period = 0.5e-3;                  // [s] between two commands at least
constexpr double no_answer = 20e-3;                // [s] then a command is repeated: the service may have lost it
constexpr double dead = 1.0;                       // [s] then the connection is given up
constexpr double first_pause = 0.1, longest_pause = 2.0;  // [s] before another attempt to connect
constexpr double shown_event = 5.0;                       // [s] for which an event counts as a problem
constexpr int wait_ms = 5;

struct Ports {
    std::uint16_t simulation, events;
};

std::string label(std::uint16_t port) { return "the service on port " + std::to_string(port) + ": "; }

kerf_device_facts facts_of(const Haply& driver, const ArmSession& session) {
    constexpr std::uint32_t grip_buttons = 3;
    kerf_device_facts facts{};
    detail::copy_text(facts.name, name_of_arm(session.type(), session.arm()));
    facts.abilities = KERF_DEVICE_POSITION | KERF_DEVICE_FORCE;
    if (session.has_grip()) facts.abilities |= KERF_DEVICE_ROTATION;
    facts.button_count = session.has_grip() ? grip_buttons : 0;
    facts.peak_force = driver.peak_force;
    facts.continuous_force = driver.continuous_force;
    facts.largest_stiffness = driver.stiffness;
    facts.largest_damping = 5.0;  // [assumed]
    facts.mass = 0.15;            // [assumed]
    facts.resolution = 50e-6;     // [assumed]
    return facts;
}

/// Passes texts from the driver's thread to the main thread.
class Notice {
public:
    void set(std::string text) {
        const std::lock_guard lock(mutex_);
        text_ = std::move(text);
    }
    [[nodiscard]] std::string get() const {
        const std::lock_guard lock(mutex_);
        return text_;
    }

private:
    mutable std::mutex mutex_;
    std::string text_;
};

/// Pauses between attempts to connect, each twice as long as the one before.
class BackOff {
public:
    [[nodiscard]] bool is_due(double now) const noexcept { return now >= next_; }
    void failed(double now) noexcept {
        next_ = now + pause_;
        pause_ = std::min(2.0 * pause_, longest_pause);
    }
    void succeeded() noexcept { pause_ = first_pause; }

private:
    double next_ = 0.0, pause_ = first_pause;  ///< [s]
};

/// An arm that a thread of its own drives through the service.
class Link final : public DeviceLink {
public:
    Link(const Haply& driver, ArmSession session)
        : driver_(driver),
          ports_{static_cast<std::uint16_t>(driver.port), static_cast<std::uint16_t>(driver.events_port)},
          session_(std::move(session)),
          arm_channel_(*this),
          event_channel_(*this) {
        thread_ = std::thread([this] { serve(); });
    }
    ~Link() override {
        is_ending_.store(true, std::memory_order_relaxed);
        sockets_.wake();
        thread_.join();
    }

    /// Waits until the arm runs. Throws if it is refused.
    void wait_for_arm(double seconds, const DeviceRequest& request) {
        for (const double end = device_time() + seconds; !runs_.load(std::memory_order_acquire);) {
            if (has_failed_.load(std::memory_order_acquire)) throw std::runtime_error(notice_.get());
            if (request.is_cancelled()) throw std::runtime_error("interrupted before the service answered");
            if (device_time() > end)
                throw std::runtime_error(label(ports_.simulation) +
                                         "it sends no message that Kerf waits for. Restart it: "
                                         "`systemctl restart haply-inverse-service`.");
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return exchange_.read(); }
    void write(const kerf_device_command& command) noexcept override { exchange_.write(command); }
    [[nodiscard]] std::string problem() override {
        std::string own = notice_.get();
        return own.empty() ? event_notice_.get() : own;
    }

private:
    /// The simulation channel: states and commands.
    struct ArmChannel final : SocketUser {
        explicit ArmChannel(Link& owner) : link(owner) {}
        void opened() noexcept override { link.session_.begin(); }
        [[nodiscard]] bool received(std::string_view message) noexcept override { return link.take(message); }
        [[nodiscard]] std::string_view to_send() noexcept override { return link.next_command(); }
        void closed(std::string_view reason) noexcept override { link.lose(reason); }
        Link& link;
    };
    /// The channel of events.
    struct EventChannel final : SocketUser {
        explicit EventChannel(Link& owner) : link(owner) {}
        void opened() noexcept override { pause.succeeded(); }
        [[nodiscard]] bool received(std::string_view message) noexcept override {
            link.take_event(message);
            return true;
        }
        void closed(std::string_view /*reason*/) noexcept override {
            is_connected = false;
            pause.failed(device_time());
        }
        Link& link;
        bool is_connected = false;
        BackOff pause{};
    };

    void serve() noexcept {
        raise_device_thread();
        while (!is_ending_.load(std::memory_order_relaxed)) {
            connect();
            sockets_.serve(wait_ms);
            watch_silence();
        }
        say_goodbye();
    }

    void connect() {
        const double now = device_time();
        if (!is_connected_ && pause_.is_due(now)) {
            is_connected_ = true;
            heard_ = sent_ = now;
            sockets_.connect(simulation, ports_.simulation, arm_channel_);
        }
        if (!event_channel_.is_connected && runs_.load(std::memory_order_relaxed) && event_channel_.pause.is_due(now)) {
            event_channel_.is_connected = true;
            sockets_.connect(events, ports_.events, event_channel_);
        }
    }

    void watch_silence() noexcept {
        const double now = device_time();
        if (now >= event_until_) event_notice_.set({});
        if (!is_connected_) return;
        if (now - heard_ > dead) return sockets_.disconnect(simulation);
        const bool may_send =
            session_.phase() == ArmSession::Phase::runs || session_.phase() == ArmSession::Phase::tries;
        if (may_send && now - heard_ > no_answer && now - sent_ > no_answer) sockets_.request_send(simulation);
    }

    [[nodiscard]] bool take(std::string_view message) noexcept {
        try {
            heard_ = device_time();
            const bool goes_on = session_.take(message);
            publish();
            if (!goes_on) return false;
            pause_.succeeded();
            if (session_.phase() == ArmSession::Phase::runs && !runs_.load(std::memory_order_relaxed)) {
                facts_ = facts_of(driver_, session_);
                runs_.store(true, std::memory_order_release);
            }
            if (const double early = sent_ + period - device_time(); early > 0.0)
                std::this_thread::sleep_for(std::chrono::duration<double>(early));
            sockets_.request_send(simulation);
            return true;
        } catch (const std::exception&) {
            return false;  // out of memory: the connection begins again
        }
    }

    void publish() {
        exchange_.put(session_.state(), heard_);
        if (session_.problem() == shown_problem_) return;
        shown_problem_ = session_.problem();
        notice_.set(shown_problem_.empty() ? "" : label(ports_.simulation) + shown_problem_);
    }

    [[nodiscard]] std::string_view next_command() noexcept {
        try {
            const bool is_usable = (session_.state().flags & KERF_DEVICE_VALID) != 0 && !is_leaving_;
            command_ = session_.command(is_usable ? exchange_.command().force : Vec3{});
        } catch (const std::exception&) {
            command_.clear();
        }
        sent_ = device_time();
        return command_;
    }

    void lose(std::string_view reason) noexcept {
        const double now = device_time();
        is_connected_ = false;
        pause_.failed(now);
        kerf_device_state lost = session_.state();
        lost.flags = 0;
        exchange_.put(lost, now);
        try {
            if (session_.phase() != ArmSession::Phase::refused)
                notice_.set(
                    label(ports_.simulation) + (reason.empty() ? "it has closed the connection" : std::string(reason)) +
                    ". Start Haply's Inverse Service: `systemctl start haply-inverse-service`; if it uses another "
                    "port, write `settings: {port: 10001}` in the station.");
            shown_problem_ = "lost";
        } catch (const std::exception&) {
            shown_problem_.clear();
        }
        if (!runs_.load(std::memory_order_relaxed)) has_failed_.store(true, std::memory_order_release);
    }

    void take_event(std::string_view message) noexcept {
        try {
            const auto event = read_event(message);
            if (!event || !session_.concerns(*event)) return;
            std::string problem = problem_of(*event);
            if (problem.empty()) return;
            event_notice_.set(std::move(problem));
            event_until_ = device_time() + shown_event;
        } catch (const std::exception&) {
            return;  // out of memory: an event less
        }
    }

    /// Sends a zero force, and waits until the service has answered it or 50 ms are over.
    void say_goodbye() noexcept {
        if (!is_connected_ || session_.phase() != ArmSession::Phase::runs) return;
        is_leaving_ = true;
        const double start = device_time();
        sockets_.request_send(simulation);
        while (is_connected_ && (sent_ < start || heard_ < sent_) && device_time() < start + 0.05)
            sockets_.serve(wait_ms);
    }

    Haply driver_;
    Ports ports_;
    ArmSession session_;
    WebSockets sockets_;
    ArmChannel arm_channel_;
    EventChannel event_channel_;
    DeviceExchange exchange_;
    Notice notice_, event_notice_;
    kerf_device_facts facts_{};  ///< since it runs
    std::string command_, shown_problem_;
    BackOff pause_;
    double heard_ = 0.0, sent_ = 0.0, event_until_ = 0.0;  ///< [s]
    bool is_connected_ = false, is_leaving_ = false;
    std::atomic<bool> runs_{false}, has_failed_{false}, is_ending_{false};
    std::thread thread_;
};

std::optional<ForceWord> word_of(const std::string& version) {
    if (version.empty()) return std::nullopt;
    if (version.starts_with("3.5")) return ForceWord::vector;
    if (version.starts_with("3.1")) return ForceWord::values;
    throw std::runtime_error("the station's setting `service` is `" + version.substr(0, 20) +
                             "`. Write the version of the messages, 3.1 or 3.5, or remove it.");
}

}  // namespace

std::vector<DeviceFound> Haply::find() const { return list_arms(static_cast<std::uint16_t>(port)); }

std::unique_ptr<DeviceLink> Haply::open(const DeviceRequest& request) const {
    if (!has_web_sockets()) throw std::runtime_error(lacks_web_sockets);
    request.require_known_settings({"service"});
    auto link = std::make_unique<Link>(*this, ArmSession(request.id(), word_of(request.setting("service"))));
    link->wait_for_arm(wait, request);
    return link;
}

}  // namespace kerf::haply
