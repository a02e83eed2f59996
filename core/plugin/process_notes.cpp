// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/process_notes.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>

#include "core/plugin/plain_text.h"

namespace kerf {

namespace {

constexpr std::size_t max_plugins = 1024, text_size = 1 << 20;
constexpr int no_word = -1;

/// A loaded plugin. Its texts are offsets into `Page::text`; the ids of the components follow each other there.
struct PluginRow {
    std::uintptr_t entry, first;
    std::uint32_t id, file, path, components, texts_end;
    std::atomic<std::uint32_t> count;  ///< of components; 0: unloaded
};

/// Memory that a parent and its child have in common. Rows are only added, so that a signal handler may read them.
struct Page {
    std::array<ThreadCall, max_calling_threads> calls;
    std::atomic<std::size_t> calling_threads{0};
    std::atomic<int> speaker{0}, word{no_word};
    std::atomic<std::size_t> plugin_count{0};
    std::uint32_t text_used;
    char record[4096];
    PluginRow plugins[max_plugins];
    char text[text_size];
};

Page own_page;
Page* page = &own_page;
thread_local ThreadCall* own_call = nullptr;
thread_local bool is_calling = false;

CallInProgress read(const ThreadCall& thread, bool may_be_over) noexcept {
    std::uint32_t call = thread.call.load(std::memory_order_acquire);
    if (call == 0 && may_be_over) call = thread.last.load(std::memory_order_relaxed);
    return {static_cast<PluginCall>(call), thread.component.load(std::memory_order_relaxed),
            thread.count.load(std::memory_order_relaxed)};
}

/// Appends a text with its zero. Returns its offset, or that of an empty text if the page is full.
std::uint32_t keep(std::string_view text) noexcept {
    if (page->text_used == 0) page->text[page->text_used++] = '\0';
    if (text.size() + 1 > text_size - page->text_used) return 0;
    const std::uint32_t at = page->text_used;
    std::memcpy(page->text + at, text.data(), text.size());
    page->text[at + text.size()] = '\0';
    page->text_used += static_cast<std::uint32_t>(text.size() + 1);
    return at;
}

/// Whether a row has the texts that were just appended from `begin` on.
bool has_texts(const PluginRow& row, std::uint32_t begin) noexcept {
    const std::uint32_t size = page->text_used - begin;
    return row.texts_end - row.id == size && std::memcmp(page->text + row.id, page->text + begin, size) == 0;
}

}  // namespace

const char* to_text(PluginCall call) noexcept {
    static constexpr std::array names{"",     "shape", "begin", "resist", "commit", "remesh",
                                      "find", "open",  "read",  "write",  "close",  "problem"};
    const auto index = static_cast<std::size_t>(call);
    return index < names.size() ? names[index] : "";
}

bool begin_common_notes() noexcept {
    void* memory = mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return false;
    page = new (memory) Page;
    return true;
}

CallNote::CallNote(PluginCall call, const kerf_component& component) noexcept {
    if (own_call == nullptr) own_call = &page->calls[page->calling_threads.fetch_add(1) % max_calling_threads];
    const auto id = static_cast<std::uint32_t>(call);
    own_call->component.store(&component, std::memory_order_relaxed);
    own_call->count.store(own_call->count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    own_call->last.store(id, std::memory_order_relaxed);
    own_call->call.store(id, std::memory_order_release);
    is_calling = true;
    std::atomic_signal_fence(std::memory_order_seq_cst);
}

CallNote::~CallNote() {
    std::atomic_signal_fence(std::memory_order_seq_cst);
    is_calling = false;
    own_call->call.store(0, std::memory_order_release);
}

CallInProgress call_in_progress() noexcept {
    if (is_calling) return read(*own_call, false);
    for (const ThreadCall& other : page->calls)
        if (const CallInProgress now = read(other, false); now.call != PluginCall::none) return now;
    return {};
}

CallInProgress call_in_progress_of(std::size_t thread) noexcept { return read(page->calls[thread], false); }

CallInProgress last_call() noexcept {
    CallInProgress last;
    for (const ThreadCall& thread : page->calls)
        if (const CallInProgress call = read(thread, true); call.count > last.count) last = call;
    return last;
}

bool is_calling_plugin() noexcept { return is_calling; }

void register_components(const kerf_entry& entry, const std::string& path) {
    const std::size_t count = page->plugin_count.load();
    const std::uint32_t before = page->text_used;
    PluginRow made{};
    made.entry = reinterpret_cast<std::uintptr_t>(&entry);
    made.first = reinterpret_cast<std::uintptr_t>(entry.components);
    made.id = keep(plain(entry.plugin_id));
    made.file = keep(plain(std::filesystem::path(path).filename().string()));
    made.path = keep(plain(path));
    made.components = page->text_used;
    std::uint32_t named = 0;
    while (named < entry.component_count && keep(plain(entry.components[named].id)) != 0) ++named;
    made.texts_end = page->text_used;

    PluginRow* row = std::find_if(page->plugins, page->plugins + count, [&](const PluginRow& other) {
        return other.count.load() == 0 && before != 0 && has_texts(other, made.id);
    });
    const bool is_again = row != page->plugins + count;  // the same plugin was loaded and unloaded before
    if (is_again) page->text_used = before;
    if (!is_again && count == max_plugins) return;
    row->entry = made.entry;
    row->first = made.first;
    if (!is_again) {
        row->id = made.id, row->file = made.file, row->path = made.path;
        row->components = made.components, row->texts_end = made.texts_end;
    }
    row->count.store(named);
    if (!is_again) page->plugin_count.store(count + 1);
}

void unregister_components(const kerf_entry* entry) noexcept {
    const auto at = reinterpret_cast<std::uintptr_t>(entry);
    for (std::size_t i = 0; i < page->plugin_count.load(); ++i)
        if (page->plugins[i].entry == at) page->plugins[i].count.store(0);
}

ComponentName name_of(const kerf_component* component) noexcept {
    const auto at = reinterpret_cast<std::uintptr_t>(component);
    for (std::size_t i = page->plugin_count.load(); i-- > 0;) {
        const PluginRow& row = page->plugins[i];
        if (at < row.first || at >= row.first + row.count.load() * sizeof(kerf_component)) continue;
        const char* id = page->text + row.components;
        for (std::size_t skipped = (at - row.first) / sizeof(kerf_component); skipped > 0; --skipped)
            id += std::strlen(id) + 1;
        return {page->text + row.id, page->text + row.file, page->text + row.path, id};
    }
    return {};
}

void note_record(const std::string& path) noexcept {
    const std::size_t count = std::min(path.size(), sizeof page->record - 1);
    std::memcpy(page->record, path.data(), count);
    page->record[count] = '\0';
}

const char* noted_record() noexcept { return page->record; }

void say_last_word(int exit_code) noexcept {
    if (page->speaker.load() == getpid()) page->word.store(exit_code);
}

void allow_last_word(int process) noexcept { page->speaker.store(process); }

std::optional<int> last_word() noexcept {
    const int word = page->word.load();
    return word == no_word ? std::nullopt : std::optional(word);
}

}  // namespace kerf
