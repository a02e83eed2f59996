// SPDX-License-Identifier: Apache-2.0
#include "tests/devices/haply/mock_service.h"

#include <libwebsockets.h>

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "kerf/device_exchange.hpp"

namespace kerf::haply {

namespace {

using Json = nlohmann::json;

constexpr double command_lasts = 20e-3;  // [s]
constexpr const char* arm_id = "049D";
constexpr const char* grip_id = "61548";

// Kerf's frame has +y up and +z towards the user, the service's +y away from the user and +z up.
Json vector_json(Vec3 v) { return {{"x", v.x}, {"y", -v.z}, {"z", v.y}}; }
Json rotation_json(const Quat& q) { return {{"w", q.w}, {"x", q.x}, {"y", -q.z}, {"z", q.y}}; }
Json angles_json(double value) { return {{"a0", value}, {"a1", value}, {"a2", value}}; }

Json transform_json() {
    return {{"position", vector_json({})},
            {"rotation", rotation_json({1, 0, 0, 0})},
            {"scale", {{"x", 1.0}, {"y", 1.0}, {"z", 1.0}}}};
}

Json config_json(bool is_3_5) {
    Json config{{"type", "inverse3"},
                {"port", "/dev/ttyACM0"},
                {"device_info",
                 {{"major_version", 7}, {"minor_version", 4}, {"id", arm_id}, {"device_type", 4}, {"uuid", "0"}}},
                {"extended_device_id", "0"},
                {"extended_firmware_version", "0"},
                {"gravity_compensation", {{"enabled", true}, {"scaling_factor", 1.0}}},
                {"handedness", "right"},
                {"torque_scaling", {{"enabled", true}}}};
    if (is_3_5) {
        config["preset"] = "defaults";
        config["basis"] = {{"permutation", "XYZ"}};
        config["mount"] = transform_json();
        config["filters"] = {{"force_gate", {{"gain", 0.3}}}, {"damping", {{"scalar", 0.0}}}};
    }
    return config;
}

}  // namespace

/// The server of libwebsockets. `port` and `events_port` are virtual hosts of it.
struct MockService::Server {
    /// A connection.
    struct Session {
        MockService* mock;
        bool is_of_events, is_new;
        std::size_t events_sent;
        int owed;               ///< answers to messages
        std::string* incoming;  ///< whose last piece has not come
    };

    static int take_event(lws* connection, lws_callback_reasons reason, void* memory, void* in, size_t size) {
        auto* const session = static_cast<Session*>(memory);
        const lws_vhost* const host = lws_get_vhost(connection);
        auto* const mock =
            host != nullptr ? static_cast<MockService*>(lws_get_vhost_user(const_cast<lws_vhost*>(host))) : nullptr;
        switch (reason) {
            case LWS_CALLBACK_ESTABLISHED:
                *session = {
                    .mock = mock,
                    .is_of_events = std::strcmp(lws_get_vhost_name(const_cast<lws_vhost*>(host)), "events") == 0,
                    .is_new = true,
                    .events_sent = 0,
                    .owed = 1,
                    .incoming = new std::string};
                mock->server_->connections.push_back(connection);
                if (!session->is_of_events) lws_callback_on_writable(connection);
                return 0;
            case LWS_CALLBACK_CLOSED:
                std::erase(mock->server_->connections, connection);
                delete session->incoming;
                return 0;
            case LWS_CALLBACK_RECEIVE:
                session->incoming->append(static_cast<const char*>(in), size);
                if (lws_is_final_fragment(connection) == 0 || lws_remaining_packet_payload(connection) != 0) return 0;
                mock->take(*session->incoming);
                session->incoming->clear();
                ++session->owed;
                if (mock->fault_.load() != Fault::no_answers) lws_callback_on_writable(connection);
                return 0;
            case LWS_CALLBACK_SERVER_WRITEABLE:
                if (mock->should_hang_up_.load()) return -1;
                return session->is_of_events ? send_events(connection, *session) : send_state(connection, *session);
            default:
                return 0;
        }
    }

    static int send_text(lws* connection, const std::string& text, lws_write_protocol how) {
        std::vector<unsigned char> bytes(LWS_PRE + text.size());
        std::memcpy(bytes.data() + LWS_PRE, text.data(), text.size());
        return lws_write(connection, bytes.data() + LWS_PRE, text.size(), how) < static_cast<int>(text.size()) ? -1 : 0;
    }

    static int send_state(lws* connection, Session& session) {
        if (session.owed == 0 || session.mock->fault_.load() == Fault::no_answers) return 0;
        --session.owed;
        const std::string text = session.mock->next_message(session.is_new);
        session.is_new = false;
        if (session.mock->fault_.load() == Fault::half_a_message)
            return send_text(connection, text.substr(0, text.size() / 2),
                             static_cast<lws_write_protocol>(LWS_WRITE_TEXT | LWS_WRITE_NO_FIN));
        if (session.owed > 0) lws_callback_on_writable(connection);
        return send_text(connection, text, LWS_WRITE_TEXT);
    }

    static int send_events(lws* connection, Session& session) {
        std::string text;
        {
            const std::lock_guard lock(session.mock->mutex_);
            if (session.events_sent >= session.mock->events_.size()) return 0;
            text = session.mock->events_[session.events_sent++];
        }
        lws_callback_on_writable(connection);
        return send_text(connection, text, LWS_WRITE_TEXT);
    }

    lws_context* context = nullptr;
    lws_vhost* of_states = nullptr;
    lws_vhost* of_events = nullptr;
    std::array<lws_protocols, 2> protocols{
        {{"service", &take_event, sizeof(Session), 1u << 14, 0, nullptr, 0}, {nullptr, nullptr, 0, 0, 0, nullptr, 0}}};
    lws_sorted_usec_list_t timer{};
    std::vector<lws*> connections;  ///< which have something to send, perhaps
};

MockService::MockService(const Options& options) : options_(options), server_(std::make_unique<Server>()) {
    is_calibrated_.store(options.is_calibrated);
    lws_set_log_level(0, nullptr);
    lws_context_creation_info info{};
    info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
    info.gid = static_cast<gid_t>(-1);
    info.uid = static_cast<uid_t>(-1);
    server_->context = lws_create_context(&info);
    if (server_->context == nullptr) throw std::runtime_error("no context");
    const auto host = [&](const char* name, int port) {
        lws_context_creation_info one{};
        one.vhost_name = name;
        one.iface = "127.0.0.1";
        one.port = port;
        one.protocols = server_->protocols.data();
        one.user = this;
        lws_vhost* const made = lws_create_vhost(server_->context, &one);
        if (made == nullptr || lws_get_vhost_listen_port(made) <= 0) throw std::runtime_error("the port is in use");
        return made;
    };
    server_->of_states = host("states", options.port);
    server_->of_events = host("events", 0);
    port_ = static_cast<std::uint16_t>(lws_get_vhost_listen_port(server_->of_states));
    events_port_ = static_cast<std::uint16_t>(lws_get_vhost_listen_port(server_->of_events));
    thread_ = std::thread([this] {
        while (!is_ending_.load()) {
            lws_sul_schedule(
                server_->context, 0, &server_->timer, [](lws_sorted_usec_list_t*) {}, 20 * LWS_US_PER_MS);
            lws_service(server_->context, 0);
            for (lws* const connection : server_->connections) lws_callback_on_writable(connection);
        }
    });
}

MockService::~MockService() {
    is_ending_.store(true);
    lws_cancel_service(server_->context);
    thread_.join();
    lws_context_destroy(server_->context);
}

void MockService::set_handle(const Pose& device_from_handle, std::uint32_t buttons) {
    const std::lock_guard lock(mutex_);
    handle_ = device_from_handle;
    buttons_ = buttons;
}

Vec3 MockService::force() const {
    const std::lock_guard lock(mutex_);
    return device_time() - force_time_ <= command_lasts ? force_ : Vec3{};
}

std::string MockService::first_message() const {
    const std::lock_guard lock(mutex_);
    return first_message_;
}

std::vector<double> MockService::take_answer_times() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_times_, {});
}

void MockService::send_event(const std::string& name, const std::string& safety_type) {
    const std::lock_guard lock(mutex_);
    Json data{{"device_family", "inverse"}, {"device_id", arm_id}};
    if (!safety_type.empty()) data["safety_type"] = safety_type;
    events_.push_back(
        Json{{"name", name}, {"category", "device"}, {"level", "warning"}, {"data", data}, {"message", ""}}.dump());
    lws_cancel_service(server_->context);
}

void MockService::hang_up() noexcept {
    should_hang_up_.store(true);
    lws_cancel_service(server_->context);
}

void MockService::take(const std::string& message) {
    const std::lock_guard lock(mutex_);
    const double now = device_time();
    if (sent_time_ > 0.0) answer_times_.push_back(now - sent_time_);
    sent_time_ = 0.0;
    const Json json = Json::parse(message);
    if (json.contains("session")) first_message_ = message;
    const Json& command = json.at("inverse3").at(0);
    if (command.at("device_id") != arm_id) throw std::runtime_error("a command for another arm");
    const Json& force = command.at("commands").at("set_cursor_force");
    for (const auto& [word, is_taken] :
         {std::pair{"vector", options_.takes_vector}, {"values", options_.takes_values}}) {
        if (!is_taken || !force.contains(word)) continue;
        const Json& v = force.at(word);
        force_ = {v.at("x").get<double>(), v.at("z").get<double>(), -v.at("y").get<double>()};
        force_time_ = now;
    }
    ++messages_;
}

std::string MockService::next_message(bool is_first) {
    const std::lock_guard lock(mutex_);
    const Fault fault = fault_.load();
    if (fault == Fault::not_json) return "{\"inverse3\": [";
    Json message;
    if (options_.is_3_5) message["session_id"] = 7;
    message["inverse3"] = Json::array();
    if (options_.has_arm && fault != Fault::arm_unplugged) {
        Json state{{"cursor_position", vector_json(handle_.position)},
                   {"cursor_velocity", vector_json({})},
                   {"angular_position", angles_json(12.5)},
                   {"angular_velocity", angles_json(0.0)},
                   {"body_orientation", rotation_json({1, 0, 0, 0})}};
        if (fault == Fault::no_number) state["cursor_position"]["x"] = nullptr;
        if (options_.is_3_5) {
            state["current_cursor_force"] = vector_json(device_time() - force_time_ <= command_lasts ? force_ : Vec3{});
            state["current_cursor_position"] = vector_json({});
            state["current_angular_torques"] = angles_json(0.0);
            state["current_angular_position"] = angles_json(0.0);
            state["control_domain"] = "cartesian";
            state["control_mode"] = "cursor_force";
            state["transform"] = transform_json();
        } else {
            state["mode"] = "cursor_force";
        }
        Json arm{{"device_id", arm_id},
                 {"state", std::move(state)},
                 {"status",
                  {{"calibrated", is_calibrated_.load()},
                   {"in_use", options_.is_in_use},
                   {"power_supply", true},
                   {"ready", true},
                   {"started", true}}}};
        if (is_first) arm["config"] = config_json(options_.is_3_5);
        message["inverse3"].push_back(std::move(arm));
    }
    message["wireless_verse_grip"] = Json::array();
    if (options_.has_grip)
        message["wireless_verse_grip"].push_back(
            {{"device_id", grip_id},
             {"state",
              {{"orientation", rotation_json(handle_.rotation)},
               {"buttons", {{"a", (buttons_ & 1u) != 0}, {"b", (buttons_ & 2u) != 0}, {"c", (buttons_ & 4u) != 0}}},
               {"hall", 0}}}});
    sent_time_ = device_time();
    return fault == Fault::too_long ? message.dump() + std::string(1u << 20, ' ') : message.dump();
}

}  // namespace kerf::haply
