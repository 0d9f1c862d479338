// The case file as typed: lines, origins, all mistakes in one pass, and no second message for one cause.
#include "granum/io/case_file.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace granum::io
{
namespace
{
//! A file with the text, gone at the end of the test.
class Typed
{
  public:
    explicit Typed(std::string const& text)
        : path_((std::filesystem::temp_directory_path() / fmt::format("granum-case-{}.toml", getpid())).string())
    {
        std::ofstream(path_) << text;
    }
    ~Typed() { std::filesystem::remove(path_); }
    std::string const& path() const { return path_; }

  private:
    std::string path_;
};

std::vector<base::Mistake> mistakes(CaseFile& file)
{
    try {
        file.finish();
    } catch (base::CaseError const& error) {
        return error.mistakes;
    }
    return {};
}
}

TEST(CaseFile, gives_a_value_with_its_line_and_a_default_with_its_name)
{
    Typed const typed("title = \"a\"\n[gas]\ntemperature = \"80 degC\"\n");
    CaseFile file(typed.path());
    EXPECT_EQ(file.words("title", std::nullopt, ""), "a");
    file.section("gas");
    EXPECT_DOUBLE_EQ(file.quantity("gas.temperature", Dimension::temperature, std::nullopt, ""), 353.15);
    EXPECT_DOUBLE_EQ(file.quantity("gas.pressure", Dimension::pressure, 1e5, ""), 1e5);
    EXPECT_TRUE(mistakes(file).empty());
    EXPECT_EQ(file.provenance()[1].origin, "line 3");
    EXPECT_EQ(file.provenance()[1].value, "80 degC");
    EXPECT_EQ(file.provenance()[2].origin, "default");
}

TEST(CaseFile, finds_all_mistakes_in_one_pass_in_the_order_of_lines)
{
    Typed const typed("[gas]\ntemperature = 80\npressure = \"1 kg\"\nclosed = \"no\"\n");
    CaseFile file(typed.path());
    file.section("gas");
    file.boolean("gas.closed", false, "");
    file.quantity("gas.pressure", Dimension::pressure, 1e5, "");
    file.quantity("gas.temperature", Dimension::temperature, std::nullopt, "");
    auto const found = mistakes(file);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].text(), typed.path() +
                                   ":2: gas.temperature = 80 needs a unit: expects a temperature\n"
                                   "  write it as text with its unit, e.g. \"80 degC\"");
    EXPECT_EQ(found[1].line, 3);
    EXPECT_EQ(found[2].line, 4);
}

TEST(CaseFile, takes_a_misspelt_key_and_the_missing_one_for_one_mistake)
{
    Typed const typed("[granules]\ndensty = \"1445 kg/m3\"\n");
    CaseFile file(typed.path());
    file.section("granules");
    file.quantity("granules.density", Dimension::density, std::nullopt, "");
    auto const found = mistakes(file);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].line, 2);
    EXPECT_EQ(found[0].hints.back(), "did you mean \"density\"?");
}

TEST(CaseFile, reports_an_unknown_section_once)
{
    Typed const typed("[grannules]\ndensity = \"1 kg/m3\"\nmass = \"1 kg\"\n");
    CaseFile file(typed.path());
    file.section("granules");
    file.quantity("granules.density", Dimension::density, std::nullopt, "");
    auto const found = mistakes(file);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].entry, "[grannules]");
    EXPECT_EQ(found[0].hints.back(), "did you mean \"granules\"?");
}

TEST(CaseFile, reads_lists_of_tables_with_their_lines)
{
    Typed const typed("[[nozzle]]\nposition = [\"0 mm\", \"1 mm\", \"2 mm\"]\n[[nozzle]]\npositon = 1\n");
    CaseFile file(typed.path());
    ASSERT_EQ(file.count("nozzle"), 2);
    EXPECT_DOUBLE_EQ(file.vector("nozzle[0].position", Dimension::length, std::nullopt, "").z, 0.002);
    file.vector("nozzle[1].position", Dimension::length, std::nullopt, "");
    auto const found = mistakes(file);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].line, 4);
    EXPECT_EQ(found[0].hints.back(), "did you mean \"position\"?");
}

TEST(CaseFile, takes_missing_values_from_the_material_and_says_so)
{
    Typed const typed("[spray]\nrate = \"1 kg/h\"\n");
    auto const material =
        (std::filesystem::temp_directory_path() / fmt::format("granum-material-{}.toml", getpid())).string();
    std::ofstream(material) << "[density]\nvalue = \"1130 kg/m3\"\nsource = \"a table\"\nmark = \"recalled\"\n"
                               "[youngs_modulus]\nvalue = \"1 GPa\"\n";
    CaseFile file(typed.path());
    file.section("spray");
    file.use_material("spray", "soup", material, {"youngs_modulus"});
    std::filesystem::remove(material);
    file.quantity("spray.rate", Dimension::mass_flow, std::nullopt, "");
    EXPECT_DOUBLE_EQ(file.quantity("spray.density", Dimension::density, std::nullopt, ""), 1130);
    EXPECT_DOUBLE_EQ(file.quantity("spray.youngs_modulus", Dimension::pressure, 5.0, ""), 5);
    EXPECT_TRUE(mistakes(file).empty());
    EXPECT_EQ(file.provenance()[1].origin, "material soup (recalled; a table)");
    ASSERT_EQ(file.warnings().size(), 1u);
    EXPECT_NE(file.warnings()[0].find("density = \"1130 kg/m3\""), std::string::npos);
}

TEST(CaseFile, that_is_missing_names_its_neighbours)
{
    Typed const typed("");
    auto wrong = typed.path();
    wrong.replace(wrong.find("granum-case"), 11, "granum-cse");
    try {
        CaseFile const file(wrong);
        FAIL() << "a missing file was read";
    } catch (base::CaseError const& error) {
        EXPECT_EQ(error.exit, base::Exit::usage);
        EXPECT_NE(std::string(error.what()).find("did you mean \"granum-case"), std::string::npos) << error.what();
    }
}

TEST(CaseFile, that_breaks_off_names_the_line)
{
    Typed const typed("title = \"a\"\n[gas]\nflow = \"120");
    try {
        CaseFile const file(typed.path());
        FAIL() << "a broken file was read";
    } catch (base::CaseError const& error) {
        EXPECT_EQ(error.mistakes[0].line, 3);
        EXPECT_EQ(error.mistakes[0].hints.back(), "the file ends here: is it complete?");
    }
}
}
