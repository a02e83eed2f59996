// SPDX-License-Identifier: Apache-2.0
// A device for Kerf in one file of C++20 for Linux: it sends poses and gets forces over UDP. It needs no library.
//
// Replace `Handle` with your hardware: `position` reads the encoders, `apply` sets the motors. Here it is a hand that
// drills along the tool's axis and withdraws, so that the connection can be tried without hardware:
//
//     c++ -std=c++20 -O2 device.cpp -o device
//     kerf run pedicle-awl.yaml --device udp &
//     ./device --path 10:2,0:10,27:1,0:10        legs, each DISTANCE in mm:SPEED in mm/s
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

// All numbers are little-endian and packed. A big-endian machine must swap their bytes.
#pragma pack(push, 1)
struct Header {
    char magic[4] = {'K', 'E', 'R', 'F'};
    std::uint8_t version = 1, type = 0;
    std::uint16_t size = 0;
    std::uint64_t session = 0, sequence = 0;
};
struct Hello {
    char name[32] = "C++ example";
    std::uint32_t abilities = 1 | 2 | 4, buttons = 1;  // position, rotation, force
    double peak_force = 8.5, continuous_force = 2.1;   // [N]
    double peak_torque = 0.0, continuous_torque = 0.0;
    double largest_stiffness = 800.0, largest_damping = 5.0;  // [N/m], [N s/m]
    double mass = 0.075, resolution = 30e-6;                  // [kg], [m]
};
struct PoseReport {
    double position[3] = {}, rotation[4] = {1, 0, 0, 0};
    std::uint32_t buttons = 1, zero = 0;  // button 0: the motor of the tool runs
};
struct Force {
    std::uint64_t answered, tick;
    double force[3], torque[3], tool_position[3], tool_rotation[4];
    std::uint32_t flags, zero;
};
#pragma pack(pop)
enum Type : std::uint8_t { hello = 1, welcome, pose, force, goodbye };
constexpr std::uint32_t running = 2;  // flag of a force: it is of a tick, so the tool's pose counts
constexpr double period = 1e-3, watchdog = 20e-3, patience = 5.0;  // [s]

using Clock = std::chrono::steady_clock;
using Vector = std::array<double, 3>;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }
double dot(const double* a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Sends and receives Kerf's datagrams.
class Connection {
public:
    struct Answer {
        Type type;
        Force force{};
    };
    explicit Connection(std::uint16_t port) : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
        sockaddr_in kerf{};
        kerf.sin_family = AF_INET;
        kerf.sin_port = htons(port);
        kerf.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        is_open_ = connect(socket_, reinterpret_cast<const sockaddr*>(&kerf), sizeof kerf) == 0;
    }
    ~Connection() { close(socket_); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// A datagram is lost while Kerf does not listen yet.
    void send(Type type, const void* payload = nullptr, std::size_t size = 0) {
        std::array<char, 512> bytes;
        Header header;
        header.type = type;
        header.size = static_cast<std::uint16_t>(sizeof header + size);
        header.session = session_;
        header.sequence = ++sequence_;
        std::memcpy(bytes.data(), &header, sizeof header);
        if (size > 0) std::memcpy(bytes.data() + sizeof header, payload, size);
        static_cast<void>(::send(socket_, bytes.data(), header.size, 0));
    }
    /// Returns the newest datagram of Kerf, or nothing.
    std::optional<Answer> receive() {
        std::optional<Answer> newest;
        std::array<char, 512> bytes;
        for (int failures = 0; failures < 8;) {  // a refused datagram of before is reported once
            const ssize_t size = recv(socket_, bytes.data(), bytes.size(), 0);
            if (size < 0) {
                if (errno == EAGAIN || errno == EWOULDBLOCK) break;
                ++failures;
                continue;
            }
            Header header;
            if (static_cast<std::size_t>(size) < sizeof header) continue;
            std::memcpy(&header, bytes.data(), sizeof header);
            if (std::memcmp(header.magic, "KERF", 4) != 0 || header.version != 1 || header.size != size) continue;
            if (header.type == welcome)
                session_ = header.session;
            else if (header.session != session_)
                continue;
            Answer answer{static_cast<Type>(header.type)};
            if (header.type == force) {
                if (static_cast<std::size_t>(size) != sizeof header + sizeof answer.force) continue;
                std::memcpy(&answer.force, bytes.data() + sizeof header, sizeof answer.force);
            }
            newest = answer;
        }
        return newest;
    }
    /// Sends hello until Kerf answers. Returns whether it did within `wait` [s].
    bool open(double wait) {
        const Hello about;
        for (const auto begun = Clock::now(); is_open_ && seconds_since(begun) < wait;) {
            send(hello, &about, sizeof about);
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            const auto answer = receive();
            if (answer && answer->type == welcome) return true;
        }
        return false;
    }

private:
    int socket_;
    bool is_open_ = false;
    std::uint64_t session_ = 0, sequence_ = 0;
};

struct Leg {
    double end = 0.0, speed = 0.0;  // [m] along the tool, [m/s]
};

/// The handle of a device, with a simulated hand at it: a mass that a soft spring pulls along a path.
class Handle {
public:
    explicit Handle(std::vector<Leg> path) : path_(std::move(path)) {}

    [[nodiscard]] bool is_done() const { return leg_ >= path_.size(); }
    /// Returns its position from the encoders, device frame [m].
    [[nodiscard]] Vector position() const { return {at_ * along_[0], at_ * along_[1], at_ * along_[2]}; }
    /// Takes the force on the hand for the motors, and the pose of the tool, device frame.
    void apply(const Force& taken) {
        if (!has_tool_) {  // +z of the tool
            const double *q = taken.tool_rotation, w = q[0], x = q[1], y = q[2], z = q[3];
            along_ = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
            start_ = dot(taken.tool_position, along_);
            has_tool_ = true;
        }
        force_ = dot(taken.force, along_);
        tip_ = dot(taken.tool_position, along_) - start_;
    }
    /// Switches the motors off.
    void release() { force_ = 0.0; }
    void step(double dt) {
        constexpr double mass = 0.6, damping = 30.0, stiffness = 300.0, push = 2.5;  // [kg], [N s/m], [N/m], [N]
        if (!has_tool_ || is_done()) return;
        const Leg& leg = path_[leg_];
        // Where bone resists the tool, the aim runs ahead of it until the hand pushes with all its force.
        if (std::abs(force_) < push) aim_ += std::copysign(leg.speed * dt, leg.end - tip_);
        velocity_ += (stiffness * (aim_ - at_) - damping * velocity_ + force_) / mass * dt;
        at_ += velocity_ * dt;
        if (std::abs(tip_ - leg.end) >= 0.1e-3) return;
        ++leg_;
        aim_ = at_;
    }

private:
    std::vector<Leg> path_;
    std::size_t leg_ = 0;
    bool has_tool_ = false;
    Vector along_{};                                // direction of the tool, device frame
    double at_ = 0.0, velocity_ = 0.0, aim_ = 0.0;  // [m], [m/s], [m] along it
    double force_ = 0.0, tip_ = 0.0, start_ = 0.0;  // [N], [m], [m] along it
};

/// Exchanges poses and forces until the path is done or Kerf ends. Returns the exit code.
int serve(Connection& kerf, Handle& handle) {
    auto newest = Clock::now(), due = newest;
    while (!handle.is_done()) {
        due += std::chrono::microseconds(static_cast<int>(1e6 * period));
        std::this_thread::sleep_until(due);
        PoseReport report;
        const Vector at = handle.position();
        std::memcpy(report.position, at.data(), sizeof report.position);
        kerf.send(pose, &report, sizeof report);
        const auto answer = kerf.receive();
        if (answer && answer->type == goodbye) {
            std::puts("device: Kerf has ended the run");
            return EXIT_SUCCESS;
        }
        if (answer && answer->type == force) {
            if ((answer->force.flags & running) != 0) handle.apply(answer->force);
            newest = Clock::now();
        }
        if (seconds_since(newest) > watchdog) handle.release();
        if (seconds_since(newest) > patience) {
            std::fputs("device: Kerf is silent\n", stderr);
            return EXIT_FAILURE;
        }
        handle.step(period);
    }
    kerf.send(goodbye);
    std::puts("device: the path is done");
    return EXIT_SUCCESS;
}

/// Returns the legs of a text such as "10:2,0:10". Empty: it is none.
std::vector<Leg> legs_of(const std::string& text) {
    std::vector<Leg> path;
    std::istringstream legs(text);
    for (std::string one; std::getline(legs, one, ',');) {
        Leg leg;
        if (std::sscanf(one.c_str(), "%lf:%lf", &leg.end, &leg.speed) != 2) return {};
        path.push_back({1e-3 * leg.end, 1e-3 * leg.speed});
    }
    return path;
}

}  // namespace

int main(int argc, char** argv) {
    int port = 4190;
    std::vector<Leg> path = legs_of("10:2,0:10,27:1,0:10");
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string option = argv[i];
        if (option == "--port") port = std::atoi(argv[i + 1]);
        if (option == "--path") path = legs_of(argv[i + 1]);
    }
    if (port < 1 || port > 65535 || path.empty() || argc % 2 == 0) {
        std::fputs("usage: device [--port PORT] [--path DISTANCE:SPEED,…]   in mm and mm/s, such as 10:2,0:10\n",
                   stderr);
        return EXIT_FAILURE;
    }
    Connection kerf(static_cast<std::uint16_t>(port));
    if (!kerf.open(60.0)) {
        std::fputs("device: Kerf did not answer. Start `kerf run PROCEDURE.yaml --device udp`.\n", stderr);
        return EXIT_FAILURE;
    }
    std::puts("device: connected");
    Handle handle(std::move(path));
    const int code = serve(kerf, handle);
    handle.release();  // whatever has happened, the motors are off
    return code;
}
