// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kerf {
namespace {

CommandLine read(std::vector<const char*> words) {
    words.insert(words.begin(), "kerf");
    return read_command_line(static_cast<int>(words.size()), words.data());
}

TEST(CommandLine, ReadsEveryOptionOfRun) {
    const CommandLine line = read({"run", "p.yaml", "--anatomy", "a.yaml", "--hand", "expert", "--replay", "s.db",
                                   "--out", "o", "--learner", "L17", "--mode", "exam", "--headless"});
    ASSERT_EQ(line.answer, "");
    EXPECT_EQ(line.command, "run");
    EXPECT_EQ(line.files, std::vector<std::string>{"p.yaml"});
    EXPECT_EQ(line.anatomy, "a.yaml");
    EXPECT_EQ(line.hand, "expert");
    EXPECT_EQ(line.replay, "s.db");
    EXPECT_EQ(line.out, "o");
    EXPECT_EQ(line.learner, "L17");
    EXPECT_EQ(line.mode, "exam");
    EXPECT_TRUE(line.is_headless);
}

TEST(CommandLine, TakesSeveralFilesToValidateAndToRehearse) {
    for (const char* command : {"validate", "rehearse"}) {
        const CommandLine line = read({command, "a.yaml", "b.yaml", "--anatomy", "c.yaml", "d.yaml"});
        EXPECT_EQ(line.answer, "");
        EXPECT_EQ(line.files, (std::vector<std::string>{"a.yaml", "b.yaml", "d.yaml"}));
        EXPECT_EQ(line.anatomy, "c.yaml");
    }
}

TEST(CommandLine, DescribesAllOrOne) {
    EXPECT_EQ(read({"describe"}).component, "");
    EXPECT_EQ(read({"describe", "kerf.saw/blade"}).component, "kerf.saw/blade");
}

TEST(CommandLine, ChangesAProcedureByVariantAndSettings) {
    for (const char* command : {"run", "validate", "rehearse", "plan", "preview", "expand"}) {
        const CommandLine line = read({command, "a.yaml", "--variant", "osteoporotic", "--set",
                                       "accuracy.spacing=0.5 mm", "--set", "steps.drill.limits=~"});
        EXPECT_EQ(line.answer, "") << command;
        EXPECT_EQ(line.files, std::vector<std::string>{"a.yaml"});
        EXPECT_EQ(line.variant, "osteoporotic");
        EXPECT_EQ(line.settings, (std::vector<std::string>{"accuracy.spacing=0.5 mm", "steps.drill.limits=~"}));
    }
    EXPECT_FALSE(read({"validate", "a.yaml"}).is_with_bone);
    EXPECT_TRUE(read({"validate", "a.yaml", "--bone"}).is_with_bone);
}

TEST(CommandLine, ExplainsOneCodeOrAll) {
    EXPECT_EQ(read({"explain"}).code, "");
    EXPECT_EQ(read({"explain", "E0412"}).code, "E0412");
}

TEST(CommandLine, PrintsTheSchemaOfOneKindOfDocument) {
    EXPECT_EQ(read({"schema"}).kind, "procedure");
    EXPECT_EQ(read({"schema", "anatomy"}).kind, "anatomy");
}

TEST(CommandLine, ReadsEveryOptionOfStability) {
    const CommandLine line = read({"stability", "--quick", "--plugin", "kerf.saw", "--out", "o"});
    ASSERT_EQ(line.answer, "");
    EXPECT_EQ(line.command, "stability");
    EXPECT_TRUE(line.is_quick);
    EXPECT_EQ(line.plugin, "kerf.saw");
    EXPECT_EQ(line.out, "o");
    EXPECT_EQ(read({"stability"}).plugin, "kerf.drilling");
}

TEST(CommandLine, ReadsEveryOptionOfChart) {
    const CommandLine line = read({"chart", "--quick", "--scene", "femur", "-o", "o"});
    ASSERT_EQ(line.answer, "");
    EXPECT_EQ(line.command, "chart");
    EXPECT_TRUE(line.is_quick);
    EXPECT_EQ(line.scene, "femur");
    EXPECT_EQ(line.out, "o");
    EXPECT_EQ(read({"chart", "--out", "p"}).out, "p");
}

TEST(CommandLine, WhatIsWrittenGoesWhereTheSameWordSaysWithEveryCommand) {
    for (const char* option : {"-o", "--out"}) {
        for (const char* command : {"run", "plan", "preview", "report", "import"})
            EXPECT_EQ(read({command, "x", option, "place"}).out, "place") << command;
        for (const char* command : {"stability", "chart"})
            EXPECT_EQ(read({command, option, "place"}).out, "place") << command;
    }
}

TEST(CommandLine, ReportsOneSession) {
    const CommandLine line = read({"report", "session.db", "--out", "r.html"});
    ASSERT_EQ(line.answer, "");
    EXPECT_EQ(line.source, "session.db");
    EXPECT_EQ(line.out, "r.html");
    EXPECT_NE(read({"report"}).answer.find("of which run? Write `kerf report SESSION.db`."), std::string::npos);
}

TEST(CommandLine, HelpMayStandBeforeOrAfterTheCommandAndBesideAnything) {
    for (const std::vector<const char*>& words :
         {std::vector<const char*>{"run", "--help"}, {"--help", "run"}, {"run", "p.yaml", "-h"}, {"help", "run"}}) {
        const CommandLine line = read(words);
        EXPECT_EQ(line.exit_code, exit_pass);
        EXPECT_NE(line.answer.find("Usage: kerf run"), std::string::npos) << line.answer;
        EXPECT_NE(line.answer.find("not for diagnosis"), std::string::npos);
    }
}

TEST(CommandLine, TheVersionMayStandBeforeOrAfterTheCommand) {
    for (const std::vector<const char*>& words :
         {std::vector<const char*>{"--version"}, {"run", "--version"}, {"--version", "list"}}) {
        const CommandLine line = read(words);
        EXPECT_EQ(line.exit_code, exit_pass);
        EXPECT_EQ(line.answer, "kerf " KERF_VERSION "\n");
    }
}

struct Wrong {
    std::vector<const char*> words;
    const char* says;
};

TEST(CommandLine, WrongUseSaysWhatToWriteAndEndsWithTwo) {
    for (const auto& [words, says] : {
             Wrong{{}, "Usage: kerf"},
             {{"--"}, "nothing to do. Write `kerf run PROCEDURE.yaml`"},
             {{"fly"}, "there is no command `fly`. Write `run`, `validate`"},
             {{"valdate", "p.yaml"}, "there is no command `valdate`. Write `kerf validate`."},
             {{"run"}, "which procedure? Write `kerf run PROCEDURE.yaml`."},
             {{"run", ""}, "`PROCEDURE` is empty. Write the name of a YAML file."},
             {{"run", "a.yaml", "b.yaml"}, "`b.yaml` is the second."},
             {{"run", "p.yaml", "--outt", "x"}, "there is no option `--outt` of `kerf run`. Write `--out`."},
             {{"run", "--fast"}, "there is no option `--fast` of `kerf run`. Write `--help`, `--anatomy`"},
             {{"run", "p.yaml", "--out"}, "`--out` needs a value. Write `--out FOLDER`."},
             {{"run", "p.yaml", "--out", ""}, "`--out` is empty. Write a folder, as in `--out out/first`."},
             {{"run", "p.yaml", "--out", "a", "--out", "b"}, "`--out` is given 2 times. Write it once."},
             {{"run", "p.yaml", "--mode", "test"}, "`--mode` is `test`. Write `practice`, `exam` or `demo`."},
             {{"validate", "p.yaml", "--format", "xml"}, "`--format` is `xml`. Write `text`, `json` or `github`."},
             {{"run", "p.yaml", "--learner", "Jane Doe"}, "`--learner` must be a code of letters, digits"},
             {{"run", "p.yaml", "--learner", ""}, "`--learner` must be a code of letters, digits"},
             {{"run", "p.yaml", "--set", "spacing"},
              "`--set` is `spacing`. Write a path and a value, as in `--set accuracy.spacing=0.5 mm`."},
             {{"run", "p.yaml", "--set", "a b=1"}, "Write a path and a value"},
             {{"run", "p.yaml", "--variant", ""}, "`--variant` is empty. Write the id of a variant."},
             {{"schema", "bone"}, "`KIND` is `bone`. Write `procedure` or `anatomy`."},
             {{"validate"}, "which procedure? Write `kerf validate PROCEDURE.yaml`."},
             {{"list", "all"}, "`all` is one argument too many."},
             {{"list", "--out", "x"}, "there is no option `--out` of `kerf list`."},
             {{"describe", "a", "b"}, "`b` is one argument too many."},
         }) {
        const CommandLine line = read(words);
        EXPECT_EQ(line.exit_code, exit_bad_input) << says;
        EXPECT_EQ(line.command, "") << says;
        EXPECT_NE(line.answer.find(says), std::string::npos) << line.answer;
    }
}

}  // namespace
}  // namespace kerf
