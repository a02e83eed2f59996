// SPDX-License-Identifier: Apache-2.0
// Every code has a golden file: a document with this mistake, and the message for it, word for word.
//
// E0412.yaml is the document, E0412.txt the text. An anatomy is checked with the procedure hole.yaml; a first line
// `# with: --variant V` is taken as from the command line. Mistakes that share a code with another have names in place
// of it. After a change that is meant, KERF_UPDATE_GOLDEN=1 writes the texts anew: read them before they are committed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "app/findings.h"
#include "run/documents.h"
#include "run/scene.h"
#include "tests/golden/odd_files.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"
#include "text/codes.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

const fs::path golden = KERF_SOURCE_DIR "/tests/golden";

std::string name_of(int number) { return text::explanation_of(*text::find_code(std::to_string(number))).substr(0, 5); }

/// A copy of the golden folder in which data files may be made; the program is in it meanwhile, and knows of no other
/// data.
class GoldenFolder {
public:
    GoldenFolder() : before_(fs::current_path()) {
        unsetenv("KERF_DATA");
        for (const auto& entry : fs::directory_iterator(golden))
            if (entry.path().extension() == ".yaml") fs::copy(entry.path(), folder_.path());
        fs::current_path(folder_.path());
    }
    ~GoldenFolder() { fs::current_path(before_); }

private:
    test::TemporaryFolder folder_;
    fs::path before_;
};

text::Diagnostics check(const std::string& file) {
    const std::string text = test::contents_of(file);
    const bool is_anatomy = text.find("\nkind: Anatomy\n") != std::string::npos;
    run::DocumentRequest request{.procedure = is_anatomy ? "hole.yaml" : file, .anatomy = is_anatomy ? file : ""};
    constexpr std::string_view with = "# with: --variant ";
    if (text.starts_with(with)) request.changes.variant = text.substr(with.size(), text.find('\n') - with.size());
    text::Diagnostics found;
    auto documents = run::check_documents(request, test::plugins()).take(found);
    if (request.changes.variant.empty())
        for (text::Diagnostic& d : run::check_variants(request, found, test::plugins())) found.push_back(std::move(d));
    if (!documents) return found;
    (void)make_scene(std::move(*documents)).take(found);
    return found;
}

text::Diagnostics found_by(int number) {
    if (const auto direct = test::direct_causes().find(number); direct != test::direct_causes().end())
        return direct->second();
    const GoldenFolder folder;
    if (const auto maker = test::makers_of_input().find(number); maker != test::makers_of_input().end())
        maker->second(fs::current_path().string());
    const std::string warning = "W" + name_of(number).substr(1) + ".yaml",
                      error = "E" + name_of(number).substr(1) + ".yaml";
    return check(fs::exists(warning) ? warning : error);
}

/// What is found where the mistake with this code was made; each mistake is made once.
const text::Diagnostics& cause(int number) {
    static std::map<int, text::Diagnostics> known;
    const auto at = known.find(number);
    return at != known.end() ? at->second : known.emplace(number, found_by(number)).first->second;
}

class Golden : public testing::TestWithParam<int> {};

TEST_P(Golden, TextMatchesTheFile) {
    const int number = GetParam();
    const text::Diagnostics& found = cause(number);
    const std::string text = to_text(found);
    const fs::path file = golden / (name_of(number) + ".txt");
    if (std::getenv("KERF_UPDATE_GOLDEN") != nullptr) std::ofstream(file, std::ios::binary) << text;

    EXPECT_EQ(text, test::contents_of(file.string()));
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const text::Diagnostic& d) {
        return d.code == name_of(number);
    })) << text;
    EXPECT_EQ(text.find("/tmp/"), std::string::npos) << text;
}

TEST_P(Golden, SaysWhatToDo) {
    const std::regex advice("(^|[.;:] |, "
                            ")(Write|Remove|Put|Check|Name|Give|Choose|Add|Fill|Keep|Move|Turn|Exchange|Mend|Save|"
                            "Begin|Take|Repeat|Point|Export|Crop|Copy|Run|Install|"
                            "Use|Try|Replace|End|Correct|Lower|Allow|Indent|Start|See|Free|Change|Rename|Resample|Swap|"
                            "Say|Join|Close|Place|Make|write|allow|let|export)( |$)");
    for (const text::Diagnostic& d : cause(GetParam())) {
        if (d.level == text::Diagnostic::Level::warning) continue;
        EXPECT_TRUE(!d.write.empty() || std::regex_search(d.message, advice)) << text::to_text({d});
    }
}

class GoldenNamed : public testing::TestWithParam<const char*> {};

TEST_P(GoldenNamed, TextMatchesTheFile) {
    const std::string name = GetParam();
    const GoldenFolder folder;
    const std::string text = to_text(check(name + ".yaml"));
    const fs::path file = golden / (name + ".txt");
    if (std::getenv("KERF_UPDATE_GOLDEN") != nullptr) std::ofstream(file, std::ios::binary) << text;
    EXPECT_EQ(text, test::contents_of(file.string()));
    EXPECT_NE(text, "");
}
INSTANTIATE_TEST_SUITE_P(Mistakes, GoldenNamed,
                         testing::Values("saw-no-teeth", "saw-half-a-tooth", "saw-too-many-teeth", "saw-no-thickness",
                                         "reversed-axis", "broken-at-start", "slipped-sign", "turned-drill"),
                         [](const auto& of) {
                             std::string name = of.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(TwentyMistakes, AreReportedInOnePass) {
    // Given a procedure whose lines name the code of their mistake
    const std::string text = test::contents_of((golden / "twenty-mistakes.yaml").string());
    std::multiset<std::pair<int, std::string>> expected, reported;
    const std::regex mark("# (E0[0-9]{3})");
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        if (std::smatch code; std::regex_search(line, code, mark)) expected.emplace(number, code[1]);

    // When it is checked
    const GoldenFolder folder;
    const text::Diagnostics found = check("twenty-mistakes.yaml");
    for (const text::Diagnostic& d : found)
        if (d.level == text::Diagnostic::Level::error) reported.emplace(d.place.line, d.code);

    // Then each mistake is reported once, and nothing else
    EXPECT_GE(expected.size(), 20u);
    EXPECT_EQ(reported, expected) << to_text(found);
}

std::vector<int> all_numbers() {
    std::vector<int> numbers;
    for (const text::CodeEntry& entry : text::all_codes()) numbers.push_back(entry.number);
    return numbers;
}
INSTANTIATE_TEST_SUITE_P(Codes, Golden, testing::ValuesIn(all_numbers()),
                         [](const auto& of) { return name_of(of.param); });

TEST(Codes, SourceUsesEachCodeOfTheTable) {
    // Given every code that the source reports, as text or by its enumerator
    std::map<std::string, int> number_of;
    for (const text::CodeEntry& entry : text::all_codes()) number_of[entry.id] = entry.number;
    std::set<int> written;
    for (const char* folder : {"/core", "/text", "/documents", "/session", "/bone", "/run", "/app"})
        for (const auto& entry : fs::recursive_directory_iterator(std::string(KERF_SOURCE_DIR) + folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string text = test::contents_of(entry.path().string());
            const std::regex code(R"re("[EW]0(\d{3})"|\bCode::([a-z]\w+))re");
            for (std::sregex_iterator at(text.begin(), text.end(), code), end; at != end; ++at) {
                const auto known = number_of.find((*at)[2]);
                if ((*at)[1].matched)
                    written.insert(std::stoi((*at)[1]));
                else if (known != number_of.end())
                    written.insert(known->second);
            }
        }

    // Then the table has them, and has no other
    std::set<int> explained;
    for (const text::CodeEntry& entry : text::all_codes()) explained.insert(entry.number);
    EXPECT_EQ(written, explained) << "add a row to text/codes_*.def, and tests/golden/E….yaml";
    EXPECT_EQ(explained.size(), text::all_codes().size()) << "a number occurs twice";
    EXPECT_TRUE(std::is_sorted(text::all_codes().begin(), text::all_codes().end(),
                               [](const auto& a, const auto& b) { return a.number < b.number; }));
}

TEST(Codes, PageOfTheDocsIsTheTable) {
    const std::string file = KERF_SOURCE_DIR "/docs/codes.md";
    const std::string page = test::contents_of(file);
    const std::string expected = page.substr(0, page.find("| code |")) + text::table_of_codes();
    if (std::getenv("KERF_UPDATE_GOLDEN") != nullptr) std::ofstream(file) << expected;
    EXPECT_EQ(page, expected) << "run golden_test with KERF_UPDATE_GOLDEN=1, and check what it wrote";
}

TEST(Codes, AreExplainedInSentences) {
    for (const text::CodeEntry& entry : text::all_codes())
        for (const std::string part : {entry.meaning, entry.why, entry.write}) {
            EXPECT_TRUE(part.ends_with('.')) << entry.number << ": " << part;
            EXPECT_TRUE(part[0] != ' ' && !(part[0] >= 'a' && part[0] <= 'z')) << entry.number << ": " << part;
        }
}

TEST(Codes, AreFoundAsTheyStandBeforeAMessage) {
    ASSERT_NE(text::find_code("E0412"), nullptr);
    EXPECT_EQ(text::find_code("E0412")->number, 412);
    EXPECT_EQ(text::find_code("412"), text::find_code("e0412"));
    EXPECT_TRUE(text::explanation_of(*text::find_code("W0310")).starts_with("W0310  "));
    for (const char* nothing : {"", "E", "E9999", "E0412x", "-412", "E 412", "99999999999999999999"})
        EXPECT_EQ(text::find_code(nothing), nullptr) << nothing;
}

}  // namespace
}  // namespace kerf
