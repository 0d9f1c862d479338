// Turbulence, dispersion and the law of the viscosity as a case states them.
#include "granum/base/error.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/case_reader.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace granum::sim
{
namespace
{
std::string text_of(std::string const& gas)
{
    return "[apparatus]\nshape = \"box\"\nsize = [\"10 cm\", \"10 cm\", \"1 m\"]\n[time]\nduration = \"1 s\"\n[gas]\n"
           "temperature = \"80 degC\"\ncells = [4, 4, 8]\nvelocity = \"2 m/s\"\nhumidity = \"8 g/kg\"\n" +
           gas;
}

std::string mistakes_of(std::string const& gas)
{
    auto const path =
        (std::filesystem::temp_directory_path() / fmt::format("granum-turbulence-{}.toml", getpid())).string();
    std::ofstream(path) << text_of(gas);
    try {
        read_case(path, Purpose::run);
    } catch (base::CaseError const& error) {
        return error.what();
    }
    return "";
}
}

TEST(CaseTurbulence, takes_the_constants_of_the_model_and_of_the_wall)
{
    auto const data = scene::case_of(
        text_of("turbulence = \"k-epsilon\"\nturbulence_constants = { c_mu = 0.1, c_2 = 1.8, karman = 0.4 }\n"
                "turbulence_intensity = 0.1\nturbulence_length = \"2 mm\"\nturbulence_velocity = \"2 m/s\"\n"));
    auto const settings = gas_settings(data);
    auto const& model = std::get<law::turbulence::KEpsilon>(settings.turbulence.model);
    EXPECT_EQ(model.c_mu, 0.1);
    EXPECT_EQ(model.c_2, 1.8);
    EXPECT_EQ(model.c_1, 1.44);
    EXPECT_EQ(settings.turbulence.wall.karman, 0.4);
    EXPECT_EQ(settings.turbulence.energy, 6);
    EXPECT_EQ(settings.inlets.at(0).turbulence_intensity, 0.1);
    EXPECT_EQ(settings.inlets.at(0).turbulence_length, 2e-3);
}

TEST(CaseTurbulence, refuses_constants_that_the_model_has_not)
{
    EXPECT_EQ(mistakes_of("turbulence = \"k-epsilon\"\nturbulence_constants = { c_1 = 1.5 }\n"), "");
    EXPECT_NE(
        mistakes_of("turbulence = \"wale\"\nturbulence_constants = { c_1 = 1.5 }\n").find("[gas.turbulence_constants]"),
        std::string::npos);
    EXPECT_NE(mistakes_of("turbulence = \"k-epsilon\"\nturbulence_constants = { c_1 = 1.5, c_9 = 1 }\n")
                  .find("gas.turbulence_constants.c_9"),
              std::string::npos);
    EXPECT_NE(mistakes_of("turbulence = \"k-omega\"\n").find("k-omega-sst"), std::string::npos);
}

TEST(CaseTurbulence, wants_a_model_with_k_where_granules_are_to_see_fluctuations)
{
    EXPECT_EQ(mistakes_of("turbulence = \"k-omega-sst\"\ndispersion = \"langevin\"\n"), "");
    for (auto const* without : {"", "turbulence = \"smagorinsky\"\n"}) {
        EXPECT_NE(mistakes_of(std::string(without) + "dispersion = \"langevin\"\n").find("gas.dispersion"),
                  std::string::npos);
        EXPECT_NE(mistakes_of(std::string(without) + "granule_turbulence = true\n").find("gas.granule_turbulence"),
                  std::string::npos);
    }
}

TEST(CaseTurbulence, takes_the_numbers_of_a_fluid_that_thins)
{
    auto const data = scene::case_of(
        text_of("viscosity_law = \"carreau\"\nviscosity = \"1 Pa.s\"\nviscosity_infinite = \"0.01 Pa.s\"\n"
                "viscosity_time = \"0.5 s\"\nviscosity_exponent = 0.4\n"));
    auto const thinning = gas_settings(data).thinning;
    EXPECT_TRUE(std::holds_alternative<law::viscosity::Carreau>(thinning.law));
    EXPECT_EQ(thinning.infinite, 0.01);
    EXPECT_EQ(thinning.time, 0.5);
    EXPECT_EQ(thinning.exponent, 0.4);
}
}
