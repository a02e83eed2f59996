// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace kerf::haply {

/// A connection to a WebSocket server on this machine. `WebSockets` calls the functions, on the thread that serves.
class SocketUser {
public:
    virtual ~SocketUser() = default;
    virtual void opened() noexcept = 0;
    /// Takes a whole message. Returns false to close the connection.
    [[nodiscard]] virtual bool received(std::string_view message) noexcept = 0;
    /// Returns the message to send, after `request_send`; empty: none.
    [[nodiscard]] virtual std::string_view to_send() noexcept { return {}; }
    /// The connection has ended, or there is none. `reason` is for people; empty: the server closed it.
    virtual void closed(std::string_view reason) noexcept = 0;
};

/// Up to two connections. One thread calls all functions but `wake`.
class WebSockets {
public:
    /// Throws std::runtime_error if there is no memory or descriptor.
    WebSockets();
    ~WebSockets();
    WebSockets(const WebSockets&) = delete;
    WebSockets& operator=(const WebSockets&) = delete;

    static constexpr std::size_t max_users = 2;
    /// Begins to connect `slot` to a port. Pre: the slot has no connection. `user` outlives it.
    void connect(std::size_t slot, std::uint16_t port, SocketUser& user);
    /// Lets the user of a slot send as soon as the connection takes bytes.
    void request_send(std::size_t slot) noexcept;
    /// Ends a connection soon; `closed` follows while it serves.
    void disconnect(std::size_t slot) noexcept;
    /// Waits for something to do, at most this time [ms], and does it.
    void serve(int milliseconds) noexcept;
    /// Ends a wait.   [any thread]
    void wake() noexcept;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Returns whether this build has WebSockets.   [any]
[[nodiscard]] bool has_web_sockets() noexcept;
/// The message of a build without, and what to do.
inline constexpr const char* lacks_web_sockets =
    "this build of Kerf lacks WebSockets. Install the package `libwebsockets-dev`, configure and build Kerf again.";

}  // namespace kerf::haply
