// SPDX-License-Identifier: Apache-2.0
#include "web_sockets.h"

namespace kerf::haply {

struct WebSockets::Impl {};
WebSockets::WebSockets() = default;
WebSockets::~WebSockets() = default;
void WebSockets::connect(std::size_t /*slot*/, std::uint16_t /*port*/, SocketUser& user) {
    user.closed(lacks_web_sockets);
}
void WebSockets::request_send(std::size_t /*slot*/) noexcept {}
void WebSockets::disconnect(std::size_t /*slot*/) noexcept {}
void WebSockets::serve(int /*milliseconds*/) noexcept {}
void WebSockets::wake() noexcept {}
bool has_web_sockets() noexcept { return false; }

}  // namespace kerf::haply
