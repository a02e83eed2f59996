// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "documents/made/draw.h"
#include "documents/made/read_request.h"
#include "documents/yaml/document.h"
#include "text/source.h"

/// Requests of made bones.
namespace kerf::documents {

inline MakeRequest with_seed(MakeRequest request, std::uint32_t seed) {
    request.seed = seed;
    return request;
}

inline const Dimension& dimension_of(const Population& population, const std::string& name) {
    return *std::find_if(population.dimensions.begin(), population.dimensions.end(),
                         [&](const Dimension& d) { return d.name == name; });
}

/// Reads a request, and returns the messages.
inline std::string problem_with(const std::string& text, std::optional<MakeRequest>* request = nullptr) {
    text::Diagnostics diagnostics;
    auto document = parse_document("request", text).take(diagnostics);
    if (!document) return to_text(diagnostics);
    Report report(*document, diagnostics);
    auto read = read_make_request(document->root, "anatomy", report);
    EXPECT_EQ(read.has_value(), diagnostics.empty());
    if (request != nullptr) *request = std::move(read);
    return to_text(diagnostics);
}

/// Expects that a text has all of these parts.
inline void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

}  // namespace kerf::documents
