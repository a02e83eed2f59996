// SPDX-License-Identifier: Apache-2.0
// 50 faults of physics, planted one at a time in the plugin template and in the shipped plugins, and what
// `kerf check --level 4` reports of each. For training and research; not for diagnosis, planning or deciding treatment.
//
//     ./dev bench faults          all: some tens of minutes. Results that are newer than `kerf` are kept
//     ./dev bench faults NAME …   those alone; `sound/burr`, `sound/drilling` … are the plugins without a fault
//
// Each fault is a patch in bench/strangers/faults. Its head lists the tests that would find the fault for its own
// reason; the lists were written before any fault was measured, except that of the drill's power. A fault that fails
// other tests only is found by chance.
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "bench/strangers/child.h"

namespace {

namespace fs = std::filesystem;
using namespace kerf::bench;
using Json = nlohmann::json;

const fs::path root = KERF_SOURCE_DIR, build = KERF_BUILD_DIR, work = build / "bench" / "faults";
const std::string burr = "examples/02_round_burr/round_burr.cpp";

struct Fault {
    std::string name, what, set;
    std::vector<std::string> found_by, files;  // `files`: the sources that the patch changes
    fs::path patch;
};

/// What `kerf check` reported.
struct Found {
    std::string verdict;  // "right", "by chance", "missed", or why there is no report
    std::string test, text;
};

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

Fault fault_of(const fs::path& patch) {
    Fault fault{.name = patch.stem().string(), .what = {}, .set = {}, .found_by = {}, .files = {}, .patch = patch};
    std::istringstream in(text_of(patch.string()));
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("fault: ")) fault.what = line.substr(7);
        if (line.starts_with("set: ")) fault.set = line.substr(5);
        if (line.starts_with("found-by: ")) fault.found_by = words_of(line.substr(10));
        if (line.starts_with("+++ b/")) fault.files.push_back(line.substr(6));
    }
    return fault;
}

/// The plugins without a fault, then the faults, sorted by set and name.
std::vector<Fault> all_faults() {
    std::vector<Fault> faults;
    for (const auto& entry : fs::directory_iterator(root / "bench/strangers/faults"))
        if (entry.path().extension() == ".patch") faults.push_back(fault_of(entry.path()));
    std::sort(faults.begin(), faults.end(),
              [](const Fault& a, const Fault& b) { return std::tie(a.set, a.name) < std::tie(b.set, b.name); });
    std::vector<Fault> all;
    for (const char* source : {"burr", "drilling", "sawing", "implant"})
        all.push_back(
            {.name = "sound/" + std::string(source),
             .what = "none",
             .set = "sound",
             .found_by = {},
             .files = {source == std::string("burr") ? burr : "plugins/" + std::string(source) + "/plugin.cpp"},
             .patch = {}});
    all.insert(all.end(), faults.begin(), faults.end());
    return all;
}

fs::path library_of(const Fault& fault) { return work / (fault.name + ".so"); }
fs::path report_of(const Fault& fault) { return work / (fault.name + ".json"); }

/// Returns nothing, or what went wrong.
std::string do_run(const std::vector<std::string>& command, const fs::path& folder) {
    const ChildEnd end = run_child(command, {.folder = folder.string(), .added = {}, .limit = 600.0});
    return end.code == 0 ? "" : command[0] + " ends with " + std::to_string(end.code) + ": " + end.out + end.err;
}

/// Builds the plugin with its fault from the sources of this tree, as kerf_add_plugin does. Of a shipped plugin only
/// the changed sources are compiled; the others come from its static library. Returns nothing, or what went wrong.
std::string build_library(const Fault& fault) {
    const fs::path box = work / "box" / fault.name, library = library_of(fault);
    fs::remove_all(box);
    std::vector<std::string> sources = fault.files;
    const fs::path plugin = fs::path(fault.files[0]).parent_path();
    const bool is_shipped = plugin.string().starts_with("plugins/");
    const std::string entry = (plugin / "plugin.cpp").string();
    if (is_shipped && std::find(sources.begin(), sources.end(), entry) == sources.end()) sources.push_back(entry);
    for (const std::string& source : sources) {
        fs::create_directories((box / source).parent_path());
        fs::copy_file(root / source, box / source);
    }
    if (!fault.patch.empty())
        if (std::string error = do_run({"patch", "-p1", "-s", "-i", fault.patch.string()}, box); !error.empty())
            return error;
    std::vector<std::string> command{KERF_COMPILER,
                                     "-std=c++20",
                                     "-O2",
                                     "-DNDEBUG",
                                     "-fPIC",
                                     "-shared",
                                     "-fvisibility=hidden",
                                     "-fvisibility-inlines-hidden",
                                     "-ffp-contract=off",
                                     "-fno-gnu-unique",
                                     "-Wl,--exclude-libs,ALL",
                                     "-Wl,--version-script=" + (root / "cmake/kerf_plugin.map").string(),
                                     "-I" + (root / "core/sdk/include").string(),
                                     "-I" + root.string(),
                                     "-I" + (root / plugin).string()};
    command.insert(command.end(), sources.begin(), sources.end());
    if (is_shipped) {
        // A name that begins with `kerf.` belongs to Kerf.
        std::string text = text_of((box / entry).string());
        text.replace(text.find("\"kerf."), 6, "\"example.");
        std::ofstream(box / entry) << text;
        command.push_back((build / plugin / ("libkerf_" + plugin.filename().string() + "_parts.a")).string());
    }
    fs::create_directories(library.parent_path());
    command.insert(command.end(), {"-o", library.string()});
    return do_run(command, box);
}

/// Checks the plugin. Returns nothing, or what went wrong.
std::string check(const Fault& fault) {
    const std::string kerf = (build / "bin/kerf").string(), report = report_of(fault).string();
    std::vector<std::string> causes{kerf, (build / "libexec/kerf/kerf-check-child").string(),
                                    library_of(fault).string()};
    std::erase_if(causes, [](const std::string& cause) { return !fs::exists(cause); });
    if (is_newer(report, causes)) return {};
    fs::remove(report);
    const ChildEnd end =
        run_child({kerf, "check", library_of(fault).string(), "--level", "4", "--format", "json", "--out", report},
                  {.folder = work.string(), .added = {{"KERF_BADGES", "off"}}, .limit = 900.0});
    if (!end.timed_out && fs::exists(report)) return {};
    return "`kerf check` ends with " + std::to_string(end.code) + ": " + end.out + end.err;
}

/// Compares the failed tests with those that find the fault for its own reason.
Found judge(const Fault& fault) {
    const Json report = Json::parse(text_of(report_of(fault).string()), nullptr, false);
    if (report.is_discarded()) return {.verdict = "no report", .test = {}, .text = {}};
    const Json& plugin = report["plugins"][0];
    if (const std::string error = plugin["error"]; !error.empty())
        return {.verdict = "no report", .test = {}, .text = error};
    Found found{.verdict = fault.patch.empty() ? "passes" : "missed", .test = {}, .text = {}};
    for (const Json& test : plugin["tests"]) {
        if (test["status"] != "failed") continue;
        const std::string id = test["id"];
        const bool is_right = std::find(fault.found_by.begin(), fault.found_by.end(), id) != fault.found_by.end();
        if (found.test.empty() || (is_right && found.verdict == "by chance"))
            found = {.verdict = is_right ? "right" : "by chance", .test = id, .text = test["text"]};
    }
    return found;
}

std::string in_one_line(std::string text) {
    text = text.substr(0, text.find('\n'));
    std::replace(text.begin(), text.end(), '|', '/');
    return text;
}

/// Builds and checks one, and prints its row. Returns the verdict.
std::string measure(const Fault& fault) {
    std::string error;
    std::vector<std::string> causes{(root / "core/sdk/include/kerf/abi.h").string()};
    for (const std::string& file : fault.files) causes.push_back((root / file).string());
    if (!fault.patch.empty()) causes.push_back(fault.patch.string());
    if (!is_newer(library_of(fault).string(), causes)) error = build_library(fault);
    if (error.empty()) error = check(fault);
    const Found found = error.empty() ? judge(fault) : Found{.verdict = "not measured", .test = {}, .text = error};
    std::printf("| %s | %s | %s | %s | %s |\n", fault.name.c_str(), fault.what.c_str(), found.verdict.c_str(),
                found.test.c_str(), in_one_line(found.text).c_str());
    std::fflush(stdout);
    return found.verdict;
}

}  // namespace

int main(int argc, char** argv) {
    std::puts("For training and research; not for diagnosis, planning or deciding treatment.\n");
    const std::vector<std::string> named(argv + 1, argv + argc);
    std::vector<Fault> faults = all_faults();
    for (const std::string& name : named)
        if (std::none_of(faults.begin(), faults.end(), [&](const Fault& f) { return f.name == name; })) {
            std::fprintf(stderr,
                         "there is no fault \"%s\". Name a file of bench/strangers/faults without its ending.\n",
                         name.c_str());
            return 2;
        }
    fs::create_directories(work);
    std::puts("| fault | what is wrong | found | first test that fails | its text |\n|---|---|---|---|---|");
    std::map<std::string, std::map<std::string, int>> counts;
    for (const Fault& fault : faults)
        if (named.empty() || std::find(named.begin(), named.end(), fault.name) != named.end())
            ++counts[fault.set][measure(fault)];
    std::puts("");
    for (const auto& [set, verdicts] : counts) {
        std::printf("%s set:", set.c_str());
        for (const auto& [verdict, count] : verdicts) std::printf(" %d %s;", count, verdict.c_str());
        std::puts("");
    }
}
