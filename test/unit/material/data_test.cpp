// The material files that come with the program: every value can be read by a case, with its source and its mark.
#include "granum/io/case_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

namespace
{
using granum::io::CaseFile;
using granum::io::Dimension;

std::filesystem::path const folder{GRANUM_SOURCE_DIR "/data/materials"};

//! What a case may leave to a material, with the range in SI that a wrong unit would leave.
struct Expected
{
    Dimension dimension;
    double low, high;
};
std::map<std::string, Expected> const keys{
    {"density", {Dimension::density, 500, 5000}},
    {"viscosity", {Dimension::viscosity, 5e-4, 0.1}},
    {"surface_tension", {Dimension::surface_tension, 0.02, 0.08}},
    {"solids_density", {Dimension::density, 900, 5000}},
    {"molar_mass", {Dimension::molar_mass, 0.01, 0.5}},
    {"contact_angle", {Dimension::angle, 0.1, 3}},
    {"diameter", {Dimension::length, 5e-5, 1e-2}},
    {"heat_capacity", {Dimension::heat_capacity, 300, 4200}},
    {"youngs_modulus", {Dimension::pressure, 1e8, 1e12}},
    {"solids_fraction", {Dimension::one, 0, 0.9}},
    {"melting_point", {Dimension::temperature, 300, 700}},
    {"fusion_heat", {Dimension::specific_energy, 5e4, 5e5}},
    {"solubility", {Dimension::one, 0, 5}},
    {"dissociation", {Dimension::one, 1, 4}},
    {"poisson_ratio", {Dimension::one, 0, 0.5}},
    {"restitution", {Dimension::one, 0.1, 1}},
    {"sliding_friction", {Dimension::one, 0, 1}},
    {"rolling_friction", {Dimension::one, 0, 0.2}},
    {"wall_sliding_friction", {Dimension::one, 0, 1}},
};

//! An empty case that takes everything from one material.
struct Reading
{
    std::filesystem::path path = std::filesystem::temp_directory_path() / "granum_material_test.toml";
    CaseFile file;

    explicit Reading(std::filesystem::path const& material) : file(empty(path))
    {
        file.use_material("spray", material.stem().string(), material.string());
    }
    ~Reading() { std::filesystem::remove(path); }

  private:
    static std::string empty(std::filesystem::path const& path)
    {
        std::ofstream(path) << "format = 1\n";
        return path.string();
    }
};

TEST(MaterialFiles, give_every_value_in_the_units_of_a_case_with_source_and_mark)
{
    std::regex const section(R"(\[(\w+)\])");
    std::regex const origin(
        R"(material .* \((measured|computed|by definition|recalled|low confidence); (?!no source given).+\))");
    int files = 0;
    for (auto const& entry : std::filesystem::directory_iterator(folder)) {
        ++files;
        Reading reading(entry.path());
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            std::smatch found;
            if (!std::regex_match(line, found, section)) continue;
            std::string const key = found[1];
            SCOPED_TRACE(entry.path().filename().string() + " " + key);
            auto const known = keys.find(key);
            ASSERT_NE(known, keys.end()) << "not a key that a case leaves to a material";
            auto const value = reading.file.optional_quantity("spray." + key, known->second.dimension, "");
            ASSERT_TRUE(value.has_value());
            EXPECT_GE(*value, known->second.low);
            EXPECT_LE(*value, known->second.high);
            EXPECT_TRUE(std::regex_match(reading.file.provenance().back().origin, origin))
                << reading.file.provenance().back().origin;
        }
        EXPECT_FALSE(reading.file.any_mistake()) << entry.path();
    }
    EXPECT_GE(files, 6);
}

TEST(MaterialFiles, hold_the_solids_fraction_they_are_named_for)
{
    for (auto const& [name, fraction] : {std::pair{"sodium-benzoate-30", 0.30},
                                         {"mannitol-15", 0.15},
                                         {"calcium-carbonate-25", 0.25},
                                         {"water", 0.0}}) {
        Reading reading(folder / (std::string(name) + ".toml"));
        EXPECT_EQ(reading.file.optional_quantity("spray.solids_fraction", Dimension::one, ""), fraction) << name;
    }
}

TEST(SodiumBenzoate, has_the_moisture_of_its_feed_and_of_saturation)
{
    Reading reading(folder / "sodium-benzoate-30.toml");
    double const solids = *reading.file.optional_quantity("spray.solids_fraction", Dimension::one, "");
    double const solubility = *reading.file.optional_quantity("spray.solubility", Dimension::one, "");
    EXPECT_NEAR((1 - solids) / solids, 2.333, 0.51e-3);
    EXPECT_NEAR(1 / solubility, 1.59, 0.005);
}
}
