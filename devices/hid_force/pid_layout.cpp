// SPDX-License-Identifier: Apache-2.0
#include "pid_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace kerf::hid_force {

namespace {

using hid::ReportDescriptor;
using hid::ReportField;
using hid::ReportKind;
using hid::Usage;
using hid::usage_of;

constexpr Usage pid(std::uint16_t id) noexcept { return usage_of(0x0f, id); }

constexpr Usage set_effect_report = pid(0x21), block_index = pid(0x22), constant_force = pid(0x26);
constexpr Usage duration = pid(0x50), effect_gain = pid(0x52), axes_enable = pid(0x55), direction_enable = pid(0x56),
                direction = pid(0x57);
constexpr Usage magnitude = pid(0x70), constant_force_report = pid(0x73);
constexpr Usage operation_report = pid(0x77), start = pid(0x79), stop = pid(0x7b), loop_count = pid(0x7c);
constexpr Usage device_gain_report = pid(0x7d), device_gain = pid(0x7e);
constexpr Usage block_load_report = pid(0x89), load_success = pid(0x8c), load_full = pid(0x8d), load_error = pid(0x8e);
constexpr Usage block_free_report = pid(0x90), state_report = pid(0x92), control_report = pid(0x95),
                control = pid(0x96);
constexpr Usage enable_actuators = pid(0x97), stop_all_effects = pid(0x99), device_reset = pid(0x9a);
constexpr Usage device_paused = pid(0x9f), actuators_enabled = pid(0xa0), safety_switch = pid(0xa4),
                actuator_power = pid(0xa6);
constexpr Usage create_report = pid(0xab);
constexpr Usage axis_x = usage_of(0x01, 0x30), dial = usage_of(0x01, 0x37), wheel = usage_of(0x01, 0x38),
                steering = usage_of(0x02, 0xc8);

constexpr double max_duration = 1.0;  // [s] for which a force may outlast its program

/// Returns whether each element is one bit of its own. Its range counts for nothing: OpenFFBoard states 1 to 6 for the
/// bits of its device control, and 0 to 0 for those of a single axis.
bool is_flags(const ReportField& field) noexcept { return field.is_variable && field.bit_size == 1; }

bool fits(const ReportField& field) noexcept {
    if (is_flags(field)) return true;
    if (field.bit_size > 32 || field.logical_min >= field.logical_max) return false;
    const std::int64_t span = std::int64_t{1} << field.bit_size;
    if (field.logical_min < 0) return field.logical_min >= -span / 2 && field.logical_max < span / 2;
    return field.logical_max < span;
}

Spot spot_of(const ReportField& field, std::size_t element) noexcept {
    constexpr std::uint32_t id_bits = 8;
    return {.bit = id_bits + field.bit_offset + static_cast<std::uint32_t>(element) * field.bit_size,
            .bits = field.bit_size,
            .min = is_flags(field) ? 0 : field.logical_min,
            .max = is_flags(field) ? 1 : field.logical_max};
}

/// Returns the time of one count [s]; nothing if the field counts no time.
std::optional<double> time_of_count(const ReportField& field) noexcept {
    constexpr std::uint32_t time_mask = 0xf000, time_once = 0x1000, other_dimensions = 0xffff0ff0;
    constexpr int min_exponent = -9, max_exponent = 0;
    if (field.unit == 0 && field.unit_exponent == 0) return 1e-3;
    if (field.unit != 0 && ((field.unit & time_mask) != time_once || (field.unit & other_dimensions) != 0))
        return std::nullopt;
    if (field.unit_exponent < min_exponent || field.unit_exponent > max_exponent) return std::nullopt;
    double scale = std::pow(10.0, field.unit_exponent);
    if (field.physical_max > field.physical_min)
        scale *= static_cast<double>(field.physical_max - field.physical_min) /
                 static_cast<double>(field.logical_max - field.logical_min);
    return scale;
}

/// Searches the fields of reports. The first one that is missing or wrong is the problem.
class Finder {
public:
    explicit Finder(const ReportDescriptor& descriptor) : descriptor_(descriptor) {}

    [[nodiscard]] std::string take_problem() noexcept { return std::move(problem_); }
    [[nodiscard]] bool has_failed() const noexcept { return !problem_.empty(); }

    void refuse(const std::string& name, const std::string& what) {
        if (problem_.empty()) problem_ = "its field `" + name + "` " + what;
    }

    /// Returns the report of a collection, found by one of its fields.
    Message message(Usage report, const char* name, bool is_input = false, bool is_optional = false) {
        for (const ReportField& field : descriptor_.fields) {
            if (field.is_constant || (field.kind == ReportKind::input) != is_input ||
                !descriptor_.is_within(field, report))
                continue;
            return sized({.kind = field.kind, .id = field.report_id, .size = 0}, name);
        }
        if (!is_optional) refuse(name, "is missing");
        return {};
    }
    Message sized(Message message, const char* name) {
        message.size = descriptor_.size_of(message.kind, message.id);
        if (message.size > max_report) refuse(name, "is in a report of more than 64 bytes");
        return message;
    }

    /// Returns the element with a usage in a report; none if the report lacks it.
    Spot value(const Message& message, Usage usage, const char* name, bool is_optional = false) {
        const ReportField* field = field_of(message, usage, name);
        if (field == nullptr || !field->is_variable) {
            if (!is_optional) refuse(name, "is missing");
            return {};
        }
        return spot_of(*field, static_cast<std::size_t>(field->index_of(usage)));
    }
    /// Returns the number or the bit that a usage has in a report.
    Choice choice(const Message& message, Usage usage, const char* name, bool is_optional = false) {
        const ReportField* field = field_of(message, usage, name);
        if (field == nullptr) {
            if (!is_optional) refuse(name, "is missing");
            return {};
        }
        const std::int64_t index = field->index_of(usage);
        if (field->is_variable) return {.spot = spot_of(*field, static_cast<std::size_t>(index)), .value = 1};
        if (field->logical_min + index > field->logical_max) refuse(name, "is beyond the range of its list");
        return {.spot = spot_of(*field, 0), .value = field->logical_min + index};
    }

    /// Returns the field with a usage in a report; null if there is none.
    const ReportField* field_of(const Message& message, Usage usage, const char* name) {
        for (const ReportField& field : descriptor_.fields) {
            if (field.is_constant || field.kind != message.kind || field.report_id != message.id) continue;
            const std::int64_t index = field.index_of(usage);
            if (index < 0 || (field.is_variable && index >= std::int64_t{field.count})) continue;
            return checked(field, name);
        }
        return nullptr;
    }
    /// Returns the first field in a collection of a report; null if there is none.
    const ReportField* first_in(const Message& message, Usage collection, const char* name) {
        for (const ReportField& field : descriptor_.fields)
            if (!field.is_constant && field.is_variable && field.kind == message.kind &&
                field.report_id == message.id && descriptor_.is_within(field, collection))
                return checked(field, name);
        return nullptr;
    }

private:
    const ReportField* checked(const ReportField& field, const char* name) {
        if (!fits(field))
            refuse(name, "has the range " + std::to_string(field.logical_min) + " to " +
                             std::to_string(field.logical_max) + ", which its " + std::to_string(field.bit_size) +
                             " bits cannot have");
        return &field;
    }

    const ReportDescriptor& descriptor_;
    std::string problem_;
};

void find_allocation(Finder& find, PidLayout& to) {
    to.create.message = find.message(create_report, "create new effect");
    to.create.constant_force = find.choice(to.create.message, constant_force, "constant force of create new effect");
    to.load.message = find.message(block_load_report, "block load");
    if (to.load.message.exists() && to.load.message.kind != ReportKind::feature)
        find.refuse("block load", "is in no feature report");
    to.load.block = find.value(to.load.message, block_index, "effect block index of block load");
    to.load.success = find.choice(to.load.message, load_success, "success of block load");
    to.load.full = find.choice(to.load.message, load_full, "full of block load", true);
    to.load.error = find.choice(to.load.message, load_error, "error of block load", true);
    to.free.message = find.message(block_free_report, "block free", false, true);
    if (to.free.message.exists())
        to.free.block = find.value(to.free.message, block_index, "effect block index of block free");
}

void find_duration(Finder& find, PidLayout& to) {
    constexpr const char* name = "duration";
    to.effect.duration = find.value(to.effect.message, duration, name);
    const ReportField* field = find.field_of(to.effect.message, duration, name);
    if (find.has_failed() || field == nullptr) return;
    const std::optional<double> count = time_of_count(*field);
    if (!count || *count <= 0.0) return find.refuse(name, "has no unit of time");
    const double counts = std::max(1.0, std::ceil(effect_duration / *count - 1e-9));
    if (counts * *count > max_duration)
        return find.refuse(name, "counts in steps of " + std::to_string(*count) + " s, need at most " +
                                     std::to_string(max_duration) + " s: a force would outlast the end of its program");
    const std::int64_t infinite = (std::int64_t{1} << field->bit_size) - 1;
    if (counts < static_cast<double>(field->logical_min) || counts > static_cast<double>(field->logical_max) ||
        counts >= static_cast<double>(infinite))
        return find.refuse(name, "cannot be 0.1 s: its range is " + std::to_string(field->logical_min) + " to " +
                                     std::to_string(field->logical_max));
    to.effect.duration_counts = static_cast<std::int64_t>(counts);
    to.effect.duration_time = counts * *count;
}

void find_effect(Finder& find, PidLayout& to) {
    to.effect.message = find.message(set_effect_report, "set effect");
    to.effect.block = find.value(to.effect.message, block_index, "effect block index of set effect");
    to.effect.constant_force = find.choice(to.effect.message, constant_force, "constant force of set effect");
    find_duration(find, to);
    to.effect.gain = find.value(to.effect.message, effect_gain, "gain of set effect", true);
    to.effect.direction_enable = find.value(to.effect.message, direction_enable, "direction enable", true);
    if (const ReportField* field = find.first_in(to.effect.message, axes_enable, "axes enable"))
        to.effect.axis_enable = spot_of(*field, 0);
    if (const ReportField* field = find.first_in(to.effect.message, direction, "direction"))
        to.effect.direction = spot_of(*field, 0);
    else
        to.effect.direction = find.value(to.effect.message, direction, "direction", true);
}

void find_force(Finder& find, PidLayout& to) {
    to.force.message = find.message(constant_force_report, "set constant force");
    to.force.block = find.value(to.force.message, block_index, "effect block index of set constant force");
    to.force.magnitude = find.value(to.force.message, magnitude, "magnitude");
    const Spot& spot = to.force.magnitude;
    if (spot.exists() && (spot.min >= 0 || spot.max <= 0))
        find.refuse("magnitude", "has the range " + std::to_string(spot.min) + " to " + std::to_string(spot.max) +
                                     ", need both signs");
    to.operation.message = find.message(operation_report, "effect operation");
    to.operation.block = find.value(to.operation.message, block_index, "effect block index of effect operation");
    to.operation.start = find.choice(to.operation.message, start, "start of effect operation");
    to.operation.stop = find.choice(to.operation.message, stop, "stop of effect operation");
    to.operation.loops = find.value(to.operation.message, loop_count, "loop count", true);
}

void find_device(Finder& find, PidLayout& to) {
    // The class puts the list of device controls into a collection of the report. Some devices lack the outer one.
    to.control.message = find.message(control_report, "device control", false, true);
    if (!to.control.message.exists()) to.control.message = find.message(control, "device control");
    to.control.enable = find.choice(to.control.message, enable_actuators, "enable actuators of device control");
    to.control.stop_all = find.choice(to.control.message, stop_all_effects, "stop all effects of device control");
    to.control.reset = find.choice(to.control.message, device_reset, "device reset of device control", true);
    to.gain.message = find.message(device_gain_report, "device gain", false, true);
    if (to.gain.message.exists()) to.gain.gain = find.value(to.gain.message, device_gain, "device gain");
    to.state.message = find.message(state_report, "PID state", true, true);
    if (!to.state.message.exists()) return;
    to.state.paused = find.value(to.state.message, device_paused, "device paused", true);
    to.state.enabled = find.value(to.state.message, actuators_enabled, "actuators enabled", true);
    to.state.safety = find.value(to.state.message, safety_switch, "safety switch", true);
    to.state.power = find.value(to.state.message, actuator_power, "actuator power", true);
}

/// The axis is the one that the axes enable names first, or else the first of the usual ones.
void find_axis(const ReportDescriptor& descriptor, Finder& find, PidLayout& to) {
    std::array<Usage, 5> wanted{0, steering, axis_x, wheel, dial};
    if (const ReportField* field = find.first_in(to.effect.message, axes_enable, "axes enable"))
        wanted[0] = field->usage_at(0);
    for (const Usage usage : wanted) {
        if (usage == 0) continue;
        for (const ReportField& field : descriptor.fields) {
            if (field.kind != ReportKind::input || field.is_constant || !field.is_variable || field.is_relative)
                continue;
            const std::int64_t index = field.index_of(usage);
            if (index < 0 || index >= std::int64_t{field.count}) continue;
            to.axis.message = find.sized({.kind = field.kind, .id = field.report_id, .size = 0}, "axis");
            to.axis.value = spot_of(field, static_cast<std::size_t>(index));
            if (!fits(field) || to.axis.value.max - to.axis.value.min < 15)
                find.refuse("axis", "has the range " + std::to_string(field.logical_min) + " to " +
                                        std::to_string(field.logical_max) + " in " + std::to_string(field.bit_size) +
                                        " bits, need 16 steps or more");
            return;
        }
    }
    find.refuse("axis", "is missing: it reports no absolute X, steering, wheel or dial");
}

}  // namespace

bool has_force(const ReportDescriptor& descriptor) noexcept { return descriptor.has_collection(set_effect_report); }

FoundLayout find_layout(const ReportDescriptor& descriptor) {
    FoundLayout found;
    Finder find(descriptor);
    if (!descriptor.has_ids) find.refuse("report id", "is missing");
    find_allocation(find, found.layout);
    find_effect(find, found.layout);
    find_force(find, found.layout);
    find_device(find, found.layout);
    find_axis(descriptor, find, found.layout);
    found.problem = find.take_problem();
    if (!found.problem.empty()) found.layout = {};
    return found;
}

}  // namespace kerf::hid_force
