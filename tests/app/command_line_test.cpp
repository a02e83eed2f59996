// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "app/command_table.h"

namespace kerf::app {
namespace {

CommandLine read(std::vector<const char*> words) {
    words.insert(words.begin(), "kerf");
    return read_command_line(static_cast<int>(words.size()), words.data());
}

/// The options of a command line that is right.
template <class T>
T options_of(std::vector<const char*> words) {
    CommandLine line = read(std::move(words));
    EXPECT_EQ(line.answer, "");
    const T* options = std::get_if<T>(&line.options);
    EXPECT_NE(options, nullptr);
    return options != nullptr ? *options : T{};
}

TEST(CommandLine, ReadsEveryOptionOfRun) {
    const auto run = options_of<RunOptions>({"run", "p.yaml", "--anatomy", "a.yaml", "--hand", "expert", "--replay",
                                             "s.db", "--out", "o", "--learner", "L17", "--mode", "exam", "--headless"});
    EXPECT_EQ(run.procedure, "p.yaml");
    EXPECT_EQ(run.anatomy, "a.yaml");
    EXPECT_EQ(run.hand, "expert");
    EXPECT_EQ(run.replay, "s.db");
    EXPECT_EQ(run.out, "o");
    EXPECT_EQ(run.learner, "L17");
    EXPECT_EQ(run.mode, "exam");
    EXPECT_TRUE(run.is_headless);
    EXPECT_FALSE(run.is_watched);
    EXPECT_EQ(read({"run", "p.yaml"}).command->name, "run");
}

TEST(CommandLine, TakesSeveralFilesToValidateAndToRehearse) {
    const std::vector<std::string> files{"a.yaml", "b.yaml", "d.yaml"};
    const auto validate =
        options_of<ValidateOptions>({"validate", "a.yaml", "b.yaml", "--anatomy", "c.yaml", "d.yaml"});
    EXPECT_EQ(validate.procedures, files);
    EXPECT_EQ(validate.anatomy, "c.yaml");
    const auto rehearse =
        options_of<RehearseOptions>({"rehearse", "a.yaml", "b.yaml", "--anatomy", "c.yaml", "d.yaml"});
    EXPECT_EQ(rehearse.procedures, files);
    EXPECT_EQ(rehearse.anatomy, "c.yaml");
}

TEST(CommandLine, DescribesAllOrOne) {
    EXPECT_EQ(options_of<DescribeOptions>({"describe"}).component, "");
    EXPECT_EQ(options_of<DescribeOptions>({"describe", "kerf.saw/blade"}).component, "kerf.saw/blade");
}

TEST(CommandLine, ChangesAProcedureByVariantAndSettings) {
    for (const char* command : {"run", "validate", "rehearse", "plan", "preview", "expand"}) {
        const CommandLine line =
            read({command, "a.yaml", "--variant", "osteoporotic", "--set", "accuracy.spacing=0.5 mm", "--set",
                  "steps.drill.limits=~", "--patch", "b.yaml"});
        EXPECT_EQ(line.answer, "") << command;
        const ChangeOptions* changes = std::visit(
            [](const auto& options) -> const ChangeOptions* {
                if constexpr (std::is_base_of_v<ChangeOptions, std::decay_t<decltype(options)>>) return &options;
                return nullptr;
            },
            line.options);
        ASSERT_NE(changes, nullptr) << command;
        EXPECT_EQ(changes->variant, "osteoporotic");
        EXPECT_EQ(changes->patches, std::vector<std::string>{"b.yaml"});
        EXPECT_EQ(changes->settings, (std::vector<std::string>{"accuracy.spacing=0.5 mm", "steps.drill.limits=~"}));
    }
    EXPECT_FALSE(options_of<ValidateOptions>({"validate", "a.yaml"}).is_with_bone);
    EXPECT_TRUE(options_of<ValidateOptions>({"validate", "a.yaml", "--bone"}).is_with_bone);
}

TEST(CommandLine, TakesAProcedureBehindAnOptionThatMayBeRepeated) {
    const auto run = options_of<RunOptions>({"run", "--set", "time_limit=6 s", "p.yaml", "--out", "o"});
    EXPECT_EQ(run.procedure, "p.yaml");
    EXPECT_EQ(run.settings, std::vector<std::string>{"time_limit=6 s"});
    const auto validate = options_of<ValidateOptions>(
        {"validate", "--patch", "a.yaml", "--patch", "b.yaml", "p.yaml", "q.yaml", "--set", "a=1", "r.yaml"});
    EXPECT_EQ(validate.procedures, (std::vector<std::string>{"p.yaml", "q.yaml", "r.yaml"}));
    EXPECT_EQ(validate.patches, (std::vector<std::string>{"a.yaml", "b.yaml"}));
    const auto rehearse = options_of<RehearseOptions>({"rehearse", "--set", "a=1", "p.yaml", "--anatomy", "a.yaml"});
    EXPECT_EQ(rehearse.procedures, std::vector<std::string>{"p.yaml"});
}

TEST(CommandLine, NoRepeatableOptionTakesTheArgument) {
    int options = 0;
    for (const Command& command : command_table()) {
        if (command.arguments.empty() || command.when_missing.empty()) continue;
        for (const Parameter& option : command.options) {
            if (option.is_flag() || !command.has_many(option)) continue;
            ++options;
            const char* value = option.value.kind == ValueKind::setting ? "a=1" : "a.yaml";
            const CommandLine line =
                read({command.name.c_str(), option.name.c_str(), value, "first.yaml", option.name.c_str(), value});
            EXPECT_EQ(line.answer.find(command.when_missing), std::string::npos) << command.name << " " << option.name;
        }
    }
    EXPECT_GT(options, 5);
}

TEST(CommandLine, ExplainsOneCodeOrAll) {
    EXPECT_EQ(options_of<ExplainOptions>({"explain"}).code, "");
    EXPECT_EQ(options_of<ExplainOptions>({"explain", "E0412"}).code, "E0412");
}

TEST(CommandLine, PrintsTheSchemaOfOneKindOfDocument) {
    EXPECT_EQ(options_of<SchemaOptions>({"schema"}).kind, "procedure");
    EXPECT_EQ(options_of<SchemaOptions>({"schema", "anatomy"}).kind, "anatomy");
}

TEST(CommandLine, ReadsEveryOptionOfStability) {
    const auto stability = options_of<StabilityOptions>({"stability", "--quick", "--plugin", "kerf.saw", "--out", "o"});
    EXPECT_TRUE(stability.is_quick);
    EXPECT_EQ(stability.plugin, "kerf.saw");
    EXPECT_EQ(stability.out, "o");
    EXPECT_EQ(options_of<StabilityOptions>({"stability"}).plugin, "kerf.drilling");
}

TEST(CommandLine, ReadsEveryOptionOfChart) {
    const auto chart = options_of<ChartOptions>({"chart", "--quick", "--scene", "femur", "-o", "o"});
    EXPECT_TRUE(chart.is_quick);
    EXPECT_EQ(chart.scene, "femur");
    EXPECT_EQ(chart.out, "o");
}

TEST(CommandLine, ReadsEveryOptionOfCheck) {
    const auto check = options_of<CheckOptions>({"check", "a.so", "b.so", "--level", "5", "--exclude", "law",
                                                 "--reason", "slow", "--procedure", "p.yaml", "--format", "junit"});
    EXPECT_EQ(check.plugins, (std::vector<std::string>{"a.so", "b.so"}));
    EXPECT_EQ(check.level, 5);
    EXPECT_EQ(check.excluded, std::vector<std::string>{"law"});
    EXPECT_EQ(check.reasons, std::vector<std::string>{"slow"});
    EXPECT_EQ(check.procedures, std::vector<std::string>{"p.yaml"});
    EXPECT_EQ(check.format, "junit");
}

TEST(CommandLine, ReadsOutWithEveryCommandThatWrites) {
    for (const Command& command : command_table())
        for (const Parameter& option : command.options) {
            if (option.name != "--out") continue;
            for (const char* name : {"-o", "--out"}) {
                std::vector<const char*> words{command.name.c_str()};
                for (const Parameter& argument : command.arguments)
                    words.push_back(argument.value.words.empty() ? "x" : argument.value.words.front().c_str());
                words.insert(words.end(), {name, "place"});
                CommandLine line = read(words);
                ASSERT_EQ(line.answer, "") << command.name;
                EXPECT_EQ(*std::get<std::string*>(option.member(line.options)), "place") << command.name;
            }
        }
}

TEST(CommandLine, ReportsOneSession) {
    const auto report = options_of<ReportOptions>({"report", "session.db", "--out", "r.html"});
    EXPECT_EQ(report.session, "session.db");
    EXPECT_EQ(report.out, "r.html");
    EXPECT_NE(read({"report"}).answer.find("of which run? Write `kerf report SESSION.db`."), std::string::npos);
}

TEST(CommandLine, TakesAnEqualsSignBetweenOptionAndValue) {
    EXPECT_EQ(options_of<RunOptions>({"run", "p.yaml", "--out=o"}).out, "o");
}

TEST(CommandLine, TakesHelpBeforeOrAfterTheCommand) {
    for (const std::vector<const char*>& words :
         {std::vector<const char*>{"run", "--help"}, {"--help", "run"}, {"run", "p.yaml", "-h"}, {"help", "run"}}) {
        const CommandLine line = read(words);
        EXPECT_EQ(line.exit_code, exit_pass);
        EXPECT_NE(line.answer.find("Usage: kerf run"), std::string::npos) << line.answer;
        EXPECT_NE(line.answer.find("not for diagnosis"), std::string::npos);
    }
}

TEST(CommandLine, TakesVersionBeforeOrAfterTheCommand) {
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

TEST(CommandLine, ReportsMistakesWithACorrection) {
    for (const auto& [words, says] : {
             Wrong{{"--"}, "nothing to do. Write `kerf run PROCEDURE.yaml`"},
             {{"fly"}, "there is no command `fly`. Write `run`, `window`, `validate`"},
             {{"valdate", "p.yaml"}, "there is no command `valdate`. Write `kerf validate`."},
             {{"export", "bone.stl"}, "there is no command `export`. Write `import`, `report`"},
             {{"xeport", "a.db"}, "there is no command `xeport`. Write `kerf report`."},
             {{"eport", "a.db"}, "there is no command `eport`. Write `kerf report`."},
             {{"run"}, "which procedure? Write `kerf run PROCEDURE.yaml`."},
             {{"run", ""}, "`PROCEDURE` is empty. Write the name of a YAML file."},
             {{"run", "a.yaml", "b.yaml"}, "`b.yaml` is the second."},
             {{"run", "p.yaml", "--outt", "x"}, "there is no option `--outt` of `kerf run`. Write `--out`."},
             {{"run", "--quick"}, "there is no option `--quick` of `kerf run`. Write `--help`, `--anatomy`"},
             {{"run", "p.yaml", "--out"}, "`--out` needs a value. Write `--out FOLDER`."},
             {{"run", "p.yaml", "--out", ""}, "`--out` is empty. Write a folder, as in `--out out/first`."},
             {{"run", "p.yaml", "--out", "a", "--out", "b"}, "`--out` is given 2 times. Write it once."},
             {{"run", "p.yaml", "--mode", "test"}, "`--mode` is `test`. Write `practice`, `exam` or `demo`."},
             {{"validate", "p.yaml", "--format", "xml"}, "`--format` is `xml`. Write `text`, `json` or `github`."},
             {{"run", "p.yaml", "--learner", "Jane Doe"}, "`--learner` must be letters, digits"},
             {{"run", "p.yaml", "--learner", ""}, "`--learner` must be letters, digits"},
             {{"run", "p.yaml", "--set", "spacing"},
              "`--set` is `spacing`. Write a path and a value, as in `--set accuracy.spacing=0.5 mm`."},
             {{"run", "p.yaml", "--set", "a b=1"}, "Write a path and a value"},
             {{"run", "p.yaml", "--variant", ""}, "`--variant` is empty. Write the id of a variant."},
             {{"schema", "bone"}, "`KIND` is `bone`. Write `procedure`, `anatomy` or `station`."},
             {{"check", "a.so", "--level", "6"}, "`--level` is `6`. Write 1, 2, 3, 4 or 5."},
             {{"completion"}, "for which shell? Write `kerf completion bash`."},
             {{"completion", "csh"}, "`SHELL` is `csh`, expected `bash`, `zsh` or `fish`. Write `zsh`."},
             {{"privacy"}, "which file? Write `kerf privacy FILE`."},
             {{"new"}, "what? Write `kerf new plugin NAME` or `kerf new procedure NAME`."},
             {{"new", "plugin", "x", "--strateggy"},
              "there is no option `--strateggy` of `kerf new`. Write `--strategy`."},
             {{"validate"}, "which procedure? Write `kerf validate PROCEDURE.yaml`."},
             {{"list", "all"}, "`all` is one argument too many."},
             {{"list", "--out", "x"}, "there is no option `--out` of `kerf list`."},
             {{"describe", "a", "b"}, "`b` is one argument too many."},
         }) {
        const CommandLine line = read(words);
        EXPECT_EQ(line.exit_code, exit_bad_input) << says;
        EXPECT_EQ(line.command, nullptr) << says;
        EXPECT_NE(line.answer.find(says), std::string::npos) << line.answer;
    }
}

}  // namespace
}  // namespace kerf::app
