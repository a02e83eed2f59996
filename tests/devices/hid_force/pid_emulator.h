// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/hid/hid_transport.h"
#include "tests/devices/hid_force/pid_firmware.h"

namespace kerf::test {

/// The firmware of a device with force feedback. It allocates blocks, ends an effect after its duration, and continues
/// for ever with one of infinite duration. Any thread may call its functions.
class PidEmulator {
public:
    /// @param clock  of the device [s]
    PidEmulator(Firmware firmware, std::function<double()> clock)
        : firmware_(std::move(firmware)), clock_(std::move(clock)) {}

    [[nodiscard]] const Firmware& firmware() const noexcept { return firmware_; }

    // What the program does
    [[nodiscard]] bool take_output(std::span<const std::uint8_t> report);
    [[nodiscard]] bool take_feature(std::span<const std::uint8_t> report);
    /// Fills the report whose id is the first byte. Returns its size; 0 if there is none.
    [[nodiscard]] std::size_t give_feature(std::span<std::uint8_t> report);
    [[nodiscard]] std::optional<std::vector<std::uint8_t>> next_input();

    // What the test sees and does
    /// Returns the torque that the motor makes now [–] -1 to 1, positive where the counts of the axis rise.
    [[nodiscard]] double torque() const;
    [[nodiscard]] std::size_t blocks() const;
    [[nodiscard]] bool was_disabled() const;
    /// Returns what was wrong with a report: its id, size, block or type; empty if nothing ever was.
    [[nodiscard]] std::string fault() const;
    [[nodiscard]] std::vector<std::vector<std::uint8_t>> outputs() const;
    void turn_to(std::int64_t counts);
    void send_input(std::vector<std::uint8_t> report);
    void lose_power();  ///< forgets all effects

    // How it behaves
    int pending_loads = 0;  ///< answers to `block load` before the block is there
    std::size_t max_blocks = 8;
    double gain_at_start = 1.0;  ///< [–]

private:
    struct Effect {
        double duration = 0.0, gain = 1.0, sign = 1.0;  ///< duration below 0: infinite [s]
        double magnitude = 0.0, started = 0.0;
        bool is_playing = false, is_set = false;
    };
    void note(const std::string& what, std::span<const std::uint8_t> report);
    [[nodiscard]] bool is_known(hid::ReportKind kind, std::span<const std::uint8_t> report);
    [[nodiscard]] Effect* effect(std::span<const std::uint8_t> report, At block);
    void control(std::span<const std::uint8_t> report);
    void set_effect(std::span<const std::uint8_t> report);

    Firmware firmware_;
    std::function<double()> clock_;
    mutable std::mutex mutex_;
    std::map<std::int64_t, Effect> effects_;
    std::int64_t created_ = 0;  ///< block of the last creation; 0: it found no memory
    int loads_left_ = 0;
    std::optional<double> gain_;
    bool is_enabled_ = false, was_disabled_ = false;
    std::string fault_;
    std::vector<std::vector<std::uint8_t>> outputs_;
    std::deque<std::vector<std::uint8_t>> inputs_;
};

/// A system with one such device, which a test plugs in and out and whose writes it blocks.
struct PidTable {
    std::shared_ptr<PidEmulator> device;
    std::vector<hid::HidEntry> entries{};
    std::string refusal{};              ///< of each `open`
    bool is_open = false;               ///< by one program
    double write_time = 0.0;            ///< [s] for which each write blocks
    int enumerations = 0, writers = 0;  ///< `writers`: of writes that block now
    mutable std::mutex mutex{};

    void plug_in(const std::string& path, const std::string& serial = "W1");
    void unplug();
    void block_writes(double seconds);
    [[nodiscard]] bool is_there(const std::string& path) const;
    [[nodiscard]] bool is_in_use() const {
        const std::lock_guard lock(mutex);
        return is_open;
    }
};

class PidTransport final : public hid::HidTransport {
public:
    explicit PidTransport(std::shared_ptr<PidTable> table) : table_(std::move(table)) {}
    ~PidTransport() override { PidTransport::close(); }

    std::vector<hid::HidEntry> enumerate() override;
    std::string open(const std::string& path) override;
    hid::HidRead read(std::span<std::uint8_t> bytes, int timeout_ms) noexcept override;
    std::vector<std::uint8_t> descriptor(const std::string& path) override;
    bool send(std::span<const std::uint8_t> report) noexcept override;
    bool send_feature(std::span<const std::uint8_t> report) noexcept override;
    std::size_t get_feature(std::span<std::uint8_t> report) noexcept override;
    void close() noexcept override;

private:
    [[nodiscard]] bool wait_for_device();
    std::shared_ptr<PidTable> table_;
    std::string path_;
};

}  // namespace kerf::test
