// SPDX-License-Identifier: Apache-2.0
#include "bone/image/dicom_elements.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <system_error>
#include <vector>

#include "text/regular_file.h"

namespace kerf::bone {
namespace {

constexpr std::uint64_t preamble = 128;          // [bytes]
constexpr std::uint32_t undefined = 0xffffffff;  // length of an element that ends with a mark
constexpr int max_nested = 16;
constexpr int max_elements = 100'000;
constexpr std::uint32_t max_kept = 1024;  // [bytes] of a value that is stored for queries
constexpr std::uint32_t item = 0xfffee000, item_end = 0xfffee00d, sequence_end = 0xfffee0dd;
constexpr const char *implicit_little = "1.2.840.10008.1.2", *explicit_little = "1.2.840.10008.1.2.1";
constexpr std::uint32_t transfer_syntax = 0x00020010, pixel_data = 0x7fe00010;

struct Fault {
    std::string what;
};

/// The file as a stream of bytes. Reading beyond its end throws a Fault.
class Bytes {
public:
    explicit Bytes(const std::string& file) : in_(text::open_regular_file(file)) {
        in_.seekg(0, std::ios::end);
        const auto end = in_.tellg();
        size_ = in_ && end > 0 ? static_cast<std::uint64_t>(end) : 0;
        in_.seekg(0);
    }
    [[nodiscard]] std::uint64_t at() const { return at_; }
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
    /// Returns the next bytes without consuming them.
    template <std::size_t N>
    std::array<unsigned char, N> peek() {
        const std::uint64_t here = at_;
        const auto bytes = take<N>();
        at_ = here;
        in_.seekg(static_cast<std::streamoff>(at_));
        return bytes;
    }
    /// Pre: `length` is at most `max_kept`.
    std::string keep(std::uint32_t length) {
        if (length > left()) skip(length);  // throws the reason
        std::string value(length, '\0');
        in_.read(value.data(), static_cast<std::streamsize>(length));
        if (!in_) throw Fault{"it cannot be read to its end"};
        at_ += length;
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

/// Byte order of numbers, and whether elements state their type (VR).
struct Encoding {
    bool is_big = false, is_explicit = true;
};

std::uint32_t bits(const unsigned char* bytes, int count, bool is_big) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value |= std::uint32_t{bytes[i]} << (8 * (is_big ? count - 1 - i : i));
    return value;
}

struct Element {
    std::uint32_t tag = 0, length = 0;
    bool is_unknown = false;   ///< type UN: with undefined length, its contents are implicit
    bool is_sequence = false;  ///< as stated; implicit elements state no type
};

Element next_element(Bytes& bytes, Encoding encoding) {
    const auto head = bytes.take<8>();
    Element e;
    e.tag = bits(head.data(), 2, encoding.is_big) << 16 | bits(head.data() + 2, 2, encoding.is_big);
    if (!encoding.is_explicit || e.tag >> 16 == 0xfffe) {
        e.length = bits(head.data() + 4, 4, encoding.is_big);
        return e;
    }
    const std::array<char, 2> sort{static_cast<char>(head[4]), static_cast<char>(head[5])};
    e.is_unknown = sort[0] == 'U' && sort[1] == 'N';
    e.is_sequence = sort[0] == 'S' && sort[1] == 'Q';
    static constexpr std::array<const char*, 13> long_ones{"OB", "OW", "OF", "OD", "OL", "OV", "SQ",
                                                           "UN", "UC", "UR", "UT", "SV", "UV"};
    for (const char* one : long_ones)
        if (std::memcmp(one, sort.data(), 2) == 0) {
            e.length = bits(bytes.take<4>().data(), 4, encoding.is_big);
            return e;
        }
    e.length = bits(head.data() + 6, 2, encoding.is_big);
    return e;
}

/// Output of a walk.
struct Found {
    std::map<std::uint32_t, std::string>& values;
    std::vector<std::uint32_t>& tags;
    DicomElements& file;
};

/// Walks over elements up to and including the pixel data, or up to the end mark of an item or a sequence.
class Walk {
public:
    Walk(Bytes& bytes, Found found, const NestedDicomElement& nested) : bytes_(bytes), found_(found), nested_(nested) {}

    void dataset(Encoding encoding) {
        std::uint32_t last = 0;
        while (bytes_.left() > 0) {
            const Element e = counted(encoding);
            if (e.tag <= last) throw Fault{"its elements are out of order"};
            last = e.tag;
            found_.tags.push_back(e.tag);
            if (e.tag == pixel_data) return voxels(e, encoding);
            if ((e.tag >> 16) % 2 != 0) ++found_.file.private_elements;
            const bool is_sequence =
                e.is_sequence || e.length == undefined || (nested_ && begins_with_item(e, encoding));
            if (is_sequence) ++found_.file.sequences;
            if (is_sequence && nested_)
                visit_sequence(e, encoding, 0);
            else if (e.length <= max_kept)
                found_.values[e.tag] = bytes_.keep(e.length);
            else
                skip(e, encoding, 0);
        }
    }

private:
    Element counted(Encoding encoding) {
        if (++elements_ > max_elements) throw Fault{"it has more than 100000 elements"};
        return next_element(bytes_, encoding);
    }

    void skip(const Element& e, Encoding encoding, int depth) {
        if (e.length != undefined) return bytes_.skip(e.length);
        if (depth >= max_nested) throw Fault{"its sequences are nested more than 16 deep"};
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
                skip(inner, encoding, depth + 1);
        }
    }

    /// Implicit elements and elements of type UN do not state that they are sequences.
    [[nodiscard]] bool begins_with_item(const Element& e, Encoding encoding) {
        if ((encoding.is_explicit && !e.is_unknown) || e.length < 8 || e.length > bytes_.left()) return false;
        const bool is_big = encoding.is_big && !e.is_unknown;
        const auto head = bytes_.peek<4>();
        return (bits(head.data(), 2, is_big) << 16 | bits(head.data() + 2, 2, is_big)) == item;
    }

    /// Visits all elements of a sequence. A walk that skipped it would miss errors inside.
    void visit_sequence(const Element& e, Encoding encoding, int depth) {
        if (depth >= max_nested) throw Fault{"its sequences are nested more than 16 deep"};
        if (e.is_unknown) encoding = {.is_big = false, .is_explicit = false};
        const auto end_of = [&](const Element& one) {
            if (one.length == undefined) return bytes_.at() + bytes_.left();
            if (one.length > bytes_.left()) throw Fault{"a sequence goes on beyond the file"};
            return bytes_.at() + one.length;
        };
        const std::uint64_t end = end_of(e);
        while (bytes_.at() < end) {
            const Element one = counted(encoding);
            if (one.tag == sequence_end) return;
            if (one.tag != item) throw Fault{"a sequence holds something that is no item"};
            const std::uint64_t end_of_item = std::min(end, end_of(one));
            while (bytes_.at() < end_of_item) {
                const Element inner = counted(encoding);
                if (inner.tag == item_end) break;
                const bool is_voxels = inner.tag == pixel_data;  // of an icon: fragments are not items with elements
                if (!is_voxels &&
                    (inner.is_sequence || inner.length == undefined || begins_with_item(inner, encoding))) {
                    visit_sequence(inner, encoding, depth + 1);
                } else if (is_voxels || inner.length > max_kept) {
                    skip(inner, encoding, depth + 1);
                    nested_(inner.tag, nullptr);
                } else {
                    const std::string value = bytes_.keep(inner.length);
                    nested_(inner.tag, &value);
                }
            }
        }
    }

    void voxels(const Element& e, Encoding encoding) {
        DicomElements& file = found_.file;
        file.has_voxels = true;
        file.is_encapsulated = e.length == undefined;
        const auto piece = [&](std::uint32_t length) {
            file.voxels.push_back({bytes_.at(), length});
            bytes_.skip(length);
        };
        if (!file.is_encapsulated) return piece(e.length);
        for (Element fragment = counted(encoding); fragment.tag != sequence_end; fragment = counted(encoding)) {
            if (fragment.tag != item || fragment.length == undefined)
                throw Fault{"its compressed voxels are not in fragments"};
            piece(fragment.length);
        }
    }

    Bytes& bytes_;
    Found found_;
    const NestedDicomElement& nested_;
    int elements_ = 0;
};

std::string trimmed(std::string text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\0'; };
    while (!text.empty() && is_blank(text.back())) text.pop_back();
    text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_blank));
    return text;
}

/// Returns the transfer syntax from group 2, which is always little endian and explicit.
std::string transfer_syntax_of(Bytes& bytes) {
    std::string syntax;
    while (bytes.left() >= 8 && bits(bytes.peek<2>().data(), 2, false) == 2) {
        const Element e = next_element(bytes, {});
        if (e.length == undefined) throw Fault{"its first group has no length"};
        if (e.tag == transfer_syntax && e.length <= max_kept)
            syntax = trimmed(bytes.keep(e.length));
        else
            bytes.skip(e.length);
    }
    if (syntax.empty()) throw Fault{"it does not say how it is encoded"};
    return syntax;
}

/// Returns the transfer syntax of a file without a preamble, by its first element; empty if the file is not DICOM.
std::string encoding_without_preamble(Bytes& bytes) {
    if (bytes.left() < 8) return {};
    const auto head = bytes.peek<8>();
    const std::uint32_t group = bits(head.data(), 2, false), element = bits(head.data() + 2, 2, false);
    const auto is_capital = [](unsigned char c) { return c >= 'A' && c <= 'Z'; };
    const bool names_its_sort = is_capital(head[4]) && is_capital(head[5]);
    if (group == 2 && names_its_sort) return transfer_syntax_of(bytes);
    if (group != 8 || element > 0x60) return {};
    if (!names_its_sort && bits(head.data() + 4, 4, false) > bytes.left() - 8) return {};
    return names_its_sort ? explicit_little : implicit_little;
}

bool begins_with_preamble(Bytes& bytes) {
    if (bytes.left() < preamble + 4) return false;
    return std::memcmp(bytes.peek<preamble + 4>().data() + preamble, "DICM", 4) == 0;
}

}  // namespace

DicomElements read_dicom_elements(const std::string& file, const NestedDicomElement& nested) {
    DicomElements elements;
    bool has_preamble = false;
    try {
        Bytes bytes(file);
        has_preamble = elements.is_dicom = begins_with_preamble(bytes);
        if (has_preamble) bytes.skip(preamble + 4);
        elements.encoding = has_preamble ? transfer_syntax_of(bytes) : encoding_without_preamble(bytes);
        if (elements.encoding.empty()) return elements;
        constexpr const char *big = "1.2.840.10008.1.2.2", *deflated = "1.2.840.10008.1.2.1.99";
        if (elements.encoding == deflated) {
            elements.is_dicom = true;
            elements.has_voxels = true;  // inside the compressed part
            return elements;
        }
        elements.is_big_endian = elements.encoding == big;
        Walk(bytes, {elements.values_, elements.tags_, elements}, nested)
            .dataset({.is_big = elements.is_big_endian, .is_explicit = elements.encoding != implicit_little});
    } catch (const Fault& fault) {
        elements.fault = fault.what;
    } catch (const std::exception&) {
        elements.fault = "it cannot be read";
    }
    if (has_preamble) return elements;
    // Other files may begin alike, so a file without a preamble must have the elements of a slice.
    elements.is_dicom = elements.text(0x0008, 0x0016).starts_with("1.2.840.10008.") ||
                        (elements.has_voxels && elements.has(0x0028, 0x0010));
    return elements.is_dicom ? elements : DicomElements();
}

bool DicomElements::has(std::uint16_t group, std::uint16_t element) const {
    return std::binary_search(tags_.begin(), tags_.end(), std::uint32_t{group} << 16 | element);
}

std::string DicomElements::text(std::uint16_t group, std::uint16_t element) const {
    const auto found = values_.find(std::uint32_t{group} << 16 | element);
    return found == values_.end() ? std::string() : trimmed(found->second);
}

std::vector<double> DicomElements::numbers(std::uint16_t group, std::uint16_t element) const {
    const std::string all = text(group, element);
    std::vector<double> values;
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t end = std::min(all.find('\\', at), all.size());
        const char *first = all.data() + at, *last = all.data() + end;
        while (first < last && (*first == ' ' || *first == '+')) ++first;
        while (last > first && last[-1] == ' ') --last;
        double value = 0.0;
        const auto read = std::from_chars(first, last, value);
        if (read.ec != std::errc{} || read.ptr != last || !std::isfinite(value)) return {};
        values.push_back(value);
        at = end + 1;
    }
    return values;
}

std::optional<double> DicomElements::number(std::uint16_t group, std::uint16_t element) const {
    const auto values = numbers(group, element);
    return values.empty() ? std::nullopt : std::optional(values.front());
}

std::optional<int> DicomElements::word(std::uint16_t group, std::uint16_t element, bool is_signed) const {
    const auto found = values_.find(std::uint32_t{group} << 16 | element);
    if (found == values_.end() || found->second.size() < 2) return std::nullopt;
    const auto* bytes = reinterpret_cast<const unsigned char*>(found->second.data());
    const auto raw = static_cast<std::uint16_t>(bits(bytes, 2, is_big_endian));
    return is_signed ? static_cast<int>(static_cast<std::int16_t>(raw)) : static_cast<int>(raw);
}

}  // namespace kerf::bone
