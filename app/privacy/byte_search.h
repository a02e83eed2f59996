// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "app/privacy/privacy_report.h"
#include "bone/image/packed_bytes.h"

namespace kerf::app::privacy {

/// Searches bytes that are not text, such as voxels, triangles and pictures. Only runs of eight ASCII letters or more
/// are searched. Memory is bounded to a few megabytes, for any number of bytes.   [main]
class ByteSearch {
public:
    /// @param where   appended to each finding
    ByteSearch(PrivacyReport& report, std::string where);

    /// Takes the next bytes.
    void take(std::string_view bytes);
    /// Ends the last run and searches it.
    void end();

private:
    static constexpr std::size_t min_run = 8, max_run = 1 << 20, overlap = 1 << 12, max_kept = 4 << 20;

    void keep_run(bool continues);
    void search();

    PrivacyReport& report_;
    const std::string where_;
    std::string run_, kept_;
};

/// Searches the rest of `bytes`, at most 4 GB of it.   [main]
void search_voxels(bone::PackedBytes& bytes, PrivacyReport& report);

/// Searches the surfaces and pictures that a page contains as base64.   [main]
void search_base64(const std::string& text, PrivacyReport& report);

}  // namespace kerf::app::privacy
