// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace kerf::test {

/// Writes a report descriptor item by item.
class DescriptorItems {
public:
    enum Flag : std::uint32_t { list = 0, constant = 1, variable = 2, relative = 6 };

    DescriptorItems& page(std::uint32_t value) { return item(0x04, value); }
    DescriptorItems& usage(std::uint32_t value) { return item(0x08, value); }
    DescriptorItems& usages(std::initializer_list<std::uint32_t> all) {
        for (const std::uint32_t one : all) usage(one);
        return *this;
    }
    DescriptorItems& usages_between(std::uint32_t first, std::uint32_t last) {
        return item(0x18, first).item(0x28, last);
    }
    DescriptorItems& application(std::uint32_t of) { return usage(of).item(0xa0, 1); }
    DescriptorItems& begin(std::uint32_t of) { return usage(of).item(0xa0, 2); }
    DescriptorItems& end() {
        bytes_.push_back(0xc0);
        return *this;
    }
    DescriptorItems& id(std::uint32_t value) { return item(0x84, value); }
    DescriptorItems& logical(std::int32_t min, std::int32_t max) { return number(0x14, min).number(0x24, max); }
    DescriptorItems& physical(std::int32_t min, std::int32_t max) { return number(0x34, min).number(0x44, max); }
    DescriptorItems& unit(std::uint32_t code, int exponent) {
        return item(0x64, code).item(0x54, static_cast<std::uint32_t>(exponent) & 0xfu);
    }
    DescriptorItems& input(std::uint32_t bits, std::uint32_t count, Flag flag = variable) {
        return item(0x74, bits).item(0x94, count).item(0x80, flag);
    }
    DescriptorItems& output(std::uint32_t bits, std::uint32_t count, Flag flag = variable) {
        return item(0x74, bits).item(0x94, count).item(0x90, flag);
    }
    DescriptorItems& feature(std::uint32_t bits, std::uint32_t count, Flag flag = variable) {
        return item(0x74, bits).item(0x94, count).item(0xb0, flag);
    }
    /// Writes an item with the size that its value needs.
    DescriptorItems& item(std::uint8_t prefix, std::uint32_t value) {
        return put(prefix, value, value <= 0xff ? 1 : value <= 0xffff ? 2 : 4);
    }
    DescriptorItems& raw(std::initializer_list<std::uint8_t> bytes) {
        bytes_.insert(bytes_.end(), bytes);
        return *this;
    }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }

private:
    DescriptorItems& number(std::uint8_t prefix, std::int32_t value) {
        const unsigned size = value >= -128 && value <= 127 ? 1 : value >= -32768 && value <= 32767 ? 2 : 4;
        return put(prefix, static_cast<std::uint32_t>(value), size);
    }
    DescriptorItems& put(std::uint8_t prefix, std::uint32_t value, unsigned size) {
        bytes_.push_back(static_cast<std::uint8_t>(prefix | (size == 4 ? 3u : size)));
        for (unsigned i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
        return *this;
    }
    std::vector<std::uint8_t> bytes_;
};

}  // namespace kerf::test
