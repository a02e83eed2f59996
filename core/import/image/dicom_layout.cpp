// SPDX-License-Identifier: Apache-2.0
#include "core/import/image/dicom_layout.h"

#include <array>
#include <cstring>
#include <fstream>

namespace kerf {
namespace {

constexpr std::uint64_t preamble = 128;          // [bytes]
constexpr std::uint32_t undefined = 0xffffffff;  // a length that the end is marked for
constexpr int most_nested = 16;
constexpr int most_elements = 100'000;
constexpr std::uint32_t item = 0xfffee000, item_end = 0xfffee00d, sequence_end = 0xfffee0dd;
constexpr std::uint32_t transfer_syntax = 0x00020010, pixel_data = 0x7fe00010;

struct Fault {
    std::string what;
};

/// The file as bytes that must be there.
class Bytes {
public:
    explicit Bytes(const std::string& file) : in_(file, std::ios::binary) {
        in_.seekg(0, std::ios::end);
        const auto end = in_.tellg();
        size_ = in_ && end > 0 ? static_cast<std::uint64_t>(end) : 0;
        in_.seekg(0);
    }
    [[nodiscard]] std::uint64_t left() const { return size_ - at_; }

    template <std::size_t N>
    std::array<unsigned char, N> take() {
        if (left() < N) throw Fault{"it ends in the middle of an element"};
        std::array<unsigned char, N> bytes{};
        in_.read(reinterpret_cast<char*>(bytes.data()), N);
        if (!in_) throw Fault{"it cannot be read to its end"};
        at_ += N;
        return bytes;
    }
    /// The next bytes, which stay where they are.
    template <std::size_t N>
    std::array<unsigned char, N> peek() {
        const std::uint64_t here = at_;
        const auto bytes = take<N>();
        at_ = here;
        in_.seekg(static_cast<std::streamoff>(at_));
        return bytes;
    }
    std::string text(std::uint64_t length) {
        std::string value(length, '\0');
        in_.read(value.data(), static_cast<std::streamsize>(length));
        at_ += length;
        while (!value.empty() && (value.back() == '\0' || value.back() == ' ')) value.pop_back();
        return value;
    }
    void skip(std::uint64_t length) {
        if (length > left())
            throw Fault{"an element promises " + std::to_string(length) + " bytes, " + std::to_string(left()) +
                        " are left"};
        at_ += length;
        in_.seekg(static_cast<std::streamoff>(at_));
    }

private:
    std::ifstream in_;
    std::uint64_t size_ = 0, at_ = 0;
};

/// How numbers are written, and whether an element says of which sort it is.
struct Encoding {
    bool is_big = false, is_explicit = true;
};

std::uint32_t number(const unsigned char* bytes, int count, bool is_big) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value |= std::uint32_t{bytes[i]} << (8 * (is_big ? count - 1 - i : i));
    return value;
}

struct Element {
    std::uint32_t tag = 0, length = 0;
    bool is_unknown = false;  ///< sort UN: if its length is undefined, it is implicit inside
};

Element next_element(Bytes& bytes, Encoding encoding) {
    const auto head = bytes.take<8>();
    Element e;
    e.tag = number(head.data(), 2, encoding.is_big) << 16 | number(head.data() + 2, 2, encoding.is_big);
    if (!encoding.is_explicit || e.tag >> 16 == 0xfffe) {
        e.length = number(head.data() + 4, 4, encoding.is_big);
        return e;
    }
    const std::array<char, 2> sort{static_cast<char>(head[4]), static_cast<char>(head[5])};
    e.is_unknown = sort[0] == 'U' && sort[1] == 'N';
    static constexpr std::array<const char*, 13> long_ones{"OB", "OW", "OF", "OD", "OL", "OV", "SQ",
                                                           "UN", "UC", "UR", "UT", "SV", "UV"};
    for (const char* one : long_ones)
        if (std::memcmp(one, sort.data(), 2) == 0) {
            e.length = number(bytes.take<4>().data(), 4, encoding.is_big);
            return e;
        }
    e.length = number(head.data() + 6, 2, encoding.is_big);
    return e;
}

/// Elements up to `end`, or up to the mark of an item's or a sequence's end.
class Walk {
public:
    Walk(Bytes& bytes, DicomLayout& layout) : bytes_(bytes), layout_(layout) {}

    void dataset(Encoding encoding) {
        std::uint32_t last = 0;
        while (bytes_.left() > 0) {
            const Element e = counted(encoding);
            if (e.tag <= last && e.tag != 0) throw Fault{"its elements are out of order"};
            last = e.tag;
            if (e.tag == pixel_data) return voxels(e, encoding);
            value(e, encoding, 0);
        }
    }

private:
    Element counted(Encoding encoding) {
        if (++elements_ > most_elements) throw Fault{"it has more than 100000 elements"};
        return next_element(bytes_, encoding);
    }

    void value(const Element& e, Encoding encoding, int depth) {
        if (e.length != undefined) return bytes_.skip(e.length);
        if (depth >= most_nested) throw Fault{"its sequences are nested more than 16 deep"};
        if (e.is_unknown) encoding = {.is_big = false, .is_explicit = false};
        while (true) {
            const Element one = counted(encoding);
            if (one.tag == sequence_end) return;
            if (one.tag != item) throw Fault{"a sequence holds something that is no item"};
            if (one.length != undefined) {
                bytes_.skip(one.length);
                continue;
            }
            for (Element inner = counted(encoding); inner.tag != item_end; inner = counted(encoding))
                value(inner, encoding, depth + 1);
        }
    }

    void voxels(const Element& e, Encoding encoding) {
        layout_.has_voxels = true;
        layout_.is_encapsulated = e.length == undefined;
        if (!layout_.is_encapsulated) {
            layout_.voxel_bytes = e.length;
            return bytes_.skip(e.length);
        }
        for (Element fragment = counted(encoding); fragment.tag != sequence_end; fragment = counted(encoding)) {
            if (fragment.tag != item || fragment.length == undefined)
                throw Fault{"its compressed voxels are not in fragments"};
            layout_.voxel_bytes += fragment.length;
            bytes_.skip(fragment.length);
        }
    }

    Bytes& bytes_;
    DicomLayout& layout_;
    int elements_ = 0;
};

/// The elements of group 2, which are always little and explicit.
std::string transfer_syntax_of(Bytes& bytes) {
    std::string syntax;
    while (bytes.left() >= 8 && number(bytes.peek<2>().data(), 2, false) == 2) {
        const Element e = next_element(bytes, {});
        if (e.length == undefined) throw Fault{"its first group has no length"};
        if (e.length > bytes.left() || e.tag != transfer_syntax || e.length > 64)
            bytes.skip(e.length);
        else
            syntax = bytes.text(e.length);
    }
    return syntax;
}

}  // namespace

DicomLayout dicom_layout(const std::string& file) {
    DicomLayout layout;
    try {
        Bytes bytes(file);
        if (bytes.left() < preamble + 4) return layout;
        bytes.skip(preamble);
        const auto word = bytes.take<4>();
        if (std::memcmp(word.data(), "DICM", 4) != 0) return layout;
        layout.is_dicom = true;
        layout.encoding = transfer_syntax_of(bytes);
        if (layout.encoding.empty()) throw Fault{"it does not say how it is encoded"};
        constexpr const char *implicit = "1.2.840.10008.1.2", *big = "1.2.840.10008.1.2.2",
                             *deflated = "1.2.840.10008.1.2.1.99";
        if (layout.encoding == deflated) {
            layout.has_voxels = true;  // somewhere in there
            return layout;
        }
        Walk(bytes, layout).dataset({.is_big = layout.encoding == big, .is_explicit = layout.encoding != implicit});
    } catch (const Fault& fault) {
        layout.fault = fault.what;
    } catch (const std::exception&) {
        layout.fault = "it cannot be read";
    }
    return layout;
}

}  // namespace kerf
