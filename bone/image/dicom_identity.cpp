// SPDX-License-Identifier: Apache-2.0
#include "bone/image/dicom_identity.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <utility>

#include "bone/image/dicom_elements.h"

namespace kerf::bone {
namespace {

constexpr std::size_t max_nested_text = 16'000'000;  // [bytes]
constexpr const char* deflated_syntax = "1.2.840.10008.1.2.1.99";

struct Tag {
    std::uint16_t group, element;
    const char* name;
};

/// The elements of PS3.15, table E.1-1, that are a name, a number, a date or a text of people.
constexpr Tag identifying[] = {
    {0x0008, 0x0012, "date of the file"},
    {0x0008, 0x0014, "UID of the file's creator"},
    {0x0008, 0x0018, "UID of the picture"},
    {0x0008, 0x0020, "date of the study"},
    {0x0008, 0x0021, "date of the series"},
    {0x0008, 0x0022, "date of acquisition"},
    {0x0008, 0x0023, "date of the picture"},
    {0x0008, 0x002a, "time of acquisition"},
    {0x0008, 0x0030, "time of the study"},
    {0x0008, 0x0050, "accession number"},
    {0x0008, 0x0080, "institution"},
    {0x0008, 0x0081, "institution's address"},
    {0x0008, 0x0090, "referring physician"},
    {0x0008, 0x0092, "referring physician's address"},
    {0x0008, 0x0094, "referring physician's telephone"},
    {0x0008, 0x1010, "station"},
    {0x0008, 0x1030, "description of the study"},
    {0x0008, 0x103e, "description of the series"},
    {0x0008, 0x1040, "department"},
    {0x0008, 0x1048, "physician of record"},
    {0x0008, 0x1050, "performing physician"},
    {0x0008, 0x1060, "reading physician"},
    {0x0008, 0x1070, "operator"},
    {0x0008, 0x1080, "admitting diagnosis"},
    {0x0008, 0x2111, "derivation of the picture"},
    {0x0010, 0x0010, "patient's name"},
    {0x0010, 0x0020, "patient's number"},
    {0x0010, 0x0021, "issuer of the patient's number"},
    {0x0010, 0x0030, "date of birth"},
    {0x0010, 0x0032, "time of birth"},
    {0x0010, 0x0040, "sex"},
    {0x0010, 0x1000, "other numbers of the patient"},
    {0x0010, 0x1001, "other names of the patient"},
    {0x0010, 0x1005, "birth name"},
    {0x0010, 0x1010, "age"},
    {0x0010, 0x1020, "size"},
    {0x0010, 0x1030, "weight"},
    {0x0010, 0x1040, "patient's address"},
    {0x0010, 0x1060, "mother's birth name"},
    {0x0010, 0x1090, "number of the medical record"},
    {0x0010, 0x2000, "medical alerts"},
    {0x0010, 0x2110, "allergies"},
    {0x0010, 0x2154, "patient's telephone"},
    {0x0010, 0x2160, "ethnic group"},
    {0x0010, 0x2180, "occupation"},
    {0x0010, 0x21b0, "patient's history"},
    {0x0010, 0x4000, "comments on the patient"},
    {0x0018, 0x1000, "serial number of the device"},
    {0x0018, 0x1030, "protocol"},
    {0x0018, 0x1400, "description of the device's processing"},
    {0x0020, 0x000d, "UID of the study"},
    {0x0020, 0x000e, "UID of the series"},
    {0x0020, 0x0010, "number of the study"},
    {0x0020, 0x0052, "UID of the frame of reference"},
    {0x0020, 0x4000, "comments on the picture"},
    {0x0032, 0x1032, "requesting physician"},
    {0x0032, 0x1033, "requesting department"},
    {0x0032, 0x1060, "description of the request"},
    {0x0038, 0x0010, "number of the admission"},
    {0x0038, 0x0300, "patient's ward"},
    {0x0038, 0x0500, "patient's state"},
    {0x0040, 0x0244, "date of the procedure"},
    {0x0040, 0x0253, "number of the procedure"},
    {0x0040, 0x0254, "description of the procedure"},
    {0x0040, 0xa075, "verifying person"},
    {0x0040, 0xa123, "person"},
};

std::string text_of(const Tag& tag) {
    char text[64];
    std::snprintf(text, sizeof text, " (%04x,%04x)", static_cast<unsigned>(tag.group),
                  static_cast<unsigned>(tag.element));
    return tag.name + std::string(text);
}

/// Without the blanks and zeros that pad a value to an even length.
std::string without_padding(const std::string& value) {
    return value.substr(0, value.find_last_not_of(std::string_view(" \0", 2)) + 1);
}

void add_nested(std::uint32_t tag, const std::string* value, DicomIdentity& identity) {
    if ((tag >> 16) % 2 != 0) ++identity.private_elements;
    if (value == nullptr) return void(++identity.unread_elements);
    const auto known = std::find_if(std::begin(identifying), std::end(identifying),
                                    [&](const Tag& t) { return (std::uint32_t{t.group} << 16 | t.element) == tag; });
    if (known != std::end(identifying)) {
        if (std::string plain = without_padding(*value); !plain.empty())
            identity.elements.push_back({text_of(*known), std::move(plain), true});
        return;
    }
    identity.has_all_nested_texts = identity.has_all_nested_texts && identity.nested_texts.size() < max_nested_text;
    if (identity.has_all_nested_texts) identity.nested_texts += *value + '\n';
}

}  // namespace

DicomIdentity read_dicom_identity(const std::string& file) {
    DicomIdentity identity;
    const DicomElements elements = read_dicom_elements(file);
    if (!elements.is_dicom) return identity;
    for (const Tag& tag : identifying)
        if (std::string value = elements.text(tag.group, tag.element); !value.empty())
            identity.elements.push_back({text_of(tag), std::move(value)});
    identity.has_text_in_picture = elements.text(0x0028, 0x0301) == "YES";
    // A second walk, because a fault in a sequence ends a walk that enters sequences.
    const DicomElements nested = read_dicom_elements(
        file, [&](std::uint32_t tag, const std::string* value) { add_nested(tag, value, identity); });
    identity.private_elements += elements.private_elements;
    identity.is_deflated = elements.encoding == deflated_syntax;
    identity.fault = elements.fault;
    identity.sequence_fault = nested.fault;
    return identity;
}

}  // namespace kerf::bone
