// SPDX-License-Identifier: Apache-2.0
// Level 1: the file, its loading and its tables. Nothing is loaded for these tests: they load it themselves.
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "conformance/elf_symbols.h"
#include "conformance/law_walk.h"
#include "conformance/subject.h"
#include "conformance/test_groups.h"
#include "core/plugin/check_tables.h"
#include "core/plugin/elf_file.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/process_state.h"

namespace kerf::conformance {

namespace {

std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t most = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i > 0 ? ", " : "") + quoted_plain(names[i]);
    if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
    return text;
}

void* open_plugin(Examination& exam) {
    void* const handle = dlopen(exam.path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        const char* reason = dlerror();
        exam.fail("The dynamic linker refuses it: " + plain(reason != nullptr ? reason : "unknown reason") + ".");
    }
    return handle;
}

const kerf_entry* entry_of(void* handle) {
    return handle == nullptr ? nullptr : static_cast<const kerf_entry*>(dlsym(handle, KERF_ENTRY_SYMBOL));
}

// ---- the file -----------------------------------------------------------------------------------------------------

void is_file(Examination& exam) {
    if (const std::string fault = refusal_of_file(exam.path); !fault.empty()) exam.fail("The file " + fault);
}

void opens(Examination& exam) { static_cast<void>(open_plugin(exam)); }

void has_entry(Examination& exam) {
    if (void* const handle = open_plugin(exam); handle != nullptr && entry_of(handle) == nullptr)
        exam.fail("It exports no `" KERF_ENTRY_SYMBOL "`. Write KERF_PLUGIN(…), or declare the entry visible.");
}

void exports_one_symbol(Examination& exam) {
    const auto symbols = elf_symbols(exam.path);
    if (!symbols) return exam.skip("its sections were stripped, so its symbols cannot be read");
    std::vector<std::string> others;
    for (const std::string& name : symbols->exported)
        if (name != KERF_ENTRY_SYMBOL) others.push_back(name);
    if (!others.empty())
        exam.fail("It exports " + listed(others) +
                  " beside `" KERF_ENTRY_SYMBOL
                  "`: another library may bind to them. Build it with -fvisibility=hidden, as kerf_add_plugin() does.");
}

void unloads(Examination& exam) {
    void* const handle = open_plugin(exam);
    if (handle == nullptr) return;
    dlclose(handle);
    void* const still = dlopen(exam.path.c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (still == nullptr) return;
    const auto symbols = elf_symbols(exam.path);
    exam.fail("It stays loaded after it was closed" +
              (symbols && !symbols->unique.empty() ? ", because of the unique symbol " + listed(symbols->unique)
                                                   : std::string()) +
              ". Build it with -fno-gnu-unique, as kerf_add_plugin() does, without thread-local objects.");
}

void names_no_folder(Examination& exam) {
    const auto symbols = elf_symbols(exam.path);
    if (!symbols) return exam.skip("its sections were stripped");
    for (const std::string& folder : symbols->run_path)
        if (!folder.starts_with("$ORIGIN"))
            return exam.fail("It searches libraries in the folder " + quoted_plain(folder) +
                             " of the machine that built it. Build it without that run path.");
}

void needs_no_executable_stack(Examination& exam) {
    const auto symbols = elf_symbols(exam.path);
    if (!symbols) return exam.skip("its sections were stripped");
    if (symbols->has_executable_stack)
        exam.fail("It asks for an executable stack, which makes the whole process less safe. Build it without "
                  "nested functions and with -z noexecstack.");
}

// ---- its loading --------------------------------------------------------------------------------------------------

void prints_nothing(Examination& exam) {
    if (open_plugin(exam) == nullptr) return;
    std::fflush(nullptr);
    struct stat written {};
    fstat(STDOUT_FILENO, &written);  // both streams go there
    if (written.st_size > 0) exam.fail("It prints while it is loaded.");
}

/// Compares a part of the process before and after loading.
template <class Compare>
void leaves(Examination& exam, Compare compare) {
    const ProcessState before = process_state();
    if (open_plugin(exam) == nullptr) return;
    compare(before, process_state());
}

void leaves_rounding(Examination& exam) {
    leaves(exam, [&](const ProcessState& before, const ProcessState& after) {
        if (before.rounding == after.rounding) return;
        char text[200];
        std::snprintf(text, sizeof text,
                      "Loading it changes the control word of the floating-point unit from %08x to %08x, for all of "
                      "the host. Build it without -ffast-math.",
                      before.rounding, after.rounding);
        exam.fail(text);
    });
}

void leaves_handlers(Examination& exam) {
    leaves(exam, [&](const ProcessState& before, const ProcessState& after) {
        for (std::size_t i = 0; i < before.shared.handlers.size(); ++i)
            if (before.shared.handlers[i] != after.shared.handlers[i])
                return exam.fail("Loading it changes the handler of signal " + std::to_string(i) + " (" +
                                 strsignal(static_cast<int>(i)) + "), which is the host's.");
    });
}

void leaves_files(Examination& exam) {
    leaves(exam, [&](const ProcessState& before, const ProcessState& after) {
        if (const auto more = further(before.files, after.files); !more.empty())
            exam.fail("Loading it leaves files open: " + listed(more) + ".");
    });
}

void leaves_surroundings(Examination& exam) {
    leaves(exam, [&](const ProcessState& before, const ProcessState& after) {
        if (before.locale != after.locale)
            return exam.fail("Loading it changes the locale from " + quoted_plain(before.locale) + " to " +
                             quoted_plain(after.locale) + ".");
        if (const StateChange change = change_between(before.shared, after.shared); change.has_happened())
            return exam.fail("Loading it changes " + plain(change.text()) + ".");
        if (const auto more = further(before.environment, after.environment); !more.empty())
            return exam.fail("Loading it changes the environment: " + listed(more) + ".");
    });
}

void starts_no_thread(Examination& exam) {
    leaves(exam, [&](const ProcessState&, const ProcessState& after) {
        if (after.threads > 1)
            exam.fail("Loading it leaves " + std::to_string(after.threads - 1) + " thread(s) running.");
    });
}

// ---- its tables ---------------------------------------------------------------------------------------------------

void speaks_this_abi(Examination& exam) {
    const kerf_entry* const entry = entry_of(open_plugin(exam));
    if (entry == nullptr) return;
    const kerf_layout layout = KERF_LAYOUT_INIT;
    if (entry->magic != KERF_MAGIC || entry->abi != KERF_ABI_VERSION || entry->size != sizeof *entry ||
        std::memcmp(&entry->layout, &layout, sizeof layout) != 0)
        exam.fail(fault_of(*entry));
}

void has_sound_tables(Examination& exam) {
    const kerf_entry* const entry = entry_of(open_plugin(exam));
    if (entry == nullptr) return;
    if (const std::string fault = fault_of(*entry); !fault.empty()) exam.fail("In its tables, " + fault);
}

bool is_version(const std::string& text) {
    int parts = 0;
    for (std::size_t at = 0; at < text.size(); ++parts) {
        const std::size_t digits = std::min(text.find_first_not_of("0123456789", at), text.size());
        if (digits == at) return false;
        if (parts == 2) return digits == text.size() || text[digits] == '-' || text[digits] == '+';
        if (digits >= text.size() || text[digits] != '.') return false;
        at = digits + 1;
    }
    return false;
}

void has_version_and_licence(Examination& exam) {
    const kerf_entry& entry = exam.subject->plugin->entry();
    if (!is_version(entry.plugin_version))
        exam.fail("Its version is " + quoted_plain(entry.plugin_version) +
                  ", expected three numbers: a session records it. Write `0.1.0`.");
    else if (*entry.licence == '\0')
        exam.fail("It names no licence. Write an SPDX identifier, as `Apache-2.0`.");
}

/// All that the tables say, as text.
std::string fingerprint(const kerf_entry& entry) {
    std::string text = std::string(entry.plugin_id) + entry.plugin_version + entry.licence;
    const auto add = [&](const std::vector<ParameterInfo>& rows) {
        for (const ParameterInfo& row : rows)
            text += "\n" + row.id + "|" + row.help + "|" + row.display_unit + "|" + std::to_string(row.min) + "|" +
                    std::to_string(row.max) + "|" + std::to_string(row.def) + "|" + row.source;
    };
    for (std::uint32_t c = 0; c < entry.component_count; ++c) {
        const ComponentInfo info = describe(entry.plugin_id, entry.components[c]);
        text += "\n" + info.id + "|" + info.help;
        add(info.parameters);
        add(info.drives);
        for (const SignalInfo& row : info.signals) text += "\n" + row.id + "|" + row.help + "|" + row.display_unit;
        for (const EventInfo& row : info.events) text += "\n" + row.id + "|" + row.help;
    }
    return text;
}

void keeps_its_tables(Examination& exam) {
    const kerf_entry& entry = exam.subject->plugin->entry();
    const std::string before = fingerprint(entry);
    for (const SubjectName& name : subjects_of(entry)) {
        if (name.scope != Scope::law) continue;
        const Subject law = subject_of(exam.subject->plugin, name);
        Examination walked(exam.path, &law);
        walk(walked, {}, short_path(), {});
    }
    const std::string after = fingerprint(entry);
    if (before == after) return;
    const auto differ = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
    const auto from = static_cast<std::size_t>(differ.first - before.begin());
    const std::size_t line = after.rfind('\n', from) == std::string::npos ? 0 : after.rfind('\n', from) + 1;
    exam.fail("Its tables change while it is used. The row that differs first is now " +
              quoted_plain(after.substr(line, 200)) + ".");
}

constexpr Test tests[] = {
    {"load.file", 1, Scope::file, "It is a whole shared library of this machine.", &is_file},
    {"load.opens", 1, Scope::file, "The dynamic linker loads it, and its constructors return.", &opens, "load.file", 2},
    {"load.entry", 1, Scope::file, "It exports its entry.", &has_entry, "load.opens"},
    {"load.one_export", 1, Scope::file, "It exports nothing else.", &exports_one_symbol, "load.file"},
    {"load.unloads", 1, Scope::file, "It can be unloaded.", &unloads, "load.opens"},
    {"load.run_path", 1, Scope::file, "It names no folder of the machine that built it.", &names_no_folder,
     "load.file"},
    {"load.stack", 1, Scope::file, "It needs no executable stack.", &needs_no_executable_stack, "load.file"},
    {"load.silent", 1, Scope::file, "It prints nothing while it is loaded.", &prints_nothing, "load.opens"},
    {"load.rounding", 1, Scope::file, "Loading it leaves the floating-point unit as it was.", &leaves_rounding,
     "load.opens"},
    {"load.signals", 1, Scope::file, "Loading it leaves the signal handlers as they were.", &leaves_handlers,
     "load.opens"},
    {"load.files", 1, Scope::file, "Loading it leaves no file open.", &leaves_files, "load.opens"},
    {"load.surroundings", 1, Scope::file, "Loading it leaves locale, folder, mask and environment as they were.",
     &leaves_surroundings, "load.opens"},
    {"load.threads", 1, Scope::file, "Loading it leaves no thread running.", &starts_no_thread, "load.opens"},
    {"describe.abi", 1, Scope::file, "It speaks the ABI of this Kerf.", &speaks_this_abi, "load.entry"},
    {"describe.tables", 1, Scope::file, "Its tables are sound.", &has_sound_tables, "describe.abi"},
    {"describe.version", 1, Scope::plugin, "It has a version and a licence.", &has_version_and_licence,
     "describe.tables"},
};

constexpr Test tests_of_use[] = {
    {"describe.constant", 3, Scope::plugin, "Its tables stay the same while it is used.", &keeps_its_tables,
     "describe.tables"},
};

}  // namespace

std::span<const Test> load_tests() { return tests; }
std::span<const Test> use_tests() { return tests_of_use; }

}  // namespace kerf::conformance
