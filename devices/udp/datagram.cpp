// SPDX-License-Identifier: Apache-2.0
#include "datagram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace kerf::udp {

namespace {

static_assert(std::endian::native == std::endian::little, "datagrams are little-endian");

constexpr std::uint8_t magic[4] = {'K', 'E', 'R', 'F'};
constexpr std::uint8_t version = 1;
constexpr std::size_t header_size = 24, name_size = 32, tag_size = 8;

constexpr std::size_t size_of(Type type) noexcept {
    switch (type) {
        case Type::hello:
            return header_size + name_size + 72;
        case Type::welcome:
            return header_size + 8;
        case Type::pose:
            return header_size + 64;
        case Type::force:
            return header_size + 128;
        case Type::goodbye:
            return header_size;
    }
    return 0;
}
static_assert(size_of(Type::force) + tag_size <= max_size);

class Writer {
public:
    explicit Writer(Bytes& bytes) noexcept : bytes_(bytes) {}
    template <class T>
    Writer& operator<<(const T& value) noexcept {
        static_assert(std::is_arithmetic_v<T>);
        std::memcpy(bytes_.data() + at_, &value, sizeof value);
        at_ += sizeof value;
        return *this;
    }
    Writer& operator<<(const kerf_vec3& v) noexcept { return *this << v.x << v.y << v.z; }
    Writer& operator<<(const kerf_pose& p) noexcept {
        return *this << p.position << p.rotation.w << p.rotation.x << p.rotation.y << p.rotation.z;
    }
    void name(std::string_view text) noexcept {
        for (std::size_t i = 0; i < name_size; ++i) *this << static_cast<char>(i < text.size() ? text[i] : '\0');
    }
    [[nodiscard]] std::size_t size() const noexcept { return at_; }

private:
    Bytes& bytes_;
    std::size_t at_ = 0;
};

class Reader {
public:
    /// Pre: the bytes are as many as will be read.
    explicit Reader(std::span<const std::uint8_t> bytes) noexcept : bytes_(bytes) {}
    template <class T>
    [[nodiscard]] T take() noexcept {
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        if constexpr (std::is_floating_point_v<T>) is_finite_ = is_finite_ && std::isfinite(value);
        return value;
    }
    [[nodiscard]] kerf_vec3 vector() noexcept {
        const auto x = take<double>(), y = take<double>(), z = take<double>();
        return {x, y, z};
    }
    [[nodiscard]] kerf_pose pose() noexcept {
        const kerf_vec3 position = vector();
        const auto w = take<double>(), x = take<double>(), y = take<double>(), z = take<double>();
        is_unit_ = is_unit_ && std::abs(w * w + x * x + y * y + z * z - 1.0) < 1e-3;
        return {position, {w, x, y, z}};
    }
    [[nodiscard]] std::string name() {
        std::string text;
        for (std::size_t i = 0; i < name_size; ++i) {
            const char c = take<char>();
            if (c == '\0' || text.size() < i) continue;  // what follows the first NUL
            text += c >= ' ' && c <= '~' ? c : '?';
        }
        return text;
    }
    /// Returns whether all numbers read are finite and all rotations of unit length.
    [[nodiscard]] bool is_sound() const noexcept { return is_finite_ && is_unit_; }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool is_finite_ = true, is_unit_ = true;
};

void write(Writer& to, const Hello& hello) noexcept {
    const kerf_device_facts& f = hello.facts;
    to.name(hello.name);
    to << f.abilities << f.button_count << f.peak_force << f.continuous_force << f.peak_torque << f.continuous_torque
       << f.largest_stiffness << f.largest_damping << f.mass << f.resolution;
}
void write(Writer& to, const Welcome& welcome) noexcept { to << welcome.period_us << welcome.watchdog_ms; }
void write(Writer& to, const PoseReport& pose) noexcept {
    to << pose.device_from_handle << pose.buttons << std::uint32_t{0};
}
void write(Writer& to, const ForceCommand& force) noexcept {
    const kerf_device_command& c = force.command;
    to << force.answered << c.tick << c.force << c.torque << c.device_from_tool << c.flags << std::uint32_t{0};
}
void write(Writer& /*to*/, const Goodbye& /*goodbye*/) noexcept {}

Type type_of(const Content& content) noexcept {
    constexpr Type types[] = {Type::hello, Type::welcome, Type::pose, Type::force, Type::goodbye};
    return types[content.index()];
}

bool is_sound(const kerf_device_facts& facts) noexcept {
    constexpr std::uint32_t known =
        KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE | KERF_DEVICE_TORQUE;
    const bool has_force = (facts.abilities & KERF_DEVICE_FORCE) != 0,
               has_torque = (facts.abilities & KERF_DEVICE_TORQUE) != 0;
    const auto is_limit = [](double peak, double continuous, bool is_made) {
        return is_made ? continuous > 0.0 && peak >= continuous : peak == 0.0 && continuous == 0.0;
    };
    return (facts.abilities & ~known) == 0 && (facts.abilities & KERF_DEVICE_POSITION) != 0 &&
           facts.button_count <= 32 && is_limit(facts.peak_force, facts.continuous_force, has_force) &&
           is_limit(facts.peak_torque, facts.continuous_torque, has_torque) && facts.largest_stiffness > 0.0 &&
           facts.largest_damping >= 0.0 && facts.mass > 0.0 && facts.resolution > 0.0;
}

std::optional<Content> read(Type type, Reader& from) {
    switch (type) {
        case Type::hello: {
            Hello hello{.name = from.name()};
            kerf_device_facts& f = hello.facts;
            f.abilities = from.take<std::uint32_t>();
            f.button_count = from.take<std::uint32_t>();
            for (double* value : {&f.peak_force, &f.continuous_force, &f.peak_torque, &f.continuous_torque,
                                  &f.largest_stiffness, &f.largest_damping, &f.mass, &f.resolution})
                *value = from.take<double>();
            std::copy_n(hello.name.c_str(), hello.name.size() + 1, f.name);
            if (!is_sound(f)) return std::nullopt;
            return hello;
        }
        case Type::welcome: {
            Welcome welcome;
            welcome.period_us = from.take<std::uint32_t>();
            welcome.watchdog_ms = from.take<std::uint32_t>();
            return welcome;
        }
        case Type::pose: {
            PoseReport report;
            report.device_from_handle = from.pose();
            report.buttons = from.take<std::uint32_t>();
            return report;
        }
        case Type::force: {
            ForceCommand force;
            force.answered = from.take<std::uint64_t>();
            force.command.tick = from.take<std::uint64_t>();
            force.command.force = from.vector();
            force.command.torque = from.vector();
            force.command.device_from_tool = from.pose();
            force.command.flags = from.take<std::uint32_t>();
            return force;
        }
        case Type::goodbye:
            return Goodbye{};
    }
    return std::nullopt;
}

std::nullopt_t refuse(DatagramFault why, DatagramFault& fault) noexcept {
    fault = why;
    return std::nullopt;
}

}  // namespace

const char* text_of(DatagramFault fault) noexcept {
    switch (fault) {
        case DatagramFault::none:
            return "";
        case DatagramFault::foreign:
            return "it does not begin with KERF";
        case DatagramFault::version:
            return "it is of another version than 1";
        case DatagramFault::type:
            return "its type is unknown";
        case DatagramFault::size:
            return "its length is wrong for its type";
        case DatagramFault::tag:
            return "its tag is wrong for the key";
        case DatagramFault::value:
            return "a number in it is not finite, a rotation not of unit length, or a limit not positive";
    }
    return "";
}

std::size_t encode(const Datagram& datagram, const Key* key, Bytes& bytes) noexcept {
    const Type type = type_of(datagram.content);
    Writer to(bytes);
    for (const std::uint8_t byte : magic) to << byte;
    to << version << static_cast<std::uint8_t>(type)
       << static_cast<std::uint16_t>(size_of(type) + (key != nullptr ? tag_size : 0)) << datagram.header.session
       << datagram.header.sequence;
    std::visit([&](const auto& content) { write(to, content); }, datagram.content);
    if (key != nullptr) to << siphash({bytes.data(), to.size()}, *key);
    return to.size();
}

std::optional<Datagram> decode(std::span<const std::uint8_t> bytes, const Key* key, DatagramFault& fault) {
    fault = DatagramFault::none;
    if (bytes.size() < sizeof magic || std::memcmp(bytes.data(), magic, sizeof magic) != 0)
        return refuse(DatagramFault::foreign, fault);
    if (bytes.size() < header_size) return refuse(DatagramFault::size, fault);
    if (bytes[4] != version) return refuse(DatagramFault::version, fault);
    if (bytes[5] < 1 || bytes[5] > 5) return refuse(DatagramFault::type, fault);
    const auto type = static_cast<Type>(bytes[5]);
    const std::size_t size = size_of(type), whole = size + (key != nullptr ? tag_size : 0);
    if (bytes.size() != whole || bytes[6] + 256u * bytes[7] != whole) return refuse(DatagramFault::size, fault);
    if (key != nullptr && Reader(bytes.subspan(size)).take<std::uint64_t>() != siphash(bytes.first(size), *key))
        return refuse(DatagramFault::tag, fault);
    Reader from(bytes.subspan(8));
    Datagram datagram{.header = {.type = type}, .content = Goodbye{}};
    datagram.header.session = from.take<std::uint64_t>();
    datagram.header.sequence = from.take<std::uint64_t>();
    auto content = read(type, from);
    if (!content || !from.is_sound()) return refuse(DatagramFault::value, fault);
    datagram.content = std::move(*content);
    return datagram;
}

}  // namespace kerf::udp
