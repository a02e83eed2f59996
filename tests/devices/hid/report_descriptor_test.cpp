// SPDX-License-Identifier: Apache-2.0
#include "devices/hid/report_descriptor.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/devices/hid_force/descriptor_items.h"
#include "tests/devices/hid_force/pid_firmware.h"

namespace kerf::hid {
namespace {

using Items = test::DescriptorItems;

ReportDescriptor sound(const Items& items) {
    ParsedDescriptor parsed = parse_descriptor(items.bytes());
    EXPECT_EQ(parsed.problem, "");
    return parsed.descriptor;
}
std::string problem_of(const Items& items) { return parse_descriptor(items.bytes()).problem; }

TEST(ReportDescriptor, CountsTheBitsOfEachReport) {
    Items items;
    items.page(1).application(4).id(7).usages({0x30, 0x31}).logical(-100, 100).input(12, 2);
    items.usage(0x32).logical(0, 1).output(1, 1).id(8).usage(0x33).input(4, 1).id(7).usage(0x34).input(3, 1).end();
    const ReportDescriptor found = sound(items);
    ASSERT_EQ(found.fields.size(), 4u);
    EXPECT_EQ(found.fields[0].bit_offset, 0u);
    EXPECT_EQ(found.fields[1].kind, ReportKind::output);
    EXPECT_EQ(found.fields[1].bit_offset, 0u) << "an output report has bits of its own";
    EXPECT_EQ(found.fields[2].report_id, 8);
    EXPECT_EQ(found.fields[2].bit_offset, 0u);
    EXPECT_EQ(found.fields[3].bit_offset, 24u) << "report 7 goes on";
    EXPECT_EQ(found.size_of(ReportKind::input, 7), 5u) << "27 bits and the id";
    EXPECT_EQ(found.size_of(ReportKind::input, 9), 0u);
    EXPECT_EQ(found.fields[0].usage_at(1), usage_of(1, 0x31));
    EXPECT_EQ(found.fields[0].index_of(usage_of(1, 0x31)), 1);
    EXPECT_EQ(found.fields[0].index_of(usage_of(2, 0x31)), -1);
}

TEST(ReportDescriptor, ReadsAMaximumByTheSignOfItsMinimum) {
    Items items;
    items.page(1).application(4).usage(0x30).raw({0x15, 0x00, 0x25, 0xff}).input(8, 1);
    items.usage(0x31).raw({0x15, 0x81, 0x25, 0x7f}).input(8, 1).end();
    const ReportDescriptor found = sound(items);
    EXPECT_EQ(found.fields[0].logical_max, 255);
    EXPECT_EQ(found.fields[1].logical_min, -127);
    EXPECT_EQ(found.fields[1].logical_max, 127);
    EXPECT_FALSE(found.has_ids);
    EXPECT_EQ(found.size_of(ReportKind::input, 0), 2u) << "no byte of an id";
}

TEST(ReportDescriptor, ReadsExponentsAsNibbleAndAsByte) {
    Items items;
    items.page(1).application(4).usage(0x30).raw({0x55, 0x0d}).input(8, 1);
    items.usage(0x31).raw({0x55, 0xfd}).input(8, 1).usage(0x32).raw({0x55, 0x02}).input(8, 1).end();
    const ReportDescriptor found = sound(items);
    EXPECT_EQ(found.fields[0].unit_exponent, -3);
    EXPECT_EQ(found.fields[1].unit_exponent, -3);
    EXPECT_EQ(found.fields[2].unit_exponent, 2);
}

TEST(ReportDescriptor, RestoresWhatWasPushed) {
    Items items;
    items.page(1).application(4).logical(0, 10).raw({0xa4}).logical(0, 20).usage(0x30).input(8, 1);
    items.raw({0xb4}).usage(0x31).input(8, 1).end();
    const ReportDescriptor found = sound(items);
    EXPECT_EQ(found.fields[0].logical_max, 20);
    EXPECT_EQ(found.fields[1].logical_max, 10);
}

TEST(ReportDescriptor, ReadsUsagesWithTheirOwnPageAndAlternatives) {
    Items items;
    items.page(1).application(4).raw({0x0b, 0x70, 0x00, 0x0f, 0x00}).logical(0, 1).input(1, 1);
    items.raw({0xa9, 0x01}).usage(0x30).usage(0x31).raw({0xa9, 0x00}).usage(0x32).input(1, 2).end();
    const ReportDescriptor found = sound(items);
    EXPECT_EQ(found.fields[0].usage_at(0), usage_of(0x0f, 0x70));
    EXPECT_EQ(found.fields[1].usage_at(0), usage_of(1, 0x30));
    EXPECT_EQ(found.fields[1].usage_at(1), usage_of(1, 0x32)) << "0x31 was an alternative";
}

TEST(ReportDescriptor, KnowsTheCollectionsAroundAField) {
    Items items;
    items.page(1).application(4).page(0x0f).begin(0x21).usage(0x22).logical(1, 40).output(8, 1).end();
    items.usage(0x70).output(8, 1).end();
    const ReportDescriptor found = sound(items);
    EXPECT_TRUE(found.is_within(found.fields[0], usage_of(0x0f, 0x21)));
    EXPECT_TRUE(found.is_within(found.fields[0], usage_of(1, 4)));
    EXPECT_FALSE(found.is_within(found.fields[1], usage_of(0x0f, 0x21)));
}

TEST(ReportDescriptor, RefusesUnsoundOnes) {
    const auto begun = [] {
        Items items;
        items.page(1).application(4).usage(0x30).logical(0, 1);
        return items;
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    EXPECT_TRUE(has(problem_of(Items()), "empty"));
    EXPECT_TRUE(has(problem_of(begun()), "no end"));
    EXPECT_TRUE(has(problem_of(begun().end().end()), "has not begun"));
    EXPECT_TRUE(has(problem_of(begun().input(8, 1025).end()), "1024 bytes"));
    EXPECT_TRUE(has(problem_of(begun().input(0xffffffff, 0xffffffff).end()), "1024 bytes"));
    EXPECT_TRUE(has(problem_of(begun().input(33, 1).end()), "32 bits"));
    EXPECT_TRUE(has(problem_of(begun().id(0).end()), "report id"));
    EXPECT_TRUE(has(problem_of(begun().input(8, 1).id(3).end()), "no id"));
    EXPECT_TRUE(has(problem_of(begun().raw({0xb4}).end()), "pops"));
    EXPECT_TRUE(has(problem_of(begun().raw({0x26, 0xff})), "cut"));
    EXPECT_TRUE(has(problem_of(begun().raw({0xfe, 0x09, 0x00})), "cut")) << "a long item";
    EXPECT_TRUE(has(problem_of(begun().item(0x28, 5).end()), "no beginning"));
    EXPECT_TRUE(has(problem_of(begun().usages_between(5, 4).end()), "before it begins"));
    Items deep;
    for (int i = 0; i < 100; ++i) deep.begin(1);
    EXPECT_TRUE(has(problem_of(deep), "too many collections"));
    Items big;
    for (int i = 0; i < 2000; ++i) big.raw({0x05, 0x01, 0x09});
    EXPECT_TRUE(has(problem_of(big), "4096"));
}

TEST(ReportDescriptor, SkipsLongItems) {
    Items items;
    items.page(1).application(4).raw({0xfe, 0x02, 0x10, 0xaa, 0xbb}).usage(0x30).logical(0, 1).input(8, 1).end();
    EXPECT_EQ(sound(items).fields.size(), 1u);
}

TEST(ReportDescriptor, RefusesADescriptorCutAnywhere) {
    constexpr std::size_t before_collection = 4;  // [bytes] that are items without a field
    const std::vector<std::uint8_t> all = test::open_ffboard().descriptor;
    EXPECT_EQ(parse_descriptor(all).problem, "");
    for (std::size_t size = before_collection + 1; size < all.size(); ++size)
        EXPECT_NE(parse_descriptor(std::span(all).first(size)).problem, "") << size;
}

}  // namespace
}  // namespace kerf::hid
