// SPDX-License-Identifier: Apache-2.0
#include "web_sockets.h"

#include <libwebsockets.h>

#include <array>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>
#include <vector>

#include "service_text.h"

namespace kerf::haply {

namespace {

constexpr std::size_t max_piece = 1u << 14;  // [bytes] that one read takes
constexpr unsigned handshake_timeout = 2;    // [s]

/// libwebsockets ignores SIGPIPE for the whole process when it starts. Its sends need no such setting.
class KeptPipeSignal {
public:
    KeptPipeSignal() noexcept { sigaction(SIGPIPE, nullptr, &before_); }
    ~KeptPipeSignal() { sigaction(SIGPIPE, &before_, nullptr); }
    KeptPipeSignal(const KeptPipeSignal&) = delete;
    KeptPipeSignal& operator=(const KeptPipeSignal&) = delete;

private:
    struct sigaction before_ {};
};

/// One connection, as libwebsockets sees it.
struct Slot {
    SocketUser* user = nullptr;
    lws* connection = nullptr;
    bool is_open = false, is_ending = false;
    std::string message;         ///< whose last piece has not come
    std::vector<char> outgoing;  ///< LWS_PRE bytes of room, then the message

    void end(std::string_view reason) noexcept {
        SocketUser* const who = user;
        *this = {};
        if (who != nullptr) who->closed(reason);
    }
    /// Takes a piece of a message. Returns false to close the connection.
    [[nodiscard]] bool take(std::string_view piece, bool is_last) {
        if (message.size() + piece.size() > max_message) return false;
        if (message.empty() && is_last) return user->received(piece);
        message.append(piece);
        if (!is_last) return true;
        const std::string whole = std::move(message);
        message.clear();
        return user->received(whole);
    }
    [[nodiscard]] bool send() {
        const std::string_view text = user->to_send();
        if (text.empty()) return true;
        outgoing.resize(LWS_PRE + text.size());
        std::memcpy(outgoing.data() + LWS_PRE, text.data(), text.size());
        auto* const bytes = reinterpret_cast<unsigned char*>(outgoing.data()) + LWS_PRE;
        return lws_write(connection, bytes, text.size(), LWS_WRITE_TEXT) >= static_cast<int>(text.size());
    }
};

/// What libwebsockets calls back. Returns not 0 to close the connection.
int take_event(lws* connection, lws_callback_reasons reason, void* /*session*/, void* in, size_t size) {
    auto* const slot = static_cast<Slot*>(lws_get_opaque_user_data(connection));
    if (slot == nullptr || slot->user == nullptr) return 0;
    if (slot->connection != nullptr && slot->connection != connection) return 0;  // of an earlier connection
    const std::string_view bytes(static_cast<const char*>(in), in != nullptr ? size : 0);
    try {
        switch (reason) {
            case LWS_CALLBACK_CLIENT_ESTABLISHED:
                slot->is_open = true;
                slot->user->opened();
                return 0;
            case LWS_CALLBACK_CLIENT_RECEIVE:
                return slot->is_ending || !slot->take(bytes, lws_is_final_fragment(connection) != 0 &&
                                                                 lws_remaining_packet_payload(connection) == 0)
                           ? -1
                           : 0;
            case LWS_CALLBACK_CLIENT_WRITEABLE:
                return slot->is_ending || !slot->send() ? -1 : 0;
            case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
                slot->end(bytes.empty() ? "nothing answers" : bytes);
                return 0;
            case LWS_CALLBACK_CLIENT_CLOSED:
                slot->end("");
                return 0;
            case LWS_CALLBACK_WSI_DESTROY:  // after a handshake that was never answered, nothing else comes
                slot->end("the program behind it does not answer as a WebSocket server");
                return 0;
            default:
                return 0;
        }
    } catch (const std::exception&) {
        return -1;  // out of memory
    }
}

constexpr std::array<lws_protocols, 2> protocols{
    {{"kerf", &take_event, 0, max_piece, 0, nullptr, 0}, {nullptr, nullptr, 0, 0, 0, nullptr, 0}}};

void end_wait(lws_sorted_usec_list_t* /*timer*/) {}

}  // namespace

struct WebSockets::Impl {
    lws_context* context = nullptr;
    std::array<Slot, max_users> slots;
    lws_sorted_usec_list_t timer{};
};

WebSockets::WebSockets() : impl_(std::make_unique<Impl>()) {
    lws_set_log_level(0, nullptr);
    lws_context_creation_info info{};
    info.port = CONTEXT_PORT_NO_LISTEN;
    info.protocols = protocols.data();
    info.timeout_secs = handshake_timeout;
    info.connect_timeout_secs = handshake_timeout;
    info.gid = static_cast<gid_t>(-1);
    info.uid = static_cast<uid_t>(-1);
    const KeptPipeSignal kept;
    impl_->context = lws_create_context(&info);
    if (impl_->context == nullptr) throw std::runtime_error("there is no memory or file descriptor for a connection");
}

WebSockets::~WebSockets() {
    for (Slot& slot : impl_->slots) slot.user = nullptr;
    lws_sul_cancel(&impl_->timer);
    lws_context_destroy(impl_->context);
}

void WebSockets::connect(std::size_t slot, std::uint16_t port, SocketUser& user) {
    Slot& one = impl_->slots[slot];
    one = {};
    one.user = &user;
    lws_client_connect_info info{};
    info.context = impl_->context;
    info.address = "127.0.0.1";
    info.host = info.origin = "localhost";
    info.port = port;
    info.path = "/";
    info.local_protocol_name = protocols[0].name;
    info.ietf_version_or_minus_one = -1;
    info.opaque_user_data = &one;
    info.pwsi = &one.connection;
    if (lws_client_connect_via_info(&info) == nullptr && one.user != nullptr) one.end("nothing answers");
}

void WebSockets::request_send(std::size_t slot) noexcept {
    if (impl_->slots[slot].is_open) lws_callback_on_writable(impl_->slots[slot].connection);
}

void WebSockets::disconnect(std::size_t slot) noexcept {
    Slot& one = impl_->slots[slot];
    if (one.connection == nullptr) return;
    one.is_ending = true;
    lws_set_timeout(one.connection, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
}

void WebSockets::serve(int milliseconds) noexcept {
    lws_sul_schedule(impl_->context, 0, &impl_->timer, &end_wait,
                     static_cast<lws_usec_t>(milliseconds) * LWS_US_PER_MS);
    lws_service(impl_->context, 0);
}

void WebSockets::wake() noexcept { lws_cancel_service(impl_->context); }

bool has_web_sockets() noexcept { return true; }

}  // namespace kerf::haply
