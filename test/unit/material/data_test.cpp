// The material files that come with the program: every value has a unit where it needs one, a source and a mark.
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <filesystem>
#include <set>
#include <string>

namespace
{
std::filesystem::path const folder{GRANUM_SOURCE_DIR "/data/materials"};

//! Keys that a case may leave to a material, and whether they are pure numbers.
std::set<std::string> const with_unit{"density",       "viscosity", "surface_tension", "solids_density", "molar_mass",
                                      "contact_angle", "diameter",  "heat_capacity",   "youngs_modulus"};
std::set<std::string> const pure_number{"solids_fraction",  "solubility",           "dissociation",
                                        "poisson_ratio",    "restitution",          "sliding_friction",
                                        "rolling_friction", "wall_sliding_friction"};
std::set<std::string> const marks{"measured", "computed", "by definition", "recalled", "low confidence"};

TEST(MaterialFiles, give_every_value_with_its_source_and_an_honest_mark)
{
    int files = 0;
    for (auto const& entry : std::filesystem::directory_iterator(folder)) {
        auto const file = toml::parse_file(entry.path().string());
        ++files;
        for (auto const& [key, node] : file) {
            std::string const name(key.str());
            SCOPED_TRACE(entry.path().filename().string() + " " + name);
            auto const* property = node.as_table();
            ASSERT_NE(property, nullptr);
            EXPECT_TRUE(with_unit.contains(name) || pure_number.contains(name)) << "not a key that a case knows";
            auto const value = (*property)["value"];
            if (with_unit.contains(name)) {
                auto const text = value.value<std::string>();
                ASSERT_TRUE(text.has_value()) << "a value with a unit is text";
                EXPECT_GT(std::stod(*text), 0);
                EXPECT_NE(text->find(' '), std::string::npos) << "no unit";
            } else {
                EXPECT_TRUE(value.is_number());
                EXPECT_GE(value.value_or(-1.0), 0);
            }
            EXPECT_FALSE((*property)["source"].value_or(std::string()).empty());
            EXPECT_TRUE(marks.contains((*property)["mark"].value_or(std::string())));
            EXPECT_EQ(property->size(), 3u) << "value, source and mark, nothing else";
        }
    }
    EXPECT_GE(files, 6);
}

TEST(MaterialFiles, name_their_solids_fraction_as_they_hold_it)
{
    for (auto const& [name, fraction] : {std::pair{"sodium-benzoate-30", 0.30},
                                         {"mannitol-15", 0.15},
                                         {"calcium-carbonate-25", 0.25},
                                         {"water", 0.0}}) {
        auto const file = toml::parse_file((folder / (std::string(name) + ".toml")).string());
        EXPECT_EQ(file["solids_fraction"]["value"].value_or(-1.0), fraction) << name;
    }
}
}
