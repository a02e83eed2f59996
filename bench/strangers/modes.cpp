// SPDX-License-Identifier: Apache-2.0
// 200 faults of a hostile plugin, one at a time in a run of their own, and how each run ends. For training and
// research; not for diagnosis, planning or deciding treatment.
//
//     ./dev bench modes          all: some tens of minutes. What is measured and newer than `kerf` is not run again
//     ./dev bench modes NAME …   those alone, and the sound plugin that they are compared with
//
// The plugin is tests/animals/hostile_plugin.cpp with the further faults of bench/strangers/modes. It lies alone in the
// folder of plugins; the run has a time limit of 60 s. Some faults stop or kill their parent process: each run has a
// session of its own.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/strangers/child.h"

namespace {

namespace fs = std::filesystem;
using namespace kerf::bench;
using Json = nlohmann::json;

const fs::path root = KERF_SOURCE_DIR, build = KERF_BUILD_DIR, work = build / "bench" / "modes";
const std::string program = (build / "bin/kerf").string();
const std::string sound = "nothing_wrong";

struct Mode {
    std::string name, kind;
};

/// How the run of a mode ended, and `kerf list` with its plugin.
struct Ran {
    int code = 0, left = 0;
    double seconds = 0.0;
    bool timed_out = false, list_is_sound = true;
    std::string out, err, list_err;
};

// The classes, the good ones first.
constexpr const char *refused = "refused, named", *released = "released, named", *ended = "ended, named",
                     *without_effect = "without effect", *changed_named = "changed, named",
                     *changed = "changed, unnamed", *released_unnamed = "released, unnamed",
                     *no_verdict = "exit code 0 without a verdict", *endless = "no end", *killed = "killed",
                     *interrupted = "interrupted, unnamed", *blamed = "ended, another thing blamed",
                     *as_kerf = "its text passes as Kerf's";
constexpr const char* classes[] = {refused,     released,         ended,      without_effect, changed_named,
                                   changed,     released_unnamed, no_verdict, endless,        killed,
                                   interrupted, blamed,           as_kerf};
constexpr int good_classes = 5;

std::vector<Mode> all_modes() {
    std::vector<Mode> modes{{.name = sound, .kind = "sound"}};
    std::istringstream in(text_of((root / "bench/strangers/modes/modes.txt").string()));
    std::string kind;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("#")) continue;
        if (line.ends_with(":")) {
            kind = line.substr(0, line.size() - 1);
            continue;
        }
        std::istringstream words(line);
        for (std::string name; words >> name;) modes.push_back({.name = name, .kind = kind});
    }
    return modes;
}

/// Links the plugin with one fault.
bool link_plugin(const std::string& name, const fs::path& box) {
    const ChildEnd end =
        run_child({KERF_COMPILER, "-shared", "-fPIC", "-fvisibility=hidden", "-DKERF_HOW=\"" + name + "\"",
                   "-Wl,--version-script=" + (root / "cmake/kerf_plugin.map").string(),
                   (root / "tests/animals/animal_name.cpp").string(), "-Wl,--whole-archive", KERF_HOSTILE_PARTS,
                   "-Wl,--no-whole-archive", "-o", (box / "plugins/strange.so").string()},
                  {.folder = box.string(), .added = {}, .limit = 300.0});
    if (end.code != 0) std::fprintf(stderr, "%s: the plugin does not link: %s\n", name.c_str(), end.err.c_str());
    return end.code == 0;
}

/// The id that the plugin of a mode has.
std::string id_of(const std::string& name) {
    return name == "bears_a_name_of_kerf"   ? "kerf.drilling"
           : name == "named_kerf_something" ? "kerf.hostile"
                                            : "test.hostile";
}

bool write_procedure(const std::string& name, const fs::path& box) {
    std::string text = text_of((root / "bench/strangers/modes/hostile.yaml").string());
    const std::string id = "test.hostile";
    text.replace(text.find(id), id.size(), id_of(name));
    fs::copy(root / "procedures/anatomy", box / "anatomy", fs::copy_options::recursive);
    return static_cast<bool>(std::ofstream(box / "procedure.yaml") << text);
}

std::string tail_of(const std::string& text) { return text.size() > 8000 ? text.substr(text.size() - 8000) : text; }

/// Runs a mode in a folder of its own and keeps what it did. False if its plugin could not be built.
bool run_mode(const std::string& name, const fs::path& result) {
    const fs::path box = work / "box" / name;
    fs::remove_all(box);
    fs::create_directories(box / "plugins");
    if (!link_plugin(name, box) || !write_procedure(name, box)) return false;
    // A badge's warning would name every plugin; it is no sign that Kerf noticed the fault.
    const ChildPlan plan{.folder = box.string(),
                         .added = {{"KERF_PLUGIN_PATH", (box / "plugins").string()}, {"KERF_BADGES", "off"}},
                         .limit = 60.0};
    const ChildEnd list = run_child({program, "list"}, plan);
    const ChildEnd run = run_child({program, "run", "procedure.yaml", "--out", "out"}, plan);
    const bool is_listed = list.code == 0 && list.out.find("kerf.drilling") != std::string::npos;
    const Json all{{"code", run.code},           {"left", run.left},
                   {"seconds", run.seconds},     {"timed_out", run.timed_out},
                   {"list_is_sound", is_listed}, {"out", tail_of(run.out)},
                   {"err", tail_of(run.err)},    {"list_err", tail_of(list.err)}};
    std::ofstream(result) << all.dump(1, ' ', false, Json::error_handler_t::replace) << "\n";
    std::error_code none;
    fs::remove_all(box, none);
    return true;
}

/// Returns false if there is no result that could be read.
bool read_result(const fs::path& result, Ran& ran) {
    const Json all = Json::parse(text_of(result.string()), nullptr, false);
    if (all.is_discarded()) return false;
    ran.code = all["code"];
    ran.left = all["left"];
    ran.seconds = all["seconds"];
    ran.timed_out = all["timed_out"];
    ran.list_is_sound = all["list_is_sound"];
    ran.out = all["out"];
    ran.err = all["err"];
    ran.list_err = all["list_err"];
    return true;
}

/// Returns the word after the last `mark`, or nothing.
std::string after(const std::string& text, const std::string& mark) {
    const std::size_t at = text.rfind(mark);
    if (at == std::string::npos) return {};
    const std::size_t begin = at + mark.size();
    return text.substr(begin, text.find_first_of(" \n", begin) - begin);
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

bool names_the_plugin(const std::string& text) {
    return text.find("test.hostile") != std::string::npos || text.find("strange.so") != std::string::npos;
}

/// How a run ended that reached its end by itself.
const char* class_of_end(const Ran& ran, const std::string& sound_hash) {
    const std::string verdict = after(ran.out, "verdict: "), hash = after(ran.out, ", hash ");
    const bool is_named = names_the_plugin(ran.out + ran.err);
    if (ran.code == 0 && verdict.empty()) return no_verdict;
    if (ran.code == 0 && hash == sound_hash) return without_effect;
    if (ran.code == 1 && verdict == "invalid") return is_named ? released : released_unnamed;
    if (ran.code <= 1) return is_named ? changed_named : changed;
    if (ran.code == 2) return names_the_plugin(ran.out + ran.err + ran.list_err) ? refused : blamed;
    if (ran.code == 3 && ran.err.find("interrupted; the results") != std::string::npos && !is_named) return interrupted;
    return ran.code == 3 && names_the_plugin(ran.err) ? ended : blamed;
}

const char* class_of(const Ran& ran, const std::string& sound_hash) {
    if (ran.timed_out) return endless;
    if (ran.code >= 128) return names_the_plugin(ran.err) ? ended : killed;
    if (count_of(ran.out, "verdict: ") > 1 || ran.err.find("E0101") != std::string::npos) return as_kerf;
    return class_of_end(ran, sound_hash);
}

std::string note_of(const Ran& ran) {
    std::string note = ran.list_is_sound ? "" : "; `kerf list` fails";
    if (ran.left > 0) note += "; " + std::to_string(ran.left) + " processes left";
    return note;
}

/// Returns the first line that names the plugin, or else the last line of stderr.
std::string line_of(const Ran& ran) {
    std::istringstream in(ran.err + ran.out);
    std::string last;
    for (std::string line; std::getline(in, line);)
        if (names_the_plugin(line)) return line;
    std::istringstream err(ran.err);
    for (std::string line; std::getline(err, line);)
        if (!line.empty()) last = line;
    return last;
}

using Table = std::map<std::string, std::map<std::string, int>>;  // by kind and class

void print_table(const std::vector<std::string>& kinds, const Table& counts) {
    std::printf("\n| kind |");
    for (const char* one : classes) std::printf(" %s |", one);
    std::printf("\n|---|");
    for (std::size_t i = 0; i < std::size(classes); ++i) std::printf("---|");
    std::map<std::string, int> sums;
    for (const std::string& kind : kinds) {
        std::printf("\n| %s |", kind.c_str());
        for (const char* one : classes) {
            const auto row = counts.find(kind);
            const auto cell = row->second.find(one);
            const int count = cell == row->second.end() ? 0 : cell->second;
            sums[one] += count;
            std::printf(" %d |", count);
        }
    }
    std::printf("\n| all |");
    for (const char* one : classes) std::printf(" %d |", sums[one]);
    std::puts("");
}

}  // namespace

int main(int argc, char** argv) {
    std::puts("For training and research; not for diagnosis, planning or deciding treatment.\n");
    const std::vector<std::string> named(argv + 1, argv + argc);
    const std::vector<Mode> modes = all_modes();
    for (const std::string& name : named)
        if (std::none_of(modes.begin(), modes.end(), [&](const Mode& m) { return m.name == name; })) {
            std::fprintf(stderr, "there is no fault \"%s\". Name one of bench/strangers/modes/modes.txt.\n",
                         name.c_str());
            return 2;
        }
    fs::create_directories(work);
    std::string sound_hash;
    std::vector<std::string> kinds;
    Table counts;
    std::puts("| fault | how its run ends | exit code | s | text |\n|---|---|---|---|---|");
    for (const auto& [name, kind] : modes) {
        if (name != sound && !named.empty() && std::find(named.begin(), named.end(), name) == named.end()) continue;
        const fs::path result = work / (name + ".json");
        Ran ran;
        if (!is_newer(result.string(), {program, KERF_HOSTILE_PARTS}) && !run_mode(name, result)) continue;
        if (!read_result(result, ran)) continue;
        if (name == sound) sound_hash = after(ran.out, ", hash ");
        const char* how = class_of(ran, sound_hash);
        std::printf("| %s | %s%s | %d | %.1f | %s |\n", name.c_str(), how, note_of(ran).c_str(), ran.code, ran.seconds,
                    line_of(ran).c_str());
        std::fflush(stdout);
        if (name == sound && how != std::string(without_effect)) {
            std::fprintf(stderr, "the sound plugin does not pass, so nothing can be compared with it:\n%s%s",
                         ran.out.c_str(), ran.err.c_str());
            return 1;
        }
        if (name == sound) continue;
        if (kinds.empty() || kinds.back() != kind) kinds.push_back(kind);
        ++counts[kind][how];
    }
    print_table(kinds, counts);
}
