// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "devices/hid/report_descriptor.h"
#include "devices/hid_force/pid_codec.h"
#include "devices/hid_force/pid_layout.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace kerf;
using hid_force::PidLayout;
using hid_force::Report;

void check_report(const Report& report, const hid_force::Message& message) {
    fuzz::require(report.size == message.size && report.size <= hid_force::max_report, "a report has its size");
    fuzz::require(report.bytes[0] == message.id, "a report begins with its id");
    for (std::size_t i = report.size; i < report.bytes.size(); ++i)
        fuzz::require(report.bytes[i] == 0, "nothing is written beyond a report");
}

void check_layout(const PidLayout& layout, std::string_view input) {
    fuzz::require(
        layout.effect.duration_time >= hid_force::effect_duration - 1e-9 && layout.effect.duration_time <= 1.0,
        "a force ends by itself within a second");
    const std::int64_t duration = layout.effect.duration_counts;
    fuzz::require(duration >= 1 && duration <= layout.effect.duration.max, "the device can count the duration");
    for (const std::int64_t block : {std::int64_t{1}, std::int64_t{40}}) {
        check_report(effect_report(layout, block), layout.effect.message);
        check_report(operation_report(layout, block, layout.operation.start), layout.operation.message);
        for (const double fraction : {-2.0, -1.0, 0.0, 0.3, 1.0, std::nan("")})
            check_report(force_report(layout, block, fraction), layout.force.message);
        if (layout.free.message.exists()) check_report(free_report(layout, block), layout.free.message);
    }
    fuzz::require(get(force_report(layout, 1, 0.0).data(), layout.force.magnitude) == 0, "no force is zero");
    fuzz::require(get(force_report(layout, 1, 1.0).data(), layout.force.magnitude) < 0, "a force has its sign");
    check_report(create_report(layout), layout.create.message);
    check_report(control_report(layout, layout.control.enable), layout.control.message);
    if (layout.gain.message.exists()) check_report(gain_report(layout, 0.5), layout.gain.message);

    // The descriptor once more, as if it were reports
    for (std::size_t at = 0; at < input.size(); at += 16) {
        const auto text = input.substr(at, hid_force::max_report);
        const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
        const auto load = read_block_load(layout, bytes);
        if (load.status == hid_force::BlockLoad::Status::success)
            fuzz::require(load.block >= 1 && load.block <= layout.load.block.max, "a block is in its range");
        if (const auto counts = read_axis(layout, bytes))
            fuzz::require(*counts >= layout.axis.value.min && *counts <= layout.axis.value.max,
                          "counts are in their range");
        static_cast<void>(read_state(layout, bytes, is_safety_switch_closed(layout, bytes)));
    }
}

}  // namespace

bool kerf::fuzz::reads(std::string_view input) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    const hid::ParsedDescriptor parsed = hid::parse_descriptor(bytes);
    if (!parsed.problem.empty()) {
        require(parsed.descriptor.fields.empty(), "a refused descriptor has no fields");
        return false;
    }
    for (const hid::ReportField& field : parsed.descriptor.fields) {
        require(field.is_constant || (field.bit_size >= 1 && field.bit_size <= 32), "a value has 1 to 32 bits");
        require(field.bit_offset + field.bit_size * field.count <= 8 * 1024, "a report has at most 1024 bytes");
        static_cast<void>(field.usage_at(field.count));
    }
    const hid_force::FoundLayout found = hid_force::find_layout(parsed.descriptor);
    if (!found.problem.empty()) return false;
    check_layout(found.layout, input);
    return true;
}
