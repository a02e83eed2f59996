// SPDX-License-Identifier: Apache-2.0
#include "devices/hid/report_descriptor.h"

#include <optional>
#include <utility>

namespace kerf::hid {

namespace {

constexpr std::size_t max_bytes = 4096;  // of a descriptor in Linux
constexpr std::size_t max_fields = 1024, max_collections = 512, max_depth = 32, max_pushed = 16, max_usages = 1024;
constexpr std::uint32_t max_report_bits = 8 * 1024;

enum class Type : std::uint8_t { main, global, local, reserved };

enum Main : std::uint8_t { input = 8, output = 9, collection = 10, feature = 11, end_collection = 12 };
enum Global : std::uint8_t {
    usage_page,
    logical_minimum,
    logical_maximum,
    physical_minimum,
    physical_maximum,
    unit_exponent,
    unit,
    report_size,
    report_id,
    report_count,
    push,
    pop
};
enum Local : std::uint8_t { usage = 0, usage_minimum = 1, usage_maximum = 2, delimiter = 10 };

/// The data of a short item, whose sign depends on other items.
struct Data {
    std::uint32_t value = 0;
    std::size_t size = 0;  ///< [bytes]

    [[nodiscard]] std::int64_t as_signed() const noexcept {
        if (size == 0) return 0;
        const std::uint32_t sign = 1u << (8 * size - 1);
        const std::int64_t unsigned_value = value;
        return (value & sign) == 0 ? unsigned_value : unsigned_value - (std::int64_t{1} << (8 * size));
    }
};

std::int64_t maximum_of(const Data& maximum, std::int64_t minimum) noexcept {
    return minimum < 0 ? maximum.as_signed() : std::int64_t{maximum.value};
}

int exponent_of(const Data& data) noexcept {
    if (data.value > 0xf) return static_cast<int>(data.as_signed());
    return data.value < 8 ? static_cast<int>(data.value) : static_cast<int>(data.value) - 16;
}

struct Globals {
    std::uint16_t page = 0;
    Data logical_min{}, logical_max{}, physical_min{}, physical_max{}, exponent{};
    std::uint32_t unit = 0, size = 0, count = 0;
    std::uint8_t id = 0;
};

struct Locals {
    std::vector<UsageRange> usages{};
    std::optional<Data> first{};  ///< of a range whose last usage has not come yet
    bool is_delimited = false, has_alternative = false;
};

class Parser {
public:
    explicit Parser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    ParsedDescriptor run() {
        if (bytes_.empty()) refuse("it is empty");
        if (bytes_.size() > max_bytes) refuse("it has more than 4096 bytes");
        while (problem_.empty() && at_ < bytes_.size()) take_item();
        if (problem_.empty() && !open_.empty()) refuse("a collection has no end");
        if (!problem_.empty()) return {.descriptor = {}, .problem = std::move(problem_)};
        return {.descriptor = std::move(out_), .problem = {}};
    }

private:
    void refuse(const char* what) {
        if (problem_.empty()) problem_ = std::string(what) + " (byte " + std::to_string(at_) + " of its descriptor)";
    }

    void take_item() {
        constexpr std::uint8_t long_item = 0xfe;
        const std::uint8_t prefix = bytes_[at_];
        const std::size_t rest = bytes_.size() - at_ - 1;
        if (prefix == long_item) {
            if (rest < 2 || rest - 2 < bytes_[at_ + 1]) return refuse("its last item is cut");
            at_ += 3 + std::size_t{bytes_[at_ + 1]};
            return;
        }
        Data data{.value = 0, .size = (prefix & 3u) == 3u ? 4u : prefix & 3u};
        if (rest < data.size) return refuse("its last item is cut");
        for (std::size_t i = 0; i < data.size; ++i) data.value |= std::uint32_t{bytes_[at_ + 1 + i]} << (8 * i);
        const auto tag = static_cast<std::uint8_t>(prefix >> 4u);
        switch (static_cast<Type>(prefix >> 2u & 3u)) {
            case Type::main:
                take_main(tag, data);
                locals_ = {};
                break;
            case Type::global:
                take_global(tag, data);
                break;
            case Type::local:
                take_local(tag, data);
                break;
            case Type::reserved:
                break;
        }
        at_ += 1 + data.size;
    }

    void take_main(std::uint8_t tag, const Data& data) {
        switch (tag) {
            case Main::input:
                return add_field(ReportKind::input, data);
            case Main::output:
                return add_field(ReportKind::output, data);
            case Main::feature:
                return add_field(ReportKind::feature, data);
            case Main::collection:
                return begin_collection();
            case Main::end_collection:
                if (open_.empty()) return refuse("a collection ends that has not begun");
                open_.pop_back();
                return;
            default:
                return;  // reserved
        }
    }

    void begin_collection() {
        if (open_.size() == max_depth || out_.collections.size() == max_collections)
            return refuse("it has too many collections");
        out_.collections.push_back(
            {.usage = locals_.usages.empty() ? 0 : locals_.usages.front().first, .parent = innermost()});
        open_.push_back(out_.collections.size() - 1);
    }

    [[nodiscard]] std::size_t innermost() const noexcept {
        return open_.empty() ? ReportField::no_collection : open_.back();
    }

    void add_field(ReportKind kind, const Data& flags) {
        constexpr std::uint32_t constant = 1, variable = 2, relative = 4;
        if (globals_.count == 0 || globals_.size == 0) return;  // a field without bits
        if (out_.fields.size() == max_fields) return refuse("it has too many fields");
        std::uint32_t& used = out_.bits[static_cast<std::size_t>(kind)][globals_.id];
        const bool is_constant = (flags.value & constant) != 0;
        if (globals_.size > max_report_bits || globals_.count > max_report_bits ||
            globals_.size * globals_.count > max_report_bits - used)
            return refuse("a report has more than 1024 bytes");
        if (globals_.size > 32 && !is_constant) return refuse("a value has more than 32 bits");
        const std::int64_t logical_min = globals_.logical_min.as_signed();
        const std::int64_t physical_min = globals_.physical_min.as_signed();
        ReportField field{.kind = kind,
                          .report_id = globals_.id,
                          .bit_offset = used,
                          .bit_size = globals_.size,
                          .count = globals_.count,
                          .is_constant = is_constant,
                          .is_variable = (flags.value & variable) != 0,
                          .is_relative = (flags.value & relative) != 0,
                          .logical_min = logical_min,
                          .logical_max = maximum_of(globals_.logical_max, logical_min),
                          .physical_min = physical_min,
                          .physical_max = maximum_of(globals_.physical_max, physical_min),
                          .unit = globals_.unit,
                          .unit_exponent = exponent_of(globals_.exponent),
                          .usages = std::move(locals_.usages),
                          .collection = innermost()};
        used += globals_.size * globals_.count;
        out_.fields.push_back(std::move(field));
    }

    void take_global(std::uint8_t tag, const Data& data) {
        switch (tag) {
            case Global::usage_page:
                if (data.value > 0xffff) return refuse("a usage page has more than 16 bits");
                globals_.page = static_cast<std::uint16_t>(data.value);
                return;
            case Global::logical_minimum:
                globals_.logical_min = data;
                return;
            case Global::logical_maximum:
                globals_.logical_max = data;
                return;
            case Global::physical_minimum:
                globals_.physical_min = data;
                return;
            case Global::physical_maximum:
                globals_.physical_max = data;
                return;
            case Global::unit_exponent:
                globals_.exponent = data;
                return;
            case Global::unit:
                globals_.unit = data.value;
                return;
            case Global::report_size:
                globals_.size = data.value;
                return;
            case Global::report_count:
                globals_.count = data.value;
                return;
            case Global::report_id:
                return take_id(data);
            case Global::push:
                if (pushed_.size() == max_pushed) return refuse("it pushes too often");
                pushed_.push_back(globals_);
                return;
            case Global::pop:
                if (pushed_.empty()) return refuse("it pops what it has not pushed");
                globals_ = pushed_.back();
                pushed_.pop_back();
                return;
            default:
                return;  // reserved
        }
    }

    void take_id(const Data& data) {
        if (data.value == 0 || data.value > 0xff) return refuse("a report id is not between 1 and 255");
        if (!out_.has_ids && !out_.fields.empty()) return refuse("its first report has no id, but others have");
        out_.has_ids = true;
        globals_.id = static_cast<std::uint8_t>(data.value);
    }

    /// A usage of four bytes brings its own page.
    [[nodiscard]] Usage full(const Data& data) const noexcept {
        return data.size == 4 ? data.value : usage_of(globals_.page, static_cast<std::uint16_t>(data.value));
    }

    void take_local(std::uint8_t tag, const Data& data) {
        switch (tag) {
            case Local::usage:
                return add_usages(full(data), full(data));
            case Local::usage_minimum:
                locals_.first = data;
                return;
            case Local::usage_maximum:
                if (!locals_.first) return refuse("a range of usages has no beginning");
                if (full(data) < full(*locals_.first)) return refuse("a range of usages ends before it begins");
                add_usages(full(*locals_.first), full(data));
                locals_.first.reset();
                return;
            case Local::delimiter:
                locals_.is_delimited = data.value == 1;
                locals_.has_alternative = false;
                return;
            default:
                return;  // designators and strings
        }
    }

    void add_usages(Usage first, Usage last) {
        if (locals_.is_delimited && std::exchange(locals_.has_alternative, true)) return;
        if (locals_.usages.size() == max_usages) return refuse("a field has too many usages");
        locals_.usages.push_back({first, last});
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    Globals globals_{};
    Locals locals_{};
    std::vector<Globals> pushed_;
    std::vector<std::size_t> open_;  ///< indices of the open collections
    ReportDescriptor out_{};
    std::string problem_;
};

}  // namespace

ParsedDescriptor parse_descriptor(std::span<const std::uint8_t> bytes) { return Parser(bytes).run(); }

Usage ReportField::usage_at(std::size_t index) const noexcept {
    if (usages.empty()) return 0;
    for (const UsageRange& range : usages) {
        const std::size_t size = std::size_t{range.last} - range.first + 1;
        if (index < size) return range.first + static_cast<Usage>(index);
        index -= size;
    }
    return usages.back().last;
}

std::int64_t ReportField::index_of(Usage usage) const noexcept {
    std::int64_t before = 0;
    for (const UsageRange& range : usages) {
        if (usage >= range.first && usage <= range.last) return before + (usage - range.first);
        before += std::int64_t{range.last} - range.first + 1;
    }
    return -1;
}

std::size_t ReportDescriptor::size_of(ReportKind kind, std::uint8_t id) const noexcept {
    const std::uint32_t used = bits[static_cast<std::size_t>(kind)][id];
    if (used == 0) return 0;
    return (used + 7) / 8 + (has_ids ? 1 : 0);
}

bool ReportDescriptor::is_within(const ReportField& field, Usage usage) const noexcept {
    for (std::size_t i = field.collection; i != ReportField::no_collection; i = collections[i].parent)
        if (collections[i].usage == usage) return true;
    return false;
}

bool ReportDescriptor::has_collection(Usage usage) const noexcept {
    for (const ReportCollection& collection : collections)
        if (collection.usage == usage) return true;
    return false;
}

}  // namespace kerf::hid
