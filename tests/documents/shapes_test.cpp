// SPDX-License-Identifier: Apache-2.0
// The table of what documents may say, held against the readers.
#include "documents/shapes/shapes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "documents/read_anatomy.h"
#include "documents/read_procedure.h"
#include "tests/documents/catalog.h"
#include "tests/documents/every_key.h"

namespace kerf::documents {
namespace {

struct Kind {
    const Shape& shape;
    std::function<bool(const std::string&, text::Diagnostics&)> is_accepted;
};

std::vector<Kind> kinds() {
    return {{shapes::procedure,
             [](const std::string& text, text::Diagnostics& found) {
                 return read_procedure_text("p.yaml", text, example_catalog()).take(found).has_value();
             }},
            {shapes::anatomy, [](const std::string& text, text::Diagnostics& found) {
                 return read_anatomy_text("a.yaml", text).take(found).has_value();
             }}};
}

TEST(Shapes, EveryKeyIsExplainedInASentenceAndShownInAnExample) {
    for (const Kind& kind : kinds())
        for_every_key(kind.shape, [](const Shape& shape, const KeyShape& key) {
            EXPECT_TRUE(key.help.ends_with('.')) << shape.id << "/" << key.name;
            EXPECT_FALSE(key.example.empty()) << shape.id << "/" << key.name;
        });
}

TEST(Shapes, EveryExampleIsAcceptedByTheReader) {
    for (const Kind& kind : kinds())
        for (std::size_t choice = 0; choice < EveryKey::choices; ++choice)
            for (const int depth : {0, 1, 2, 3, 9}) {
                const std::string text = EveryKey{.choice = choice, .depth = depth}.document(kind.shape);
                text::Diagnostics found;
                EXPECT_TRUE(kind.is_accepted(text, found)) << to_text(found) << text;
                EXPECT_TRUE(found.empty()) << to_text(found) << text;
            }
}

TEST(Shapes, TheReaderNeedsWhatTheShapeRequiresAndNothingElse) {
    // A shape sees one map: these are needed by most tissues, or by what another key refers to, as the
    // neck to its head.
    const std::set<std::string> needed_by_case{"tissue/density",       "tissue/thickness",   "needs/landmarks",
                                               "needs/zones",          "step/limits",        "procedure/implants",
                                               "procedure/paths",      "procedure/measures", "landmarks/points",
                                               "landmarks/markups",    "point/fit",          "implant/place",
                                               "instrument/remeshing", "loft_section/width", "loft_section/height",
                                               "loft_section/outline", "made_bone/level"};
    for (const Kind& kind : kinds())
        for_every_key(kind.shape, [&](const Shape& shape, const KeyShape& key) {
            if (key.presence == Presence::one_of) return;
            const std::string name = shape.id + "/" + key.name;
            bool is_ever_needed = false;
            for (std::size_t choice = 0; choice < EveryKey::choices; ++choice) {
                text::Diagnostics found;
                is_ever_needed |=
                    !kind.is_accepted(EveryKey{.choice = choice, .dropped = name}.document(kind.shape), found);
            }
            const bool is_needed = key.presence == Presence::required || needed_by_case.contains(name);
            EXPECT_EQ(is_ever_needed, is_needed) << name;
        });
}

TEST(Shapes, WithoutAnyOfKeysThatExcludeEachOtherADocumentIsRefused) {
    for (const Kind& kind : kinds())
        for_every_key(kind.shape, [&](const Shape& shape, const KeyShape& key) {
            if (key.presence != Presence::one_of) return;
            bool is_ever_refused = false;
            for (std::size_t choice = 0; choice < EveryKey::choices; ++choice) {
                text::Diagnostics found;
                is_ever_refused |= !kind.is_accepted(
                    EveryKey{.choice = choice, .dropped = shape.id + "/" + key.name}.document(kind.shape), found);
            }
            EXPECT_TRUE(is_ever_refused) << shape.id << "/" << key.name;
        });
}

}  // namespace
}  // namespace kerf::documents
