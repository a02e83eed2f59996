// SPDX-License-Identifier: Apache-2.0
#include "conformance/procedures.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include "conformance/child_program.h"
#include "core/plugin/plain_text.h"

namespace kerf::conformance {

namespace {

namespace fs = std::filesystem;

struct ProcedureTest {
    const char* id;
    const char* sentence;
};
constexpr ProcedureTest rehearsals{"procedure.rehearsals", "All rehearsals end as they expect."},
    replay{"procedure.replay", "A replay gives the same bits."},
    twin{"procedure.twin", "The same plugin from another compiler gives the same bits."};

/// A folder that goes with it.
class ScratchFolder {
public:
    ScratchFolder() {
        std::error_code none;
        std::string pattern = (fs::temp_directory_path(none) / "kerf-check-XXXXXX").string();
        if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] const fs::path& path() const noexcept { return path_; }

private:
    fs::path path_;
};

struct Ran {
    int exit_code = -1;
    std::string output;
};

Ran run(const CheckRequest& request, const fs::path& plugins, const std::vector<std::string>& arguments) {
    ChildProgram::Settings settings{
        .arguments = {request.program},
        .environment = {"KERF_PLUGIN_PATH=" + plugins.string(), "KERF_BADGES=off"},  // the verdict is not known yet
        .with_errors = true};
    settings.arguments.insert(settings.arguments.end(), arguments.begin(), arguments.end());
    ChildProgram program(settings);
    Ran ran;
    if (!program.error().empty()) return {-1, program.error()};
    for (std::string line; program.read_line(line, request.is_interrupted);) ran.output += plain(line) + "\n";
    if (!(request.is_interrupted && request.is_interrupted())) ran.exit_code = program.wait();
    return ran;
}

/// A folder with this plugin alone: of two plugins with one id the first is taken.
std::string put_alone(const std::string& plugin, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    fs::copy_file(plugin, folder / fs::path(plugin).filename(), fs::copy_options::overwrite_existing, error);
    return error ? plain(plugin) + " cannot be copied: " + error.message() + "." : std::string();
}

bool is_used_by(const std::string& plugin_id, const fs::path& procedure) {
    std::string escaped;
    for (const char c : plugin_id) escaped += c == '.' ? std::string("\\.") : std::string(1, c);
    std::ifstream in(procedure);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    return std::regex_search(text, std::regex("plugin:\\s*" + escaped + "\\b"));
}

std::vector<std::string> procedures_of(const CheckRequest& request, const std::string& plugin_id) {
    if (!request.procedures.empty()) return request.procedures;
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator file(request.shipped, error), end; !error && file != end; file.increment(error)) {
        if (file->path().extension() != ".yaml") continue;
        if (is_used_by(plugin_id, file->path())) found.push_back(file->path().string());
    }
    std::sort(found.begin(), found.end());
    return found;
}

void fail(TestResult& result, const std::string& text, const Ran& ran = {}) {
    result.status = Status::failed;
    result.text = text;
    result.output = ran.output;
}

/// Runs tests of level 5 and adds their results to a report.
class ProcedureTests {
public:
    ProcedureTests(const CheckRequest& request, PluginReport& report,
                   const std::function<void(const TestResult&)>& on_result)
        : request_(request), report_(report), on_result_(on_result) {}

    void skip_all(const std::string& reason) {
        for (const ProcedureTest& test : {rehearsals, replay, twin})
            add(test, "", [&](TestResult& result) { result.status = Status::skipped, result.text = reason; });
    }

    /// Runs the three tests with one procedure. `alone` is a folder that holds the plugin; `scratch` gets other files.
    void check(const std::string& plugin_id, const std::string& procedure, const fs::path& alone,
               const fs::path& scratch) {
        const std::string recorded = (scratch / "run").string(), again = (scratch / "again").string();
        const auto is_same = [&](TestResult& result, const fs::path& plugins, const std::string& whose) {
            check_replay(result, procedure, alone, plugins, whose, recorded, again);
        };
        add(rehearsals, procedure, [&](TestResult& result) { check_rehearsals(result, plugin_id, procedure, alone); });
        add(replay, procedure, [&](TestResult& result) { is_same(result, alone, "A replay"); });
        add(twin, procedure, [&](TestResult& result) {
            const fs::path twin_alone = scratch / "twin";
            if (request_.twin.empty()) {
                result.status = Status::skipped;
                result.text = "no twin is named: build the plugin with another compiler and write --twin";
            } else if (const std::string error = put_alone(request_.twin, twin_alone); !error.empty()) {
                fail(result, error);
            } else {
                is_same(result, twin_alone, "The twin");
            }
        });
        std::error_code ignored;
        fs::remove_all(recorded, ignored);
        fs::remove_all(again, ignored);
    }

private:
    void add(const ProcedureTest& test, const std::string& procedure, const std::function<void(TestResult&)>& body) {
        if (!request_.only.empty() && !std::regex_search(test.id, std::regex(request_.only))) return;
        TestResult result{test.id, 5, fs::path(procedure).filename().string(), test.sentence, Status::passed, "", "",
                          0,       {}};
        if (!procedure.empty()) result.options = {"--procedure", procedure};
        if (!request_.twin.empty()) result.options.insert(result.options.end(), {"--twin", request_.twin});
        for (const auto& [pattern, reason] : request_.excluded)
            if (std::regex_search(test.id, std::regex(pattern)))
                result.status = Status::skipped, result.text = "excluded: " + reason;
        if (result.status == Status::passed) {
            const auto begun = std::chrono::steady_clock::now();
            body(result);
            result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        }
        report_.results.push_back(result);
        if (on_result_) on_result_(result);
    }

    void check_rehearsals(TestResult& result, const std::string& plugin_id, const std::string& procedure,
                          const fs::path& alone) const {
        if (!is_used_by(plugin_id, procedure))
            return fail(result, "None of its instruments uses " + plugin_id + ". Name a procedure that does.");
        const Ran ran = run(request_, alone, {"rehearse", procedure});
        if (ran.exit_code != 0) fail(result, "`kerf rehearse` ends with " + std::to_string(ran.exit_code) + ".", ran);
    }

    /// Records a run with the plugin in `alone`, unless `recorded` has one, and replays it with that in `plugins`.
    void check_replay(TestResult& result, const std::string& procedure, const fs::path& alone, const fs::path& plugins,
                      const std::string& whose, const std::string& recorded, const std::string& again) const {
        if (!fs::exists(recorded + "/session.db")) {
            const Ran ran = run(request_, alone, {"run", procedure, "--out", recorded});
            if (ran.exit_code != 0 && ran.exit_code != 1)
                return fail(result, "`kerf run` ends with " + std::to_string(ran.exit_code) + ".", ran);
        }
        const Ran ran =
            run(request_, plugins, {"run", procedure, "--replay", recorded + "/session.db", "--out", again});
        if (ran.output.find("replay: the same bits") == std::string::npos)
            fail(result, whose + " does not give the same bits as the run that was recorded.", ran);
    }

    const CheckRequest& request_;
    PluginReport& report_;
    const std::function<void(const TestResult&)>& on_result_;
};

}  // namespace

std::vector<std::string> procedure_tests() { return {rehearsals.id, replay.id, twin.id}; }

void check_procedures(const CheckRequest& request, PluginReport& report,
                      const std::function<void(const TestResult&)>& on_result) {
    ProcedureTests tests(request, report, on_result);
    if (report.plugin.empty()) return tests.skip_all("the plugin cannot be loaded");
    const std::string plugin_id = report.plugin.substr(0, report.plugin.find(' '));
    const auto procedures = procedures_of(request, plugin_id);
    if (procedures.empty()) return tests.skip_all("no procedure uses it: name one with --procedure");
    const ScratchFolder scratch;
    if (scratch.path().empty()) {
        report.error =
            "no folder for the files of level 5 could be made. Set TMPDIR to a folder that you can write to.";
        return;
    }
    const fs::path alone = scratch.path() / "plugin";
    if (const std::string error = put_alone(report.path, alone); !error.empty()) return tests.skip_all(error);

    for (const std::string& procedure : procedures) {
        tests.check(plugin_id, procedure, alone, scratch.path());
        if (request.is_interrupted && request.is_interrupted()) {
            report.error = "interrupted";
            return;
        }
    }
}

}  // namespace kerf::conformance
