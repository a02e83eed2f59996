// SPDX-License-Identifier: Apache-2.0
#include "app/device_test.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <thread>

#include "app/interruption.h"
#include "app/motion_recorder.h"
#include "app/own_device.h"
#include "app/standard_streams.h"
#include "run/device/opened_device.h"

namespace kerf::app {

namespace {

constexpr std::size_t max_channels = 6;
using Channels = std::array<double, max_channels>;

/// What a device senses, and how a person reads it.
struct Sense {
    std::size_t count;                             ///< of its channels
    const char* what;                              ///< that it senses
    double scale;                                  ///< end of the bars
    double per_unit;                               ///< SI per printed unit
    const char* unit;                              ///< printed
    int digits;                                    ///< printed after the point
    std::array<const char*, max_channels> axes{};  ///< names of the channels
};
constexpr Sense position{3, "position", 0.15, 1e-3, "mm", 1, {"x (right)      ", "y (up)         ", "z (to the user)"}};
constexpr Sense deflection{
    6,
    "deflection",
    1.0,
    1.0,
    "of the full deflection",
    2,
    {"x (right)      ", "y (up)         ", "z (to the user)", "about x        ", "about y        ", "about z        "}};
constexpr Sense nothing{0, "nothing but buttons", 1.0, 1.0, "", 0};

const Sense& sense_of(const kerf_device_facts& facts) noexcept {
    return (facts.abilities & KERF_DEVICE_POSITION) != 0     ? position
           : (facts.abilities & KERF_DEVICE_DEFLECTION) != 0 ? deflection
                                                             : nothing;
}

Channels channels_of(const kerf_device_state& state, const Sense& sense) noexcept {
    Channels channels{};
    if (&sense == &deflection) std::copy_n(state.deflection, max_channels, channels.begin());
    const Vec3 p = state.device_from_handle.position;
    return &sense == &position ? Channels{p.x, p.y, p.z} : channels;
}

/// Lowest and highest values of channels.
struct Extent {
    Channels low, high;

    Extent() {
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
    }
    void add(const Channels& channels) noexcept {
        for (std::size_t i = 0; i < max_channels; ++i) {
            low[i] = std::min(low[i], channels[i]);
            high[i] = std::max(high[i], channels[i]);
        }
    }
    /// Returns the widest range of a channel.
    [[nodiscard]] double width() const noexcept {
        double width = 0.0;
        for (std::size_t i = 0; i < max_channels; ++i) width = std::max(width, high[i] - low[i]);
        return width;
    }
    /// Returns the largest value, without its sign.
    [[nodiscard]] double size() const noexcept {
        double size = 0.0;
        for (std::size_t i = 0; i < max_channels; ++i) size = std::max({size, std::abs(low[i]), std::abs(high[i])});
        return size;
    }
};

/// What a device reported in some seconds.
struct Reports {
    std::uint64_t count = 0, count_in_use = 0;
    double seconds = 0.0, seconds_in_use = 0.0;  ///< [s]; in use: not at rest, or of a device that always sends
    double longest_gap = 0.0;                    ///< [s] between reports in use
    double age_sum = 0.0;                        ///< [s] of the newest reports, over the samples in use
    std::uint64_t samples_in_use = 0;
    Extent all;
    Extent calmest;                                                  ///< of the 0.2 s with the smallest range
    double calmest_width = std::numeric_limits<double>::infinity();  ///< [SI]
    std::uint32_t buttons = 0;                                       ///< that were pressed
    bool was_valid = false;
};

/// Returns the command of a tick without force, in which the tool is where the handle is.
kerf_device_command command_without_force(std::uint64_t tick, const kerf_device_state& state) noexcept {
    kerf_device_command command{};
    command.tick = tick;
    command.device_from_tool = state.device_from_handle;
    command.flags = KERF_DEVICE_RUNNING;
    return command;
}

/// @param recorder  gets the motion of the handle, unless null
Reports watch_reports(run::OpenedDevice& device, const Sense& sense, double seconds, MotionRecorder* recorder,
                      const Interruption& interruption) {
    constexpr auto period = std::chrono::milliseconds(1);
    constexpr std::size_t window = 200;  // samples
    Reports reports;
    Extent recent;
    std::size_t recent_count = 0;
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t first = device.read().reports;
    std::uint64_t tick = 0;
    auto next = start;
    while (reports.seconds < seconds && !interruption.has_come()) {
        next += period;
        std::this_thread::sleep_until(next);
        const double before = reports.seconds;
        reports.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const kerf_device_state state = device.read();
        device.write(command_without_force(tick++, state));
        if (recorder != nullptr) recorder->take(reports.seconds, state);
        const std::uint64_t count = state.reports - first, added = count - reports.count;
        reports.count = count;
        const Channels channels = channels_of(state, sense);
        const bool is_in_use =
            &sense == &position || std::any_of(channels.begin(), channels.end(), [](double c) { return c != 0.0; });
        if (is_in_use) {
            reports.count_in_use += added;
            reports.seconds_in_use += reports.seconds - before;
            reports.longest_gap = std::max(reports.longest_gap, state.age);
            reports.age_sum += state.age;
            ++reports.samples_in_use;
        }
        if ((state.flags & KERF_DEVICE_VALID) == 0) continue;
        reports.was_valid = true;
        reports.buttons |= state.buttons;
        reports.all.add(channels);
        recent.add(channels);
        if (++recent_count < window) continue;
        if (recent.width() < reports.calmest_width) {
            reports.calmest = recent;
            reports.calmest_width = recent.width();
        }
        recent = {};
        recent_count = 0;
    }
    return reports;
}

/// Returns a range as a bar on a scale from -`scale` to `scale`.
std::string bar(double low, double high, double scale) {
    constexpr int width = 61;
    const auto column = [=](double x) {
        return static_cast<int>(std::lround((std::clamp(x, -scale, scale) / scale + 1.0) * 0.5 * (width - 1)));
    };
    std::string text(width, '.');
    text[width / 2] = '|';
    for (int i = column(low); i <= column(high); ++i) text[static_cast<std::size_t>(i)] = '#';
    return text;
}

std::string facts_line(const run::OpenedDevice& device, const Sense& sense) {
    const kerf_device_facts& facts = device.facts();
    const std::string senses =
        std::string(sense.what) + ((facts.abilities & KERF_DEVICE_ROTATION) != 0 ? " and rotation" : "");
    const std::string buttons = std::to_string(facts.button_count) + (facts.button_count == 1 ? " button" : " buttons");
    if (device.record() == nullptr) return "  states: no force, " + buttons + "; senses " + senses + "\n";
    return formatted("  states: %.1f N at the peak, %.1f N continuous, up to %.2f N/mm, ", facts.peak_force,
                     facts.continuous_force, 1e-3 * facts.largest_stiffness) +
           buttons + "; senses " + senses + "\n";
}

std::string rate_lines(const Reports& reports, const Sense& sense) {
    if (reports.seconds_in_use <= 0.0) return "";
    const double rate = static_cast<double>(reports.count_in_use) / reports.seconds_in_use;
    const double gap = 1e3 * reports.longest_gap;
    const std::string age = formatted("  a tick reads a report that is %.1f ms old on average\n",
                                      1e3 * reports.age_sum / static_cast<double>(reports.samples_in_use));
    if (&sense == &position)
        return formatted("  %.0f poses a second, the longest silence %.1f ms%s\n", rate, gap,
                         reports.longest_gap > 20e-3 ? ": a run fades the force after 20 ms" : "") +
               age;
    return formatted("  %.0f reports a second while deflected, the longest silence %.1f ms%s\n", rate, gap,
                     reports.longest_gap > 90e-3 ? ": a deflection counts as rest after 100 ms" : "") +
           age;
}

void print_channels(const Reports& reports, const Sense& sense) {
    const auto printed = [&](double value) { return value / sense.per_unit; };
    print(formatted("  range, from %.0f to %.0f %s:\n", -printed(sense.scale), printed(sense.scale), sense.unit));
    for (std::size_t i = 0; i < sense.count; ++i) {
        const double low = reports.all.low[i], high = reports.all.high[i];
        print("    " + std::string(sense.axes[i]) + " " + bar(low, high, sense.scale) +
              formatted("  %.*f to %.*f\n", sense.digits, printed(low), sense.digits, printed(high)));
    }
    if (&sense == &position)
        print(formatted("  for the station: workspace: {from: %.0f %.0f %.0f mm, to: %.0f %.0f %.0f mm}\n",
                        printed(reports.all.low[0]), printed(reports.all.low[1]), printed(reports.all.low[2]),
                        printed(reports.all.high[0]), printed(reports.all.high[1]), printed(reports.all.high[2])));
    if (!std::isfinite(reports.calmest_width)) return;
    if (&sense == &position)
        print(formatted("  at rest it stays within %.3f mm\n", printed(reports.calmest_width)));
    else
        print(formatted("  at rest it shows at most %.3f of the full deflection; the `dead_zone` must not be less\n",
                        reports.calmest.size()));
}

std::string pressed_buttons(const Reports& reports, std::uint32_t count) {
    std::string pressed;
    for (std::uint32_t i = 0; i < count; ++i)
        if ((reports.buttons >> i & 1u) != 0) pressed += (pressed.empty() ? "" : ", ") + std::to_string(i);
    return pressed.empty() ? "none" : pressed;
}

}  // namespace

ExitCode test_device(const DeviceTest& test, const PluginRegistry& plugins) {
    if (test.id.empty())
        return complain("which device? Write `kerf devices test ID`; `kerf devices` shows them.", exit_bad_input);
    const Interruption interruption;
    OwnDevice own;
    if (const ExitCode code = open_own_device(test.id, plugins, interruption, own); code != exit_pass) return code;
    run::OpenedDevice& device = *own.opened;
    const Sense& sense = sense_of(device.facts());
    if (!test.record.empty() && &sense != &position)
        return complain("the device senses " + std::string(sense.what) +
                            ", not the position of a handle. Leave out `--record`, or measure another device.",
                        exit_bad_input);
    std::optional<MotionRecorder> recorder;
    if (!test.record.empty()) recorder.emplace(test.seconds);
    print(device.name() + "\n" + facts_line(device, sense));
    const double weight = own.station.handle.weight();
    print_error(sense.count == 0 ? "kerf: press each button\n"
                                 : "kerf: move the handle to all ends, press each button, then hold still; " +
                                       (weight > 0.0 ? formatted("the device carries %.2f N\n", weight)
                                                     : std::string("no force is made\n")));
    const Reports reports = watch_reports(device, sense, test.seconds, recorder ? &*recorder : nullptr, interruption);
    const bool must_send = &sense == &position;
    const std::string problem = device.problem();
    if (!reports.was_valid || (must_send && reports.count == 0))
        return complain("the device sent no pose in " + formatted("%.0f s", reports.seconds) +
                            (problem.empty() ? "." : ": " + problem),
                        exit_not_passed);
    if (!problem.empty()) print_error("kerf: " + problem + "\n");
    print(rate_lines(reports, sense));
    if (sense.count > 0) print_channels(reports, sense);
    print("  buttons pressed: " + pressed_buttons(reports, device.facts().button_count) + "\n");
    if (recorder) {
        if (const std::string error = recorder->write(test.record); !error.empty())
            return complain(error, exit_bad_input);
        print("  motion: " + test.record + "\n");
    }
    return interruption.has_come() ? complain("interrupted", exit_fault) : exit_pass;
}

}  // namespace kerf::app
