// SPDX-License-Identifier: Apache-2.0
#include "app/privacy/privacy_report.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/privacy/byte_search.h"
#include "app/privacy/database_texts.h"
#include "app/privacy/text_search.h"
#include "bone/image/dicom_elements.h"
#include "bone/image/dicom_identity.h"
#include "bone/image/packed_bytes.h"
#include "text/regular_file.h"

namespace kerf::app {
namespace {

using namespace privacy;

constexpr std::uintmax_t max_bytes = 500'000'000;  // of a text file

void search_dicom(const std::string& file, PrivacyReport& report) {
    const bone::DicomIdentity identity = bone::read_dicom_identity(file);
    for (const bone::DicomIdentityElement& element : identity.elements) {
        if (element.is_in_sequence)
            add_finding(report, element.name + ", in a sequence", element.value);
        else
            report.findings.push_back({element.name, element.value});
    }
    if (identity.has_text_in_picture) report.findings.push_back({"text in the picture (0028,0301)", ""});
    ByteSearch search(report, ", in a sequence");
    search.take(identity.nested_texts);
    search.end();
    if (const std::size_t count = identity.private_elements; count > 0)
        report.findings.push_back(
            {std::to_string(count) + " private elements, whose contents only the manufacturer knows", ""});

    if (identity.unread_elements > 0)
        report.unseen.push_back(std::to_string(identity.unread_elements) +
                                " long elements of sequences were not checked.");
    if (!identity.has_all_nested_texts)
        report.add_unread("Only the first 16 MB of the texts in sequences were checked.");
    if (identity.is_deflated)
        report.add_unread("The file is compressed behind its first elements. That part was not checked.");
    if (!identity.fault.empty())
        report.add_unread("The file is damaged: " + identity.fault + ". The rest was not checked.");
    else if (!identity.sequence_fault.empty())
        report.add_unread("A sequence is damaged: " + identity.sequence_fault + ". Later sequences were not checked.");
}

bool ends_in(const std::string& name, std::string_view ending) {
    return name.size() >= ending.size() &&
           std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                      [](char want, char got) { return want == lower(got); });
}

void search_nifti(const std::string& file, PrivacyReport& report) {
    std::string header(348, '\0');
    const auto packing = ends_in(file, ".gz") ? bone::PackedBytes::Packing::deflated : bone::PackedBytes::Packing::none;
    bone::PackedBytes bytes(file, 0, packing);
    header.resize(bytes.take(header.data(), header.size()));
    if (header.size() < 348) return void(report.error = file + ": is not a NIfTI file. Check its name.");
    struct Field {
        std::size_t at, size;
        const char* name;
    };
    for (const Field& field : {Field{4, 10, "`data_type`"}, Field{14, 18, "`db_name`"}, Field{148, 80, "`descrip`"},
                               Field{228, 24, "`aux_file`"}, Field{328, 16, "`intent_name`"}}) {
        // NOLINTNEXTLINE(readability-redundant-string-cstr): the value ends at its first NUL
        const std::string value = header.substr(field.at, field.size).c_str();
        if (!value.empty()) report.findings.push_back({std::string("text in the header's ") + field.name, value});
    }
    search_voxels(bytes, report);  // and the header's extensions, which precede them
}

/// Returns the value of a header's line such as `encoding: gzip` or `CompressedData = True`, in lower case.
std::string header_value(const std::string& header, std::string_view key) {
    for (std::size_t at = 0; at < header.size();) {
        const std::size_t end = std::min(header.find('\n', at), header.size());
        std::string line = header.substr(at, end - at);
        at = end + 1;
        for (char& c : line) c = lower(c);
        if (line.compare(0, key.size(), key) != 0) continue;
        line.erase(0, key.size());
        line.erase(0, std::min(line.find_first_not_of(" :="), line.size()));
        return line.substr(0, line.find_last_not_of(" \r") + 1);
    }
    return {};
}

/// Searches the voxels that follow a header of NRRD or MetaImage in the same file.
void search_voxels_behind(const std::string& file, const std::string& header, std::uint64_t offset, bool is_nrrd,
                          PrivacyReport& report) {
    const std::string encoding = is_nrrd                                            ? header_value(header, "encoding")
                                 : header_value(header, "compresseddata") == "true" ? "gzip"
                                                                                    : "raw";
    const bool is_packed = encoding == "gzip" || encoding == "gz";
    if (!is_packed && encoding != "raw" && encoding != "ascii" && encoding != "text" && encoding != "txt")
        return report.add_unread("The voxels are compressed, but not by gzip. They were not checked.");
    if (!header_value(header, "data file").empty() || !header_value(header, "datafile").empty())
        report.unseen.push_back("The voxels are in another file. Check that file too.");
    bone::PackedBytes bytes(file, offset,
                            is_packed ? bone::PackedBytes::Packing::deflated : bone::PackedBytes::Packing::none);
    search_voxels(bytes, report);
}

}  // namespace

void PrivacyReport::add_unread(std::string part) {
    is_partial = true;
    unseen.push_back(std::move(part));
}

PrivacyReport privacy_report(const std::string& file) {
    PrivacyReport report;
    std::error_code error;
    if (const auto fault = text::fault_of_file(file)) {
        report.error = file + ": " + fault->problem + " Name single files; of a series, name its slices.";
        return report;
    }
    if (bone::read_dicom_elements(file).is_dicom) {
        search_dicom(file, report);
        return report;
    }
    if (ends_in(file, ".nii") || ends_in(file, ".nii.gz")) {
        search_nifti(file, report);
        return report;
    }
    char first[16] = {};
    if (std::ifstream(file, std::ios::binary).read(first, sizeof first) &&
        std::string_view(first, 15) == "SQLite format 3") {
        std::string fault;
        search_text_and_utf16(texts_of_database(file, fault, report), report);
        if (!report.error.empty()) return report;
        if (!fault.empty()) report.add_unread("The database was not checked to its end: " + fault + ".");
        report.unseen.push_back("Deleted rows of the database were not checked.");
        return report;
    }
    const bool is_nrrd = ends_in(file, ".nrrd") || ends_in(file, ".nhdr"), is_stl = ends_in(file, ".stl"),
               is_meta = ends_in(file, ".mha");
    std::ifstream in(file, std::ios::binary);
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    const std::uintmax_t wanted = is_stl ? 84 : is_nrrd || is_meta ? 65'536 : max_bytes;
    std::string bytes(std::min(size, wanted), '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in || error) {
        report.error = file + ": cannot be read. Check its permissions.";
        return report;
    }
    if (is_nrrd || is_meta) {
        // The header ends with an empty line, or with the line that names the file of the voxels.
        const std::size_t data = bytes.find("ElementDataFile");
        const std::size_t last = is_nrrd                     ? std::min(bytes.find("\n\n"), bytes.find("\n\r\n"))
                                 : data == std::string::npos ? data
                                                             : bytes.find('\n', data);
        const std::size_t end = last == std::string::npos ? bytes.size()
                                : is_nrrd                 ? bytes.find('\n', last + 1) + 1
                                                          : last + 1;
        bytes.resize(end);
    }
    search_text_and_utf16(bytes, report);
    if (is_nrrd || is_meta)
        search_voxels_behind(file, bytes, bytes.size(), is_nrrd, report);
    else if (!is_stl)
        search_base64(bytes, report);
    else
        report.unseen.push_back("Only the first 84 bytes of the STL were checked.");
    if (size > max_bytes && !is_stl && !is_nrrd && !is_meta) report.add_unread("Only the first 500 MB were checked.");
    return report;
}

std::string privacy_text(const std::string& file, const PrivacyReport& report, bool shows_values) {
    const std::size_t count = report.findings.size();
    std::string text = file + ": " + (report.is_partial ? "not checked to its end; in the rest: " : "") +
                       (count == 0 ? "no personal data found"
                                   : std::to_string(count) + (count == 1 ? " item" : " items") + " of personal data") +
                       "\n";
    const auto first_letter = [](const std::string& value) {
        return static_cast<unsigned char>(value[0]) < 0x80 ? value.substr(0, 1) : std::string();
    };
    for (const PrivacyFinding& found : report.findings) {
        text += "  " + found.what;
        if (!found.value.empty())
            text += ": " + (shows_values ? found.value
                                         : first_letter(found.value) + "… (" + std::to_string(found.value.size()) +
                                               " characters)");
        text += "\n";
    }
    for (const std::string& unseen : report.unseen) text += "  " + unseen + "\n";
    return text;
}

}  // namespace kerf::app
