// SPDX-License-Identifier: Apache-2.0
// The `kerf` program. Exit codes: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/run_procedure.h"
#include "core/session/content_hash.h"
#include "core/session/read_session.h"

namespace {

using namespace kerf;

constexpr const char* usage =
    "usage: kerf run PROCEDURE.yaml [--anatomy ANATOMY.yaml] [--hand REHEARSAL] [--out FOLDER]\n"
    "                [--replay SESSION.db]\n"
    "                [--learner CODE] [--mode practice|exam|demo] [--headless]\n"
    "       kerf validate PROCEDURE.yaml [--anatomy ANATOMY.yaml]\n"
    "       kerf rehearse PROCEDURE.yaml [--anatomy ANATOMY.yaml]\n"
    "       kerf list\n"
    "For training and research; not for diagnosis, planning or deciding treatment.\n";

/// Plugins lie in ../lib/kerf of the program, and in KERF_PLUGIN_PATH (folders separated by `:`).
std::vector<std::string> plugin_folders() {
    std::vector<std::string> folders;
    if (const char* path = std::getenv("KERF_PLUGIN_PATH")) {
        std::string_view rest = path;
        while (!rest.empty()) {
            const auto end = rest.find(':');
            if (end != 0) folders.emplace_back(rest.substr(0, end));
            rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        }
    }
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) folders.push_back((self.parent_path().parent_path() / "lib" / "kerf").string());
    return folders;
}

struct Arguments {
    std::string command, file, anatomy, hand, out, learner, replay, mode = "practice";
    std::string error;
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    if (argc < 2) {
        a.error = "nothing to do.";
        return a;
    }
    a.command = argv[1];
    const auto value = [&](int& i, std::string& into) {
        if (i + 1 < argc)
            into = argv[++i];
        else
            a.error = std::string("`") + argv[i] + "` needs a value.";
    };
    for (int i = 2; i < argc && a.error.empty(); ++i) {
        const std::string_view word = argv[i];
        if (word == "--anatomy") value(i, a.anatomy);
        else if (word == "--hand") value(i, a.hand);
        else if (word == "--out") value(i, a.out);
        else if (word == "--replay") value(i, a.replay);
        else if (word == "--learner") value(i, a.learner);
        else if (word == "--mode") value(i, a.mode);
        else if (word == "--headless") continue;
        else if (word.starts_with("-")) a.error = "there is no option `" + std::string(word) + "`.";
        else if (a.file.empty()) a.file = word;
        else a.error = "one procedure at a time: `" + std::string(word) + "` is the second.";
    }
    if (a.error.empty() && a.mode != "practice" && a.mode != "exam" && a.mode != "demo")
        a.error = "`--mode` is `" + a.mode + "`. Write practice, exam or demo.";
    if (a.error.empty() && a.command != "list" && a.file.empty()) a.error = "which procedure? Name a YAML file.";
    return a;
}

void show_progress(double share, const std::string& what) {
    if (isatty(STDERR_FILENO) == 0) return;
    std::fprintf(stderr, "\r%3.0f %%  %s\033[K", 100.0 * share, what.c_str());
    if (share >= 1.0) std::fputc('\n', stderr);
}

void print(const RunSummary& s) {
    std::printf("verdict: %s\n", to_text(s.verdict));
    for (const auto& reason : s.reasons) std::printf("  %s\n", reason.c_str());
    for (const auto& m : s.metrics) std::printf("  %-34s %8.2f %s\n", m.id.c_str(), m.value / m.per_unit, m.unit.c_str());
    std::printf("  removed %.1f mm3, %.1f s simulated, force scale 1/%.0f, hash %016llx\n", s.removed * 1e9, s.duration,
                1.0 / s.force_scale, static_cast<unsigned long long>(s.hash));
}

}  // namespace

int main(int argc, char** argv) {
    const Arguments arguments = parse(argc, argv);
    if (arguments.command == "--help" || arguments.command == "-h" || arguments.command == "help") {
        std::fputs(usage, stdout);
        return 0;
    }
    if (arguments.command == "--version") {
        std::printf("kerf %s\n", KERF_VERSION);
        return 0;
    }
    const bool is_known = arguments.command == "run" || arguments.command == "validate" || arguments.command == "rehearse" || arguments.command == "list";
    if (!arguments.command.empty() && !is_known) {
        std::fprintf(stderr, "kerf: there is no command `%s`.\n%s", arguments.command.c_str(), usage);
        return 2;
    }
    if (!arguments.error.empty()) {
        std::fprintf(stderr, "kerf: %s\n%s", arguments.error.c_str(), usage);
        return 2;
    }

    PluginRegistry plugins;
    plugins.scan(plugin_folders());
    for (const auto& refusal : plugins.refusals()) std::fprintf(stderr, "%s\n", refusal.c_str());
    if (arguments.command == "list") {
        for (const auto& component : plugins.catalog())
            std::printf("%-5s %s/%s  %s\n", component.kind == KERF_KIND_TOOL ? "tool" : "force", component.plugin.c_str(),
                        component.id.c_str(), component.help.c_str());
        return 0;
    }
    Diagnostics diagnostics;
    const auto scene = make_scene(arguments.file, arguments.anatomy, plugins, diagnostics);
    if (!diagnostics.empty()) std::fputs(to_text(diagnostics).c_str(), stderr);
    if (!scene) return 2;
    for (const auto& note : scene->notes) std::fprintf(stderr, "%s\n", note.c_str());
    if (arguments.command == "validate") {
        std::printf("%s: no errors\n", arguments.file.c_str());
        return 0;
    }

    RunRequest request;
    request.learner = arguments.learner;
    request.mode = arguments.mode;
    request.progress = show_progress;
    if (arguments.command == "rehearse") {
        bool is_all_as_expected = true;
        for (const auto& rehearsal : scene->procedure.rehearsals) {
            request.rehearsal = rehearsal.id;
            const RunOutcome outcome = run_procedure(*scene, plugins, request);
            std::printf("%s: %s\n", rehearsal.id.c_str(), outcome.is_as_expected ? "ended as it says" : "DID NOT END AS IT SAYS");
            print(outcome.summary);
            is_all_as_expected = is_all_as_expected && outcome.is_as_expected;
        }
        return is_all_as_expected ? 0 : 1;
    }

    request.rehearsal = arguments.hand;
    std::string recorded_hash;
    if (!arguments.replay.empty()) {
        std::string error;
        auto recorded = read_session(arguments.replay, error);
        if (recorded && (recorded->procedure_text != scene->procedure.text || recorded->anatomy_hash != scene->anatomy_hash))
            error = arguments.replay + ": was recorded with another text of this procedure or anatomy, or with another scan, so it cannot end the same.";
        if (!error.empty()) {
            std::fprintf(stderr, "kerf: %s\n", error.c_str());
            return 2;
        }
        request.replay = std::move(recorded->device_from_handle);
        recorded_hash = recorded->hash;
    }
    request.out = arguments.out.empty() ? "out/" + scene->procedure.id : arguments.out;
    const RunOutcome outcome = run_procedure(*scene, plugins, request);
    if (!outcome.error.empty()) {
        std::fprintf(stderr, "kerf: %s\n", outcome.error.c_str());
        return outcome.is_bad_input ? 2 : 3;
    }
    print(outcome.summary);
    std::printf("  %s/report.html\n", request.out.c_str());
    if (!recorded_hash.empty()) {
        const bool is_same = recorded_hash == hex16(outcome.summary.hash);
        std::printf("  replay: %s\n", is_same ? "the same bits" : "NOT the same bits");
        if (!is_same) return 3;
    }
    if (outcome.summary.verdict == Verdict::pass) return 0;
    return 1;
}
