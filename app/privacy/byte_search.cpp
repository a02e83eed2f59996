// SPDX-License-Identifier: Apache-2.0
#include "app/privacy/byte_search.h"

#include <cstdint>
#include <utility>

#include "app/privacy/text_search.h"

namespace kerf::app::privacy {

namespace {

constexpr std::uint64_t max_unpacked = 4'000'000'000;  // [bytes]

}  // namespace

ByteSearch::ByteSearch(PrivacyReport& report, std::string where) : report_(report), where_(std::move(where)) {}

void ByteSearch::take(std::string_view bytes) {
    for (const char c : bytes) {
        const bool is_plain = c >= 0x20 && c < 0x7f;
        if (is_plain) run_ += c;
        if (!is_plain || run_.size() >= max_run) keep_run(is_plain);
    }
}

void ByteSearch::end() {
    keep_run(false);
    search();
}

/// The end of a run that continues is searched again with its next piece.
void ByteSearch::keep_run(bool continues) {
    if (run_.size() >= min_run) kept_ += run_ + '\n';
    if (continues)
        run_.erase(0, run_.size() - overlap);
    else
        run_.clear();
    if (kept_.size() > max_kept) search();
}

void ByteSearch::search() {
    search_text(kept_, report_, where_);
    kept_.clear();
}

void search_voxels(bone::PackedBytes& bytes, PrivacyReport& report) {
    ByteSearch search(report, ", among the voxels");
    std::string buffer(1 << 18, '\0');
    std::uint64_t sum = 0;
    while (sum < max_unpacked) {
        const std::uint64_t count = bytes.take(buffer.data(), buffer.size());
        search.take(std::string_view(buffer).substr(0, count));
        sum += count;
        if (count < buffer.size()) break;
    }
    search.end();
    if (bytes.is_damaged()) report.add_unread("The compressed voxels are damaged. They were not checked to their end.");
    if (sum >= max_unpacked) report.add_unread("Only the first 4 GB of the voxels were checked.");
    report.unseen.push_back("The voxels were checked for ASCII letters only: not for letters of two bytes, and not for "
                            "what a picture of them shows.");
}

void search_base64(const std::string& text, PrivacyReport& report) {
    constexpr std::size_t min_letters = 64;  // shorter ones are words
    const auto digit = [](char c) {
        return c >= 'A' && c <= 'Z'   ? c - 'A'
               : c >= 'a' && c <= 'z' ? c - 'a' + 26
               : is_digit(c)          ? c - '0' + 52
               : c == '+'             ? 62
               : c == '/'             ? 63
                                      : -1;
    };
    ByteSearch search(report, ", in base64");
    for (std::size_t from = 0; from < text.size();) {
        std::size_t end = from;
        while (end < text.size() && digit(text[end]) >= 0) ++end;
        if (end - from >= min_letters) {
            std::uint32_t bits = 0;
            int count = 0;
            for (std::size_t at = from; at < end; ++at) {
                bits = bits << 6 | static_cast<std::uint32_t>(digit(text[at]));
                if ((count += 6) < 8) continue;
                count -= 8;
                const char byte = static_cast<char>(bits >> count & 0xffu);
                search.take({&byte, 1});
            }
            search.take(std::string_view("\0", 1));
        }
        from = end + 1;
    }
    search.end();
}

}  // namespace kerf::app::privacy
