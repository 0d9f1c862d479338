// Cases as they are resolved: the templates, the ways to state a flow, and what the program makes of them.
#include "granum/sim/case_reader.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/law_families.hpp"
#include "granum/sim/wall_time.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace granum::sim
{
namespace
{
std::string example(std::string const& name)
{
    return GRANUM_SOURCE_DIR "/examples/" + name + "/case.toml";
}

ResolvedCase read_text(std::string const& text, Purpose purpose = Purpose::run)
{
    auto const path =
        (std::filesystem::temp_directory_path() / fmt::format("granum-reader-{}.toml", getpid())).string();
    std::ofstream(path) << text;
    return read_case(path, purpose);
}

std::string mistakes_of(std::string const& text)
{
    try {
        read_text(text);
    } catch (base::CaseError const& error) {
        return error.what();
    }
    return "";
}

std::string const box =
    "[apparatus]\nshape = \"box\"\nsize = [\"10 cm\", \"10 cm\", \"1 m\"]\n[time]\nduration = \"1 s\"\n";
std::string const gas = "[gas]\ntemperature = \"80 degC\"\ncells = [10, 10, 100]\n";
}

TEST(CaseReader, turns_a_contact_time_into_stiffnesses_that_last_as_long)
{
    auto const text = [](char const* more) {
        return box + "[granules]\ndiameter = \"2 mm\"\ndensity = \"1500 kg/m3\"\nmass = \"1 g\"\n[contact]\n" +
               "normal = \"linear\"\nrestitution = 1\n" + more;
    };
    auto const data = read_text(text("contact_time = \"1 ms\"\n")).data;
    auto const laws = granule_settings(data).laws;
    double const mass = data.granules.density * math::pi / 6 * 8e-9;
    EXPECT_NEAR(math::pi * std::sqrt(0.5 * mass / laws.effective(0, 0).stiffness), 1e-3, 1e-12);
    EXPECT_NEAR(math::pi * std::sqrt(mass / laws.effective(0, 1).stiffness), 1e-3, 1e-12);
    EXPECT_NEAR(granule_step(data), 1e-3 / 20, 1e-12);
    EXPECT_NE(mistakes_of(text("contact_time = \"1 ms\"\nstiffness = \"100 N/m\"\n")).find("does not go with"),
              std::string::npos);
    EXPECT_NE(mistakes_of(text("stiffness = \"100 Pa\"\n")).find("contact.stiffness"), std::string::npos);
}

TEST(CaseReader, wants_all_that_heat_through_contacts_needs_and_nothing_else)
{
    auto const text = [](std::string const& contact, bool with_gas = true) {
        return box + "[granules]\ndiameter = \"2 mm\"\ndensity = \"1500 kg/m3\"\nmass = \"1 g\"\n" +
               (with_gas ? gas + "velocity = \"0.5 m/s\"\nhumidity = \"8 g/kg\"\n" : "") + "[contact]\n" + contact +
               "[material.steel]\n" + (contact.empty() ? "" : "heat_conductivity = \"15 W/m/K\"\n");
    };
    auto const read = read_text(text("conduction = \"hertz\"\nheat_conductivity = \"0.3 W/m/K\"\n"));
    auto const& materials = read.data.contact.materials;
    EXPECT_EQ(materials[0].heat_conductivity, 0.3);
    EXPECT_EQ(materials[1].heat_conductivity, 0.3) << "walls as granules where they say nothing";
    EXPECT_EQ(materials[2].heat_conductivity, 15);
    auto const has = [](std::string const& what, char const* part) { return what.find(part) != std::string::npos; };
    EXPECT_TRUE(std::any_of(read.warnings.begin(), read.warnings.end(),
                            [&](auto const& said) { return has(said, "contact.real_youngs_modulus"); }));
    EXPECT_FALSE(read_text(text("")).data.contact.conducts());
    EXPECT_TRUE(has(mistakes_of(text("conduction = \"hertz\"\n", false)), "goes with gas"));
    EXPECT_TRUE(has(mistakes_of(text("heat_conductivity = \"0.3 W/m/K\"\n")), "has no meaning"));
    EXPECT_TRUE(has(mistakes_of(box + "[granules]\nmass = \"1 g\"\n" + gas + "[contact]\nconduction = \"lens\"\n"),
                    "contact.heat_conductivity"));
}

TEST(CaseReader, gives_granules_and_walls_the_paths_of_heat_that_a_case_tells)
{
    auto const text = [](std::string const& contact, std::string const& granule = "") {
        return box + "[granules]\ndiameter = \"2 mm\"\ndensity = \"1500 kg/m3\"\n" + gas +
               "velocity = \"0.5 m/s\"\nhumidity = \"8 g/kg\"\n[contact]\n" + contact +
               "[[granule]]\nposition = [\"5 "
               "mm\", \"5 mm\", \"5 mm\"]\n" +
               granule;
    };
    auto const data =
        read_text(text("conduction = \"hertz\"\nheat_conductivity = \"0.3 W/m/K\"\nwall_heat_conductivity "
                       "= \"15 W/m/K\"\nreal_youngs_modulus = \"5 GPa\"\ncollisions = true\nfilm = "
                       "\"rong-horio\"\nfilm_lens = 0.1\n",
                       "temperature = \"400 K\"\n"))
            .data;
    EXPECT_EQ(data.contact.materials[1].heat_conductivity, 15);
    EXPECT_EQ(data.contact.materials[1].real_youngs_modulus, 5e9);
    EXPECT_TRUE(data.contact.collisions && data.contact.films());
    EXPECT_NEAR(granule_settings(data).sight, 1.1 * 0.1 * 1e-3, 1e-12);
    EXPECT_EQ(data.granules.given.at(0).temperature, 400);
    auto const refused = [&](std::string const& contact, char const* why) {
        auto const what = mistakes_of(text(contact));
        EXPECT_NE(what.find(why), std::string::npos) << contact << what;
    };
    refused("film_lens = 0.1\n", "contact.film_lens");
    refused("collisions = true\n", "contact.collisions");
    refused("conduction = \"hertz\"\nheat_conductivity = \"0.3 W/m/K\"\ncollisions = true\n", "needs the real modulus");
    refused("film = \"none-such\"\n", "rong-horio");
}

TEST(CaseReader, refuses_the_parameter_of_a_contact_law_that_is_not_chosen)
{
    for (auto const* line : {"stiffness = \"100 N/m\"", "wall_stiffness = \"100 N/m\"", "contact_time = \"1 ms\"",
                             "tangential_ratio = 0.3", "reference_speed = \"1 m/s\"", "rolling_damping = 0.3",
                             "wall_rolling_damping = 0.3"}) {
        auto const what = mistakes_of(box + "[granules]\nmass = \"1 g\"\n[contact]\n" + line + "\n");
        EXPECT_NE(what.find("has no meaning for contact."), std::string::npos) << line << ": " << what;
    }
}

TEST(CaseReader, resolves_the_lab_example_to_what_it_says)
{
    auto const data = read_case(example("01-lab-layering")).data;
    EXPECT_NEAR(data.gas.inlet.dry_mass_flow, 0.04, 1e-12) << "120 m3/h stated at 1.2 kg dry air per m3";
    EXPECT_NEAR(data.gas.inlet.temperature, 353.15, 1e-9);
    EXPECT_NEAR(data.gas.inlet.humidity, 0.008, 1e-12);
    EXPECT_EQ(data.gas.cells, (std::array{16, 16, 64}));
    EXPECT_EQ(data.granules.parcels, 11000);
    double const represented = 11000 * std::pow(data.granules.parcel_ratio, 3);
    EXPECT_NEAR(represented * 1445 * math::pi / 6 * std::pow(0.6e-3, 3), 1.0, 1e-9) << "parcels carry the batch";
    EXPECT_NEAR(data.chamber.radius(0.225), 0.1075, 1e-12);
    EXPECT_NEAR(data.spray.rate, 1.2 / 3600, 1e-15);
    ASSERT_EQ(data.spray.nozzles.size(), 1u);
    EXPECT_NEAR(data.spray.nozzles[0].position.z, 0.3, 1e-12);
    EXPECT_NEAR(data.spray.density, 1130, 1e-9) << "from the material";
    EXPECT_TRUE(data.start.quasi_steady);
}

TEST(CaseReader, accepts_every_template)
{
    for (auto const* name : {"01-lab-layering", "11-pilot-x8", "12-rectangular-bed"})
        EXPECT_NO_THROW(read_case(example(name))) << name;
    EXPECT_EQ(read_case(example("12-rectangular-bed")).data.granules.parcels, 9240);
}

TEST(CaseReader, gives_the_pilot_the_same_balance_as_the_lab)
{
    auto const lab = balance(read_case(example("01-lab-layering")).data);
    auto const pilot = balance(read_case(example("11-pilot-x8")).data);
    EXPECT_NEAR(pilot.eta, lab.eta, 1e-12);
    EXPECT_NEAR(pilot.outlet_temperature, lab.outlet_temperature, 1e-9);
}

TEST(CaseReader, wants_the_state_of_a_volume_flow)
{
    auto const said = mistakes_of(box + gas + "humidity = \"8 g/kg\"\nflow = \"120 m3/h\"\n");
    EXPECT_NE(said.find("gas.flow = \"120 m3/h\" is a volume flow"), std::string::npos) << said;
    auto const by_temperature =
        read_text(box + gas + "humidity = \"0 g/kg\"\nflow = \"36 m3/h\"\nflow_reference.temperature = \"0 degC\"\n");
    EXPECT_NEAR(by_temperature.data.gas.inlet.dry_mass_flow, 0.012923, 1e-5)
        << "dry air at 0 degC and 1 atm: 1.2923 kg/m3";
}

TEST(CaseReader, wants_exactly_one_flow)
{
    EXPECT_NE(mistakes_of(box + gas + "humidity = \"8 g/kg\"\n").find("gas needs a flow"), std::string::npos);
    EXPECT_NE(mistakes_of(box + gas + "humidity = \"8 g/kg\"\nvelocity = \"1 m/s\"\ndry_mass_flow = \"1 kg/h\"\n")
                  .find("more than one flow"),
              std::string::npos);
}

TEST(CaseReader, turns_relative_humidity_into_a_loading)
{
    auto const data = read_text(box + gas + "relative_humidity = \"50 %\"\nvelocity = \"1 m/s\"\n").data;
    double const partial = 0.5 * 47411.6;  // saturation pressure at 80 degC, physics of moist air
    EXPECT_NEAR(data.gas.inlet.humidity, 0.621945 * partial / (101325 - partial), 1e-5);
}

TEST(CaseReader, finds_every_mistake_of_a_file_in_one_pass)
{
    auto const said = mistakes_of(
        "[apparatus]\nshape = \"boxx\"\n[granules]\ndiameter = \"1 mm\"\ndensity = 1000\nmass = \"-1 "
        "kg\"\n[time]\nduration = \"1 kg\"\n");
    for (auto const* word : {":2: apparatus.shape = \"boxx\"", ":5: granules.density = 1000 needs a unit",
                             ":6: granules.mass", ":8: time.duration"})
        EXPECT_NE(said.find(word), std::string::npos) << word << " in\n" << said;
}

TEST(CaseReader, takes_granules_one_by_one)
{
    auto const data =
        read_text(
            box +
            "[granules]\ndiameter = \"2 mm\"\ndensity = \"1000 kg/m3\"\n"
            "[[granule]]\nposition = [\"5 cm\", \"5 cm\", \"5 cm\"]\nvelocity = [\"0 m/s\", \"0 m/s\", \"-1 m/s\"]\n"
            "[[granule]]\nposition = [\"5 cm\", \"5 cm\", \"7 cm\"]\ndiameter = \"4 mm\"\n")
            .data;
    ASSERT_EQ(data.granules.given.size(), 2u);
    EXPECT_EQ(data.granules.start, "given");
    EXPECT_EQ(data.granules.given[0].diameter, 2e-3);
    EXPECT_EQ(data.granules.given[0].velocity.z, -1);
    EXPECT_EQ(data.granules.given[1].diameter, 4e-3);
    auto const outside = mistakes_of(box +
                                     "[granules]\ndiameter = \"2 mm\"\ndensity = \"1000 kg/m3\"\n[[granule]]\nposition "
                                     "= [\"5 cm\", \"5 cm\", \"2 m\"]\n");
    EXPECT_NE(outside.find("granule[0].position"), std::string::npos) << outside;
}

TEST(CaseReader, allows_over_wetting_only_when_asked)
{
    std::string text;
    std::ifstream in(example("01-lab-layering"));
    for (std::string line; std::getline(in, line);)
        text += (line.starts_with("rate") ? "rate = \"6 kg/h\"" : line) + "\n";
    EXPECT_NE(mistakes_of(text).find("allow_overwetting = true"), std::string::npos);
    text.insert(text.find("rate = \"6 kg/h\""), "allow_overwetting = true\n");
    EXPECT_EQ(mistakes_of(text), "");
}

TEST(CaseReader, refuses_a_spray_between_periodic_sides)
{
    auto text = box + gas + "velocity = \"1 m/s\"\nhumidity = \"8 g/kg\"\n" +
                "[granules]\ndiameter = \"1 mm\"\ndensity = \"1000 kg/m3\"\nmass = \"10 g\"\n" +
                "[spray]\nliquid = \"sodium-benzoate-30\"\nrate = \"0.1 kg/h\"\nsolids_fraction = \"30 %\"\n" +
                "[[nozzle]]\nposition = [\"5 cm\", \"5 cm\", \"50 cm\"]\n";
    EXPECT_EQ(mistakes_of(text), "");
    text.replace(text.find("[time]"), 0, "periodic = [\"x\"]\n");
    EXPECT_NE(mistakes_of(text).find("apparatus.periodic"), std::string::npos) << mistakes_of(text);
}

TEST(CaseReader, needs_only_gas_and_spray_for_a_balance)
{
    EXPECT_NO_THROW(read_case(GRANUM_SOURCE_DIR "/examples/balance/1.toml", Purpose::balance));
    EXPECT_THROW(read_case(GRANUM_SOURCE_DIR "/examples/balance/1.toml", Purpose::run), base::CaseError);
}

TEST(LawFamilies, name_each_law_once_with_its_card)
{
    for (auto const& family : law_families()) {
        EXPECT_FALSE(family.cards.empty()) << family.name;
        for (auto const& card : family.cards) {
            EXPECT_FALSE(card.title.empty()) << card.name;
            EXPECT_EQ(std::count_if(family.cards.begin(), family.cards.end(),
                                    [&](auto const& other) { return other.name == card.name; }),
                      1);
        }
    }
    EXPECT_NO_THROW(laws_for("gas.drag"));
    EXPECT_THROW(laws_for("gas.drug"), std::out_of_range);
    EXPECT_THROW(laws_for(""), std::out_of_range) << "families that no case chooses";
}

// Physics table of collision times: R = 0.3 mm, 1445 kg/m3, E = 1e7 Pa, nu = 0.25 at 1 m/s.
TEST(Forecast, bounds_the_step_by_the_published_times)
{
    Case data;
    data.granules.given = {{.position = {}, .velocity = {1, 0, 0}, .spin = {}, .diameter = 0.6e-3}};
    data.granules.parcels = 1;
    auto const f = forecast(data, 1);
    EXPECT_DOUBLE_EQ(f.contact_speed, 1);
    EXPECT_NEAR(f.bounds[0].seconds / 0.2, 1.953e-5, 5e-9);
    EXPECT_NEAR(f.bounds[1].seconds * 20, 4.975e-5, 5e-8) << "the table rounds the factor to 2.87";
    EXPECT_NEAR(f.overlap, 0.0563, 5e-5);
}

TEST(Forecast, of_the_lab_case_is_its_geometry_and_weight)
{
    auto const f = forecast(read_case(example("01-lab-layering")).data, 2);
    EXPECT_EQ(f.cells, 16 * 16 * 64);
    EXPECT_NEAR(f.granules, 1 / (1445 * math::pi / 6 * std::pow(0.6e-3, 3)), 1);
    EXPECT_NEAR(f.plate_velocity, 0.04 * 1.008 / (0.9956 * math::pi * 0.09 * 0.09), 0.005);
    EXPECT_GT(f.plate_velocity, f.minimum_fluidisation);
    EXPECT_LT(f.plate_velocity, f.terminal_velocity);
}

TEST(WallTime, counts_work_by_processor_and_memory)
{
    auto const data = read_case(example("01-lab-layering")).data;
    auto const f = forecast(data, 1);
    MachineSpeed const usual{5e7, 2e10}, quick{1e8, 2e10}, wide{5e7, 4e10}, both{1e8, 4e10};
    double const one = wall_time(data, f, 1, usual), two = wall_time(data, f, 2, usual);
    EXPECT_LT(two, one);
    EXPECT_GT(two, one / 2);
    // The lab's granules and cells stay in caches: memory is nothing to it. Eight beds do not, and cost more than eight
    // times one.
    EXPECT_NEAR(one / wall_time(data, f, 1, quick), 2, 1e-12);
    EXPECT_NEAR(one / wall_time(data, f, 1, wide), 1, 1e-12);
    auto alone = data;
    alone.spray.nozzles.clear();
    auto large = f;
    large.parcels *= 8, large.cells *= 8;
    double const eight = wall_time(alone, large, 1, usual);
    EXPECT_GT(eight, 8.5 * wall_time(alone, f, 1, usual));
    EXPECT_NEAR(eight / wall_time(alone, large, 1, both), 2, 1e-12);
    for (auto const& better : {quick, wide}) {
        EXPECT_LT(wall_time(alone, large, 1, better), eight);
        EXPECT_GT(wall_time(alone, large, 1, better), eight / 2);
    }
    EXPECT_EQ(wall_time(Case{}, Forecast{}, 1, usual), 0);
}

TEST(WallTime, is_told_for_the_machine_at_hand)
{
    auto const speed = machine_speed(2);
    EXPECT_GT(speed.evaluations, 1e5);
    EXPECT_GT(speed.bytes, 1e8);
    EXPECT_TRUE(std::isfinite(speed.evaluations) && std::isfinite(speed.bytes));
}
}
