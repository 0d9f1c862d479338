// The program as a person meets it: wrong cases, wrong words, and what comes back.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;

struct Answer
{
    int status;
    std::string text;  //!< both streams
};

//! A folder of its own for each test, so that anything left behind is seen.
class Program : public ::testing::Test
{
  protected:
    void SetUp() override
    {
        folder_ = fs::temp_directory_path() / ("granum-cli-" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    Answer call(std::string const& words, std::string const& environment = "") const
    {
        auto const line =
            "cd '" + folder_.string() + "' && " + environment + " '" GRANUM_PROGRAM "' " + words + " 2>&1";
        std::array<char, 4096> part{};
        std::string text;
        FILE* pipe = popen(line.c_str(), "r");
        while (std::size_t const got = std::fread(part.data(), 1, part.size(), pipe)) text.append(part.data(), got);
        return {WEXITSTATUS(pclose(pipe)), text};
    }
    bool left_nothing() const { return fs::is_empty(folder_); }

    fs::path folder_;
};

struct Wrong
{
    fs::path path;
    int line = 0;
    std::vector<std::string> words;
};

//! The first line of each file says which line the message must name and which words it must have.
std::vector<Wrong> wrong_cases()
{
    std::vector<Wrong> all;
    for (auto const& entry : fs::directory_iterator(GRANUM_SOURCE_DIR "/test/cli/wrong")) {
        if (entry.path().extension() != ".toml") continue;
        Wrong one{entry.path(), 0, {}};
        std::ifstream in(entry.path());
        std::string first, word;
        std::getline(in, first);
        one.line = std::stoi(first.substr(std::string("# expect ").size()));
        std::istringstream words(first.substr(first.find(": ") + 2));
        while (std::getline(words, word, '|')) one.words.push_back(word);
        all.push_back(one);
    }
    return all;
}
}

TEST_F(Program, refuses_each_wrong_case_in_one_screen_and_leaves_nothing)
{
    auto const cases = wrong_cases();
    EXPECT_EQ(cases.size(), 33u);
    for (auto const& wrong : cases)
        for (auto const* verb : {"check ", "run "}) {
            auto const start = std::chrono::steady_clock::now();
            auto const [status, text] = call(std::string(verb) + "'" + wrong.path.string() + "'");
            auto const place = wrong.path.string() + ":" + std::to_string(wrong.line) + ": ";
            EXPECT_EQ(status, 2) << verb << wrong.path;
            EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10)
                << wrong.path;
            EXPECT_TRUE(text.starts_with(place)) << "expected " << place << " got\n" << text;
            EXPECT_EQ(text.find(".toml:", place.size()), std::string::npos) << "one cause, one message:\n" << text;
            for (auto const& word : wrong.words)
                EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
            EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 24);
            EXPECT_TRUE(left_nothing()) << verb << wrong.path << " left something behind";
        }
}

TEST_F(Program, refuses_a_body_of_ten_million_facets_before_it_reads_them)
{
    std::ofstream(folder_ / "case.toml") << "[apparatus]\nshape = \"solids\"\n[[apparatus.solid]]\nshape = \"stl\"\n"
                                            "file = \"fine.stl\"\n[granules]\ndiameter = \"2 mm\"\n"
                                            "density = \"2500 kg/m3\"\nmass = \"5 g\"\n[time]\nduration = \"1 s\"\n";
    constexpr std::uint32_t facets = 10'000'000;
    std::string head(84, ' ');
    for (std::size_t k = 0; k < 4; ++k) head[80 + k] = static_cast<char>(facets >> (8 * k) & 0xff);
    std::ofstream(folder_ / "fine.stl", std::ios::binary) << head;
    fs::resize_file(folder_ / "fine.stl", 84 + std::uintmax_t{50} * facets);
    auto const start = std::chrono::steady_clock::now();
    auto const [status, text] = call("run case.toml");
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10);
    EXPECT_EQ(status, 2);
    for (auto const* word : {"case.toml:5: apparatus.solid[0].file = \"fine.stl\"", "10000000", "2000000 facets"})
        EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
}

TEST_F(Program, suggests_the_near_name_of_a_missing_case)
{
    std::ofstream(folder_ / "case.toml") << "";
    auto const [status, text] = call("run cse.toml");
    EXPECT_EQ(status, 2);
    EXPECT_NE(text.find("did you mean \"case.toml\"?"), std::string::npos) << text;
}

TEST_F(Program, suggests_the_near_verb)
{
    auto const [status, text] = call("rum case.toml");
    EXPECT_EQ(status, 2);
    EXPECT_NE(text.find("did you mean \"granum run\"?"), std::string::npos) << text;
    EXPECT_EQ(call("").status, 2);
    EXPECT_EQ(call("--help").status, 0);
    EXPECT_EQ(call("run").status, 2);
    EXPECT_EQ(call("run case.toml --nonsense").status, 2);
}

TEST_F(Program, writes_templates_that_check)
{
    for (auto const* name : {"lab-gf3", "pilot-x8", "rectangular-bed", "pile", "hopper", "drum", "cooling-gas",
                             "wurster", "suspension", "melt"}) {
        auto const printed = call(std::string("new ") + name);
        EXPECT_EQ(printed.status, 0);
        EXPECT_LE(std::count(printed.text.begin(), printed.text.end(), '\n'), 60) << name;
        EXPECT_EQ(call(std::string("new ") + name + " -o " + name + ".toml").status, 0);
        auto const checked = call(std::string("check ") + name + ".toml");
        EXPECT_EQ(checked.status, 0) << checked.text;
        auto const* way = std::string(name) == "cooling-gas" ? "hard spheres" : "granule step";
        EXPECT_NE(checked.text.find(way), std::string::npos) << checked.text;
        EXPECT_EQ(call(std::string("new ") + name + " -o " + name + ".toml").status, 2) << "must not overwrite";
    }
    EXPECT_EQ(call("new lab-gf").status, 2);
}

TEST_F(Program, starts_itself_again_for_large_pages_unless_told_about_them)
{
    auto const starts = [this](std::string const& tunables) {
        auto const [status, text] = call("--version", "LD_DEBUG=statistics " + tunables);
        EXPECT_EQ(status, 0) << text;
        std::string const start = "total startup time in dynamic loader";  // the loader's own line
        int count = 0;
        for (auto at = text.find(start); at != std::string::npos; at = text.find(start, at + 1)) ++count;
        return count;
    };
    EXPECT_EQ(starts("GLIBC_TUNABLES="), 2);
    EXPECT_EQ(starts("GLIBC_TUNABLES=glibc.malloc.check=0"), 2);
    EXPECT_EQ(starts("GLIBC_TUNABLES=glibc.malloc.hugetlb=0"), 1);
}

TEST_F(Program, gives_a_balance_as_json)
{
    auto const [status, text] = call("balance --json '" GRANUM_SOURCE_DIR "/examples/balance/1.toml'");
    EXPECT_EQ(status, 0);
    for (auto const* key : {"eta", "outlet_humidity", "outlet_temperature_K", "wet_bulb_K", "wet_bulb_humidity",
                            "outlet_relative_humidity"})
        EXPECT_NE(text.find(std::string("\"") + key + "\": "), std::string::npos) << key;
    EXPECT_NE(text.find("\"eta\": 0.7174"), std::string::npos) << text;
}

TEST_F(Program, lists_laws_and_knows_its_families)
{
    EXPECT_NE(call("list drag").text.find("beetstra"), std::string::npos);
    EXPECT_EQ(call("list drag").text.find("gunn"), std::string::npos);
    EXPECT_NE(call("list").text.find("gunn"), std::string::npos);
    EXPECT_NE(call("list film").text.find("contact.film"), std::string::npos);
    EXPECT_EQ(call("list drag").text.find("not in a case yet"), std::string::npos);
    EXPECT_EQ(call("list dragg").status, 2);
}

TEST_F(Program, explains_where_each_value_comes_from)
{
    auto const text = call("explain '" GRANUM_SOURCE_DIR "/examples/01-lab-layering/case.toml'").text;
    EXPECT_NE(text.find("# material sodium-benzoate-30"), std::string::npos) << text;
    EXPECT_NE(text.find("# default"), std::string::npos);
    EXPECT_NE(text.find("# derived"), std::string::npos);
    EXPECT_NE(text.find("# line "), std::string::npos);
}

TEST_F(Program, refuses_a_folder_that_is_taken_and_a_report_of_nothing)
{
    fs::create_directories(folder_ / "mine");
    std::ofstream(folder_ / "mine" / "thesis.txt") << "years of work";
    auto const [status, text] = call("run '" GRANUM_SOURCE_DIR "/examples/01-lab-layering/case.toml' -o mine");
    EXPECT_EQ(status, 2);
    EXPECT_NE(text.find("exists already"), std::string::npos) << text;
    EXPECT_EQ(call("report nowhere").status, 2);
    EXPECT_EQ(call("run '" GRANUM_SOURCE_DIR "/examples/01-lab-layering/case.toml' --until 3").status, 2)
        << "a time needs a unit";
}
