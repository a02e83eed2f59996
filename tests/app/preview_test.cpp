// SPDX-License-Identifier: Apache-2.0
// The page of `kerf preview`: names in its pictures, and how it adapts to a screen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "session/report/place_labels.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

constexpr double font = 14.0;

std::string preview_of(const std::string& procedure) {
    const test::TemporaryFolder folder;
    const test::Ended ended = test::kerf("preview " KERF_SOURCE_DIR "/procedures/" + procedure +
                                         ".yaml --set 'accuracy.spacing=1 mm' --out " + (folder / "page.html"));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return test::contents_of(folder / "page.html");
}

struct NamedBox {
    std::string text;
    session::Rect box;
};

/// Returns the names in each picture of a page, as the boxes that they take at most.
std::vector<std::vector<NamedBox>> names_in(const std::string& page) {
    std::vector<std::vector<NamedBox>> pictures;
    const std::regex name("<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" font-size=\"14.0\"[^>]*>([^<]*)</text>");
    for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) {
        const std::string picture = page.substr(at, page.find("</svg>", at) - at);
        pictures.emplace_back();
        for (std::sregex_iterator found(picture.begin(), picture.end(), name), end; found != end; ++found) {
            const std::string text = (*found)[3];
            pictures.back().push_back(
                {text,
                 {std::strtod((*found)[1].str().c_str(), nullptr),
                  std::strtod((*found)[2].str().c_str(), nullptr) - font, session::text_width(text, font), font}});
        }
    }
    return pictures;
}

class Preview : public testing::TestWithParam<const char*> {};

TEST_P(Preview, HasNoNamesThatOverlap) {
    const auto pictures = names_in(preview_of(GetParam()));
    std::size_t max_names = 0;
    for (const auto& names : pictures) {
        max_names = std::max(max_names, names.size());
        for (std::size_t i = 0; i < names.size(); ++i)
            for (std::size_t other = 0; other < i; ++other)
                EXPECT_FALSE(session::do_meet(names[i].box, names[other].box))
                    << names[i].text << " on " << names[other].text;
    }
    EXPECT_GE(max_names, 4u) << "the views from outside name landmarks and zones";
}

INSTANTIATE_TEST_SUITE_P(OfOperations, Preview, testing::Values("pedicle-screw", "trochanter-fixation"));

TEST(PreviewPage, ScalesItsPicturesToTheScreen) {
    const std::string page = preview_of("pedicle-screw");
    EXPECT_NE(page.find("name=\"viewport\""), std::string::npos);
    EXPECT_NE(page.find("svg { display: block; width: 100%; height: auto; }"), std::string::npos);
    EXPECT_FALSE(std::regex_search(page, std::regex("<svg width="))) << "a fixed width is cut off on a narrow screen";
    EXPECT_NE(page.find("For training and research; not for diagnosis, planning or deciding treatment"),
              std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
}

}  // namespace
}  // namespace kerf::app
