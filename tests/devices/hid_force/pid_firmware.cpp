// SPDX-License-Identifier: Apache-2.0
#include "tests/devices/hid_force/pid_firmware.h"

#include "tests/devices/hid_force/descriptor_items.h"

namespace kerf::test {

namespace {

using Items = DescriptorItems;
using enum hid::ReportKind;

enum class As : std::uint8_t { output, feature };

void add_types(Items& to, As as, bool has_custom) {
    to.page(0x0f).begin(0x25).usages({0x26, 0x27, 0x30, 0x31, 0x32, 0x33, 0x34, 0x40, 0x41, 0x42, 0x43});
    if (has_custom) to.usage(0x28);
    to.logical(1, has_custom ? 12 : 11);
    if (as == As::feature)
        to.feature(8, 1, Items::list);
    else
        to.output(8, 1, Items::list);
    to.end();
}

void add_block(Items& to) { to.page(0x0f).usage(0x22).logical(1, 40).output(8, 1); }

/// The reports of other effects, whose fields have names that those of a constant force have too.
void add_other_effects(Items& to, std::int32_t full) {
    to.begin(0x5a).id(0x02);
    add_block(to);
    to.usages({0x5b, 0x5d}).logical(0, full).output(16, 2);
    to.usages({0x5c, 0x5e}).unit(0x1003, -3).logical(0, 0x7fff).output(32, 2).unit(0, 0).end();
    to.begin(0x6e).id(0x04);
    add_block(to);
    to.usage(0x70).logical(0, full).output(16, 1).usage(0x6f).logical(-full, full).output(16, 1);
    to.usage(0x71).unit(0x14, -2).logical(0, 35999).output(16, 1);
    to.usage(0x72).unit(0x1003, -3).logical(0, 0x7fff).output(32, 1).unit(0, 0).end();
    to.begin(0x74).id(0x06);
    add_block(to);
    to.usages({0x75, 0x76}).logical(-full, full).output(16, 2).end();
}

void add_operation(Items& to, std::uint32_t id) {
    to.page(0x0f).begin(0x77).id(id);
    add_block(to);
    to.begin(0x78).usages({0x79, 0x7a, 0x7b}).logical(1, 3).output(8, 1, Items::list).end();
    to.usage(0x7c).logical(0, 255).output(8, 1).end();
}

void add_pool(Items& to, std::uint32_t create, std::uint32_t load, std::uint32_t pool, bool has_custom) {
    to.page(0x0f).begin(0xab).id(create);
    add_types(to, As::feature, has_custom);
    to.page(0x01).usage(0x3b).logical(0, 511).feature(10, 1).feature(6, 1, Items::constant).end();
    to.page(0x0f).begin(0x89).id(load).usage(0x22).logical(1, 40).feature(8, 1);
    to.begin(0x8b).usages({0x8c, 0x8d, 0x8e}).logical(1, 3).feature(8, 1, Items::list).end();
    to.usage(0xac).logical(0, 65535).feature(16, 1, Items::list).end();
    to.begin(0x7f).id(pool).usage(0x80).logical(0, 65535).feature(16, 1);
    to.usage(0x83).logical(0, 255).feature(8, 1).usages({0xa9, 0xaa}).logical(0, 1).feature(1, 2);
    to.feature(6, 1, Items::constant).end();
}

Items open_ffboard_items() {
    Items to;
    to.page(0x01).application(0x04).raw({0xa1, 0x00}).id(0x01);
    to.page(0x09).usages_between(1, 64).logical(0, 1).input(1, 64);
    to.page(0x01).usages({0x30, 0x31, 0x32, 0x33, 0x34, 0x35, 0x37, 0x36}).logical(-32767, 32767).input(16, 8).end();
    // Commands of the maker, declared as padding
    to.page(0xff00).application(0x00).id(0xa1).logical(0, 4);
    for (const std::uint32_t bits : {8u, 16u, 8u, 32u, 64u, 64u}) to.output(bits, 1, Items::constant);
    for (const std::uint32_t bits : {8u, 16u, 8u, 32u, 64u, 64u}) to.input(bits, 1, Items::constant);
    to.end();
    to.page(0x0f).begin(0x92).id(0x02).usages({0x9f, 0xa0, 0xa4, 0xa6, 0x94}).logical(0, 1).input(1, 5);
    to.input(1, 3, Items::constant).end();
    to.begin(0x21).id(0x01);
    add_block(to);
    add_types(to, As::output, false);
    to.usages({0x50, 0x54, 0x51, 0xa7}).logical(0, 32767).physical(0, 32767).unit(0x1003, -3).output(16, 4);
    to.unit(0, 0).usage(0x52).logical(0, 255).physical(0, 10000).output(8, 1);
    to.usage(0x53).logical(1, 8).physical(1, 8).output(8, 1);
    to.begin(0x55).page(0x01).usages({0x30, 0x31}).logical(0, 1).output(1, 2).end();
    to.page(0x0f).usage(0x56).output(1, 1).output(1, 5, Items::constant);
    to.begin(0x57).usages({0x000a0001, 0x000a0002}).logical(0, 36000).physical(0, 36000).output(16, 2).end();
    to.begin(0x58).usages({0x000a0001, 0x000a0002}).logical(0, 32765).output(16, 2).end();
    to.end();
    add_other_effects(to, 32767);
    to.begin(0x73).id(0x05);
    add_block(to);
    to.usage(0x70).logical(-32767, 32767).physical(-32767, 32767).output(16, 1).end();
    add_operation(to, 0x0a);
    to.begin(0x90).id(0x0b);
    add_block(to);
    to.end();
    // Each control is a bit, though the range is that of a list
    to.begin(0x95).id(0x0c).begin(0x96).usages({0x97, 0x98, 0x99, 0x9a, 0x9b, 0x9c}).logical(1, 6).output(1, 8);
    to.end().end();
    to.begin(0x7d).id(0x0d).usage(0x7e).logical(0, 255).physical(0, 10000).output(8, 1).end();
    add_pool(to, 0x11, 0x12, 0x13, false);
    return to.end();
}

Items two_axes_items() {
    Items to;
    to.page(0x01).application(0x04).usage(0x01).id(0x01).raw({0xa1, 0x00});
    to.page(0x09).usages_between(1, 8).logical(0, 1).input(1, 8);
    to.page(0x01).usages({0x30, 0x31}).logical(-32767, 32767).input(16, 2).end();
    to.page(0x0f).begin(0x92).id(0x02).usages({0x9f, 0xa0, 0xa4, 0xa5, 0xa6}).logical(0, 1).input(1, 5);
    to.input(1, 3, Items::constant).usage(0x94).input(1, 1).usage(0x22).logical(1, 40).input(7, 1).end();
    to.begin(0x21).id(0x01);
    add_block(to);
    add_types(to, As::output, true);
    to.usages({0x50, 0x54, 0x51}).logical(0, 32767).physical(0, 32767).unit(0x1003, -3).output(16, 3);
    to.unit(0, 0).usage(0x52).logical(0, 255).physical(0, 10000).output(8, 1);
    to.usage(0x53).logical(1, 8).physical(1, 8).output(8, 1);
    to.begin(0x55).page(0x01).usages({0x30, 0x31}).logical(0, 1).output(1, 2).end();
    to.page(0x0f).usage(0x56).output(1, 1).output(1, 5, Items::constant);
    to.begin(0x57).usages({0x000a0001, 0x000a0002}).logical(0, 255).physical(0, 36000).output(8, 2).end();
    to.begin(0x58).usages({0x000a0001, 0x000a0002}).logical(0, 32765).output(16, 2).end();
    to.end();
    add_other_effects(to, 10000);
    to.begin(0x73).id(0x05);
    add_block(to);
    to.usage(0x70).logical(-10000, 10000).physical(-10000, 10000).output(16, 1).end();
    add_operation(to, 0x0a);
    to.begin(0x90).id(0x0b);
    add_block(to);
    to.end();
    // The list of controls, without a collection of its report around it
    to.begin(0x96).id(0x0c).usages({0x97, 0x98, 0x99, 0x9a, 0x9b, 0x9c}).logical(1, 6).output(8, 1, Items::list).end();
    to.begin(0x7d).id(0x0d).usage(0x7e).logical(0, 255).physical(0, 10000).output(8, 1).end();
    add_pool(to, 0x05, 0x06, 0x07, true);
    return to.end();
}

Items sparse_knob_items() {
    Items to;
    to.page(0x02).application(0x02).id(0x07).usage(0xc8).logical(0, 0xffffff).input(24, 1);
    to.page(0x0f).begin(0x21).id(0x21).usage(0x22).logical(1, 15).output(4, 1);
    to.begin(0x25).usages({0x40, 0x26}).logical(0, 1).output(4, 1, Items::list).end();
    to.usage(0x50).logical(0, 65535).unit(0x1003, -4).output(16, 1).unit(0, 0);
    to.begin(0x55).page(0x02).usage(0xc8).logical(0, 1).output(1, 1).end().output(7, 1, Items::constant).end();
    to.page(0x0f).begin(0x73).id(0x22).usage(0x22).logical(1, 15).output(4, 1);
    to.usage(0x70).logical(-2047, 2047).output(12, 1).end();
    to.begin(0x77).id(0x23).usage(0x22).logical(1, 15).output(4, 1);
    to.begin(0x78).usages({0x7b, 0x79}).logical(0, 1).output(4, 1, Items::list).end().end();
    to.begin(0x95).id(0x24).begin(0x96).usages({0x97, 0x98, 0x99, 0x9a}).logical(0, 3).output(8, 1, Items::list);
    to.end().end();
    to.begin(0xab).id(0x25).begin(0x25).usages({0x40, 0x26}).logical(0, 1).feature(8, 1, Items::list).end().end();
    to.begin(0x89).id(0x26).usage(0x22).logical(0, 15).feature(4, 1);
    to.begin(0x8b).usages({0x8c, 0x8d, 0x8e}).logical(1, 3).feature(4, 1, Items::list).end().end();
    return to.end();
}

constexpr At byte_at(unsigned byte) { return {8 * byte, 8}; }
constexpr At word_at(unsigned byte, bool is_signed = false) { return {8 * byte, 16, is_signed}; }

}  // namespace

Firmware open_ffboard() {
    Firmware f;
    f.descriptor = open_ffboard_items().bytes();
    f.sizes = {{{input, 0x01}, 25},  {{input, 0x02}, 2},   {{output, 0x01}, 22}, {{output, 0x05}, 4},
               {{output, 0x0a}, 4},  {{output, 0x0b}, 2},  {{output, 0x0c}, 2},  {{output, 0x0d}, 2},
               {{feature, 0x11}, 4}, {{feature, 0x12}, 5}, {{feature, 0x13}, 5}};
    f.control = {
        .id = 0x0c, .is_mask = true, .enable = 0, .disable = 1, .stop_all = 2, .reset = 3, .stop_all_pauses = true};
    f.effect = {.id = 0x01,
                .block = byte_at(1),
                .type = byte_at(2),
                .duration = word_at(3),
                .gain = byte_at(11),
                .axis = {8 * 13, 1},
                .direction_enable = {8 * 13 + 2, 1},
                .direction = word_at(14),
                .constant = 1,
                .count_time = 1e-3,
                .full_circle = 36000};
    f.force = {.id = 0x05, .block = byte_at(1), .magnitude = word_at(2, true), .full = 32767};
    f.operation = {.id = 0x0a, .block = byte_at(1), .number = byte_at(2), .start = 1, .stop = 3};
    f.free = {.id = 0x0b, .block = byte_at(1)};
    f.gain = {.id = 0x0d, .value = byte_at(1), .full = 255};
    f.pool = {.create = 0x11,
              .load = 0x12,
              .type = byte_at(1),
              .block = byte_at(1),
              .status = byte_at(2),
              .success = 1,
              .full = 2};
    f.axis = {.id = 0x01, .value = word_at(9, true)};
    return f;
}

Firmware two_axes() {
    Firmware f = open_ffboard();
    f.descriptor = two_axes_items().bytes();
    f.sizes = {{{input, 0x01}, 6},   {{input, 0x02}, 3},   {{output, 0x01}, 18}, {{output, 0x05}, 4},
               {{output, 0x0a}, 4},  {{output, 0x0b}, 2},  {{output, 0x0c}, 2},  {{output, 0x0d}, 2},
               {{feature, 0x05}, 4}, {{feature, 0x06}, 5}, {{feature, 0x07}, 5}};
    f.control = {.id = 0x0c, .is_mask = false, .enable = 1, .disable = 2, .stop_all = 3, .reset = 4};
    f.effect.gain = byte_at(9);
    f.effect.axis = {8 * 11, 1};
    f.effect.direction_enable = {8 * 11 + 2, 1};
    f.effect.direction = byte_at(12);
    f.effect.full_circle = 255;
    f.force.full = 10000;
    f.gain.is_ignored = true;
    f.pool.create = 0x05;
    f.pool.load = 0x06;
    f.axis = {.id = 0x01, .value = word_at(2, true)};
    return f;
}

Firmware sparse_knob() {
    Firmware f;
    f.descriptor = sparse_knob_items().bytes();
    f.sizes = {{{input, 0x07}, 4},  {{output, 0x21}, 5},  {{output, 0x22}, 3}, {{output, 0x23}, 2},
               {{output, 0x24}, 2}, {{feature, 0x25}, 2}, {{feature, 0x26}, 2}};
    f.control = {.id = 0x24, .is_mask = false, .enable = 0, .disable = 1, .stop_all = 2, .reset = 3};
    f.effect = {.id = 0x21,
                .block = {8, 4},
                .type = {12, 4},
                .duration = word_at(2),
                .axis = {32, 1},
                .constant = 1,
                .count_time = 1e-4};
    f.force = {.id = 0x22, .block = {8, 4}, .magnitude = {12, 12, true}, .full = 2047};
    f.operation = {.id = 0x23, .block = {8, 4}, .number = {12, 4}, .start = 1, .stop = 0};
    f.pool = {
        .create = 0x25, .load = 0x26, .type = byte_at(1), .block = {8, 4}, .status = {12, 4}, .success = 1, .full = 2};
    f.axis = {.id = 0x07, .value = {8, 24}};
    return f;
}

}  // namespace kerf::test
