// SPDX-License-Identifier: Apache-2.0
// The contents of the start page, from files.
#include "app/start_page.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "app/learner_code.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

/// A folder with the pedicle screw in a bone of boxes, its anatomy in the same folder, and a broken file.
struct Folder {
    test::TemporaryFolder files;
    std::string own = files / "own";
    Installation here{files / "nothing"};
    Environment with{test::plugins(), here};

    Folder() {
        const std::string shipped = KERF_SOURCE_DIR "/procedures";
        std::filesystem::create_directory(own);
        std::filesystem::copy_file(shipped + "/anatomy/vertebra-phantom.yaml", own + "/bone.yaml");
        std::string text = test::contents_of(shipped + "/pedicle-screw.yaml");
        const std::string anatomy = "anatomy/vertebra-l3.yaml", spacing = "0.25 mm";
        text.replace(text.find(anatomy), anatomy.size(), "bone.yaml");
        text.replace(text.find(spacing), spacing.size(), "0.5 mm");
        std::ofstream(own + "/screw.yaml") << text;
        std::ofstream(own + "/broken.yaml") << "kind: Procedure\nsteps: [\n";
        std::ofstream(own + "/notes.txt") << "no YAML\n";
    }
    [[nodiscard]] WindowOptions options() const { return {own, files / "attempts", ""}; }
};

TEST(StartPages, ListProceduresAndTheirMistakes) {
    const Folder folder;
    StartPages pages(folder.options(), folder.with);
    window::StartSelection selection;
    const window::StartPage& page = pages.page(selection);
    ASSERT_EQ(page.procedures.size(), 1u);
    EXPECT_EQ(page.procedures[0].id, "pedicle-screw");
    EXPECT_EQ(page.procedures[0].title, "Pedicle screw");
    EXPECT_EQ(page.procedures[0].summary, "4 steps with pilot, opener, tap, screw");
    ASSERT_EQ(page.refused.size(), 1u);
    EXPECT_TRUE(page.refused[0].starts_with("broken.yaml: line 2: ")) << page.refused[0];
    ASSERT_EQ(page.details.steps.size(), 4u);
    EXPECT_EQ(page.details.steps[0].goals.back(), "depth at least 30 mm");
    EXPECT_EQ(page.details.time_limit, 360.0);
    EXPECT_EQ(page.details.rehearsals.front().id, "expert");
}

TEST(StartPages, OpenAnotherFolderOrKeepTheirs) {
    const Folder folder;
    StartPages pages(folder.options(), folder.with);
    window::StartSelection selection{.procedure = 0, .variant = "none-of-these"};
    EXPECT_NE(pages.page(selection).details.error, "");
    pages.open_folder(folder.files / "missing");
    EXPECT_TRUE(pages.page(selection).is_message_bad);
    EXPECT_EQ(pages.page(selection).procedures.size(), 1u);
    pages.open_folder(folder.files / "own/..");
    EXPECT_TRUE(pages.page(selection).procedures.empty());
    EXPECT_EQ(pages.page(selection).message, "");
}

TEST(StartPages, RefuseTheCodeOfALearner) {
    const Folder folder;
    StartPages pages(folder.options(), folder.with);
    for (const char* code : {"Ann Lee", "a/b", "..", ".hidden", "ä"}) {
        window::StartSelection selection{.learner = code};
        EXPECT_NE(pages.page(selection).learner_refusal, "") << code;
    }
    EXPECT_NE(refusal_of_learner(std::string(65, 'a')), "");
    for (const char* code : {"", "L17", "a.b_c-1"}) {
        window::StartSelection selection{.learner = code};
        EXPECT_EQ(pages.page(selection).learner_refusal, "") << code;
    }
}

TEST(StartPages, ChooseNoDeviceThatIsNotThere) {
    const Folder folder;
    StartPages pages(folder.options(), folder.with);
    window::StartSelection selection{.device = "udp/port-1"};
    static_cast<void>(pages.page(selection));
    EXPECT_EQ(selection.device, "");
}

TEST(StartPages, DrawTheBoneBeforeTheFirstTick) {
    const Folder folder;
    StartPages pages(folder.options(), folder.with);
    window::StartSelection selection;
    static_cast<void>(pages.page(selection));
    std::shared_ptr<const window::StartPicture> picture;
    for (int i = 0; i < 3000 && (picture = pages.picture(selection)) == nullptr; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_NE(picture, nullptr) << pages.picture_state();
    EXPECT_EQ(picture->state.tick, 0u);
    EXPECT_EQ(picture->scene.steps.size(), 4u);
    EXPECT_EQ(picture->scene.spacing, 1e-3);  // twice that of the procedure
    ASSERT_EQ(picture->surface->bodies.size(), 1u);
    EXPECT_GT(picture->surface->bodies[0].patches.capacity(), 0u);
    EXPECT_EQ(pages.picture(selection), picture);
}

}  // namespace
}  // namespace kerf::app
