// SPDX-License-Identifier: Apache-2.0
#include "run/bone_memory.h"

#include <gtest/gtest.h>

#include <charconv>
#include <stdexcept>
#include <string>
#include <utility>

#include "bone/import/make_body.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"

namespace kerf::run {
namespace {

using namespace literals;

documents::Anatomy vertebra() {
    text::Diagnostics diagnostics;
    auto anatomy =
        documents::read_anatomy(KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml").take(diagnostics);
    if (!anatomy) throw std::runtime_error(to_text(diagnostics));
    return std::move(*anatomy);
}

/// A block of bone under three shells.
documents::Anatomy block(double edge) {
    documents::Anatomy anatomy;
    anatomy.phantom.parts.push_back({"block", documents::BoxSolid{{0, 0, 0}, {edge, edge, edge}}, false, ""});
    for (const char* id : {"a", "b", "c", "core"}) anatomy.tissues.push_back({id, 1000.0, 5.0_mm, ""});
    return anatomy;
}

text::Diagnostics checked(const documents::Anatomy& anatomy, double spacing) {
    documents::Procedure procedure;
    procedure.file = "p.yaml";
    procedure.text = "apiVersion: kerf/v1\naccuracy: {spacing: 0.05 mm}\n";
    procedure.spacing = spacing;
    text::Diagnostics diagnostics;
    check_bone_memory(procedure, anatomy, diagnostics);
    return diagnostics;
}

TEST(BoneMemory, IsWhatTheFieldsTake) {
    const documents::Anatomy anatomy = vertebra();
    text::Diagnostics diagnostics;
    const auto body = bone::make_body(anatomy, 0.5_mm).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);
    double bytes = static_cast<double>(body->surface.memory_bytes());
    for (const Material& material : body->materials) bytes += static_cast<double>(material.border.memory_bytes());
    EXPECT_NEAR(bone_memory(anatomy, 0.5_mm) / bytes, 1.0, 0.15 /* whole bricks against parts of them */);
}

TEST(BoneMemory, TheShippedBoneIsAllowedAtTheFinestSpacing) { EXPECT_TRUE(checked(vertebra(), 0.05_mm).empty()); }

TEST(BoneMemory, TooMuchIsRefusedBeforeItIsTakenAndTheSpacingToWriteWouldDo) {
    const documents::Anatomy anatomy = block(200.0_mm);
    const text::Diagnostics diagnostics = checked(anatomy, 0.05_mm);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0413");
    EXPECT_EQ(diagnostics[0].place.line, 2);
    EXPECT_NE(diagnostics[0].message.find("must be at most 4 GB"), std::string::npos) << diagnostics[0].message;

    ASSERT_TRUE(diagnostics[0].write.ends_with(" mm")) << diagnostics[0].write;
    const std::string& write = diagnostics[0].write;
    double millimetres = 0.0;
    std::from_chars(write.data(), write.data() + write.size(), millimetres);  // whatever the locale
    const double spacing = millimetres * 1e-3;
    ASSERT_GT(spacing, 0.05_mm);
    EXPECT_TRUE(checked(anatomy, spacing).empty());
}

}  // namespace
}  // namespace kerf::run
