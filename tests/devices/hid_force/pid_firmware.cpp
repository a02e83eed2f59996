// SPDX-License-Identifier: Apache-2.0
#include "tests/devices/hid_force/pid_firmware.h"

#include "tests/devices/hid_force/descriptor_items.h"

namespace kerf::test {

namespace {

using Items = DescriptorItems;
using enum hid::ReportKind;

void add_types(Items& to, bool is_feature) {
    to.page(0x0f).begin(0x25).usages({0x26, 0x27, 0x30, 0x31, 0x32, 0x33, 0x34, 0x40, 0x41, 0x42, 0x43});
    to.logical(1, 11);
    if (is_feature)
        to.feature(8, 1, Items::list);
    else
        to.output(8, 1, Items::list);
    to.end();
}

void add_block(Items& to, std::int32_t max = 40) { to.page(0x0f).usage(0x22).logical(1, max).output(8, 1); }

void add_operation(Items& to, std::uint32_t id) {
    to.page(0x0f).begin(0x77).id(id);
    add_block(to);
    to.begin(0x78).usages({0x79, 0x7a, 0x7b}).logical(1, 3).output(8, 1, Items::list).end();
    to.usage(0x7c).logical(0, 255).output(8, 1).end();
}

void add_pool(Items& to, std::uint32_t create, std::uint32_t load) {
    to.page(0x0f).begin(0xab).id(create);
    add_types(to, true);
    to.page(0x01).usage(0x3b).logical(0, 511).feature(10, 1).feature(6, 1, Items::constant).end();
    to.page(0x0f).begin(0x89).id(load).usage(0x22).logical(1, 40).feature(8, 1);
    to.begin(0x8b).usages({0x8c, 0x8d, 0x8e}).logical(1, 3).feature(8, 1, Items::list).end();
    to.usage(0xac).logical(0, 65535).feature(16, 1).end();
}

Items open_ffboard_items() {
    Items to;
    to.page(0x01).application(0x04).id(0x01);
    to.page(0x09).usages_between(1, 64).logical(0, 1).input(1, 64);
    to.page(0x01).usages({0x30, 0x31, 0x32, 0x33, 0x34, 0x35, 0x37, 0x36}).logical(-32767, 32767).input(16, 8);
    to.page(0x0f).begin(0x92).id(0x02).usages({0x9f, 0xa0, 0xa4, 0xa6, 0x94}).logical(0, 1).input(1, 5);
    to.input(3, 1, Items::constant).end();
    to.begin(0x21).id(0x01);
    add_block(to);
    add_types(to, false);
    to.usages({0x50, 0x54, 0x51, 0xa7}).logical(0, 32767).physical(0, 32767).unit(0x1003, -3).output(16, 4);
    to.unit(0, 0).physical(0, 10000).usage(0x52).logical(0, 255).output(8, 1);
    to.physical(0, 0).usage(0x53).logical(1, 8).output(8, 1);
    to.begin(0x55).page(0x01).usage(0x30).logical(0, 1).output(1, 1).end();
    to.page(0x0f).usage(0x56).output(1, 1).output(6, 1, Items::constant);
    to.begin(0x57).page(0x0a).usage(0x01).unit(0x14, -2).logical(0, 36000).physical(0, 36000).output(16, 1).end();
    to.page(0x0f).begin(0x58).page(0x0a).usage(0x01).unit(0, 0).logical(0, 32765).physical(0, 0).output(16, 1).end();
    to.end();
    to.page(0x0f).begin(0x73).id(0x05);
    add_block(to);
    to.usage(0x70).logical(-32767, 32767).output(16, 1).end();
    add_operation(to, 0x0a);
    to.begin(0x90).id(0x0b);
    add_block(to);
    to.end();
    to.begin(0x95).id(0x0c).begin(0x96).usages_between(0x97, 0x9c).logical(0, 1).output(1, 8).end().end();
    to.begin(0x7d).id(0x0d).usage(0x7e).logical(0, 255).output(8, 1).end();
    add_pool(to, 0x11, 0x12);
    to.begin(0x7f).id(0x13).usage(0x80).logical(0, 65535).feature(16, 1);
    to.usage(0x83).logical(0, 255).feature(8, 1).usages({0xa8, 0xa9}).logical(0, 1).feature(1, 2);
    to.feature(6, 1, Items::constant).end();
    return to.end();
}

Items two_axes_items() {
    Items to;
    to.page(0x01).application(0x04).id(0x03);
    to.page(0x09).usages_between(1, 8).logical(0, 1).input(1, 8);
    to.page(0x01).usages({0x30, 0x31}).logical(-2048, 2047).input(12, 2);
    to.page(0x0f).begin(0x21).id(0x01);
    add_block(to);
    add_types(to, false);
    to.usages({0x50, 0x54, 0x51}).logical(0, 32767).physical(0, 32767).unit(0x1003, -3).output(16, 3);
    to.unit(0, 0).physical(0, 10000).usage(0x52).logical(0, 255).output(8, 1);
    to.physical(0, 0).usage(0x53).logical(1, 8).output(8, 1);
    to.begin(0x55).page(0x01).usages({0x30, 0x31}).logical(0, 1).output(1, 2).end();
    to.page(0x0f).usage(0x56).output(1, 1).output(5, 1, Items::constant);
    to.begin(0x57).page(0x0a).usages({0x01, 0x02}).unit(0x14, 0).logical(0, 255).physical(0, 360).output(8, 2).end();
    to.unit(0, 0).physical(0, 0).end();
    to.page(0x0f).begin(0x73).id(0x05);
    add_block(to);
    to.usage(0x70).logical(-10000, 10000).output(16, 1).end();
    add_operation(to, 0x0a);
    to.begin(0x90).id(0x0b);
    add_block(to);
    to.end();
    to.begin(0x96).end();  // of another use: no report
    to.begin(0x95).id(0x0c).begin(0x96).usages({0x97, 0x98, 0x99, 0x9a, 0x9b, 0x9c}).logical(1, 6);
    to.output(8, 1, Items::list).end().end();
    to.begin(0x7d).id(0x0d).usage(0x7e).logical(0, 255).output(8, 1).end();
    add_pool(to, 0x05, 0x06);
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
    f.sizes = {{{input, 0x01}, 25},  {{input, 0x02}, 2},   {{output, 0x01}, 18}, {{output, 0x05}, 4},
               {{output, 0x0a}, 4},  {{output, 0x0b}, 2},  {{output, 0x0c}, 2},  {{output, 0x0d}, 2},
               {{feature, 0x11}, 4}, {{feature, 0x12}, 5}, {{feature, 0x13}, 5}};
    f.control = {.id = 0x0c, .is_mask = true, .enable = 0, .disable = 1, .stop_all = 2, .reset = 3};
    f.effect = {.id = 0x01,
                .block = byte_at(1),
                .type = byte_at(2),
                .duration = word_at(3),
                .gain = byte_at(11),
                .axis = {8 * 13, 1},
                .direction_enable = {8 * 13 + 1, 1},
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
    f.sizes = {{{input, 0x03}, 5},  {{output, 0x01}, 14}, {{output, 0x05}, 4},
               {{output, 0x0a}, 4}, {{output, 0x0b}, 2},  {{output, 0x0c}, 2},
               {{output, 0x0d}, 2}, {{feature, 0x05}, 4}, {{feature, 0x06}, 5}};
    f.control = {.id = 0x0c, .is_mask = false, .enable = 1, .disable = 2, .stop_all = 3, .reset = 4};
    f.effect.gain = byte_at(9);
    f.effect.axis = {8 * 11, 1};
    f.effect.direction_enable = {8 * 11 + 2, 1};
    f.effect.direction = byte_at(12);
    f.effect.full_circle = 255;
    f.force.full = 10000;
    f.pool.create = 0x05;
    f.pool.load = 0x06;
    f.axis = {.id = 0x03, .value = {16, 12, true}};
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
