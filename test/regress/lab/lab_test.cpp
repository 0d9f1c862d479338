// The main job: the lab recipe run by the program, and everything that its results owe to the balance of the apparatus.
//
// Each run is made once and looked at from all sides. The recipe is that of the example, see scene/lab.hpp.
#include "scene/lab.hpp"
#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "granum/material/moist_air.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace
{
using namespace granum;
using nlohmann::json;
namespace fs = std::filesystem;
namespace air = material;

// The recipe, as the example states it.
constexpr double dry_inlet = 120.0 / 3600 * 1.2;  // kg/s
constexpr double atomising_air = 1.2 / 3600;      // kg/s
constexpr double inlet_temperature = 353.15, inlet_humidity = 0.008;
constexpr double feed_temperature = 298.15, air_temperature = 293.15;  // K
constexpr double spray_rate = 1.2 / 3600, solids_fraction = 0.3;       // kg/s, 1
constexpr double bed_heat_capacity = 1.0 * 1400;                       // J/K
constexpr double porosity_at_zero = 0.70, porosity_slope = -0.5;

struct Finished
{
    int status;
    std::string folder, said, errors;
    json summary;
    io::Series series;
    io::EventTable events;

    std::vector<double> const& column(char const* name) const { return *series.find(name); }
    std::vector<double> const& event(char const* name) const { return *events.find(name); }

    //! Mean over the samples from `from` on, s.
    double mean(char const* name, double from, double to = 1e300) const
    {
        double sum = 0;
        int count = 0;
        for (std::size_t row = 0; row < series.rows(); ++row)
            if (column("time")[row] >= from && column("time")[row] <= to) sum += column(name)[row], ++count;
        return sum / count;
    }
    //! Slope of the straight line through the samples from `from` to `to`, per s.
    double slope(char const* name, double from, double to) const
    {
        double const t0 = mean("time", from, to), y0 = mean(name, from, to);
        double ty = 0, tt = 0;
        for (std::size_t row = 0; row < series.rows(); ++row) {
            double const t = column("time")[row];
            if (t < from || t > to) continue;
            ty += (t - t0) * (column(name)[row] - y0);
            tt += (t - t0) * (t - t0);
        }
        return ty / tt;
    }
    //! Mean of an event column over the solids of sprayed deposits.
    double event_mean(char const* name) const
    {
        double sum = 0, solids = 0;
        for (std::size_t row = 0; row < events.rows(); ++row) {
            double const sprayed = (1 - event("initial")[row]) * event("solids")[row];
            sum += sprayed * event(name)[row];
            solids += sprayed;
        }
        return sum / solids;
    }
};

//! Runs the reduced case on two ranks, once for all tests that ask for it.
Finished const& run_of(std::string const& name, std::map<std::string, std::string> const& changes,
                       std::string const& more = "")
{
    static scene::TemporaryFolder const folder;
    static std::map<std::string, Finished> runs;
    if (auto const made = runs.find(name); made != runs.end()) return made->second;
    auto const path = folder / (name + ".toml");
    scene::write_lab_case(path, changes, more);
    Finished run{.folder = folder / name};
    scene::Program program({"run", path, "-n", "2", "-o", run.folder, "--json"}, folder / (name + ".said"));
    run.status = program.wait();
    run.said = program.said();
    run.errors = program.errors();
    if (run.status == 0) {
        run.summary = json::parse(scene::text_of(run.folder + "/summary.json"));
        run.series = io::read_series(run.folder + "/timeseries.csv");
        run.events = io::read_events(run.folder + "/events.h5");
    }
    return runs[name] = run;
}
Finished const& steady_run()
{
    // Whether noise lets the bed end its settling by itself so soon is a matter of chance.
    return run_of("steady", {{"duration", "\"2 s\""}}, "[start]\nsettling = \"1.4 s\"\n");
}

class Lab : public ::testing::Test
{
  protected:
    void SetUp() override { ASSERT_EQ(steady_run().status, 0) << steady_run().errors; }
    Finished const& run = steady_run();
    double number(std::string const& pointer) const { return run.summary.at(json::json_pointer(pointer)); }
};
}

TEST_F(Lab, ledgers_close)
{
    EXPECT_LT(number("/ledger/solids/relative_error"), 1e-9);
    EXPECT_LT(number("/ledger/water/relative_error"), 1e-9);
    EXPECT_LT(number("/ledger/energy/relative_error"), 1e-6);
    EXPECT_LT(number("/ledger/momentum/relative_error"), 1e-9);
    // And what they count is what the recipe brings.
    double const time = number("/run/simulated_s");
    EXPECT_NEAR(number("/ledger/solids/in"), spray_rate * solids_fraction * time, 1e-3 * 2e-4);
    EXPECT_NEAR(number("/ledger/water/in"), (spray_rate * (1 - solids_fraction) + dry_inlet * inlet_humidity) * time,
                1e-3 * 1.1e-3);
}

TEST_F(Lab, gas_carries_the_bed)
{
    EXPECT_NEAR(number("/bed/pressure_drop_Pa") / number("/bed/weight_over_area_Pa"), 1, 0.03);
    // Weight over the plate and over the widest place of the chamber.
    EXPECT_LT(number("/bed/weight_over_area_Pa"), 9.9 / (math::pi / 4 * 0.18 * 0.18));
    EXPECT_GT(number("/bed/weight_over_area_Pa"), 9.8 / (math::pi / 4 * 0.25 * 0.25));
}

TEST_F(Lab, outlet_humidity_is_that_of_the_balance)
{
    double const balance =
        (dry_inlet * inlet_humidity + spray_rate * (1 - solids_fraction)) / (dry_inlet + atomising_air);
    EXPECT_NEAR(number("/balance/outlet_humidity"), balance, 1e-9);
    EXPECT_NEAR(number("/result/outlet_humidity"), balance, 0.03 * balance);
    double const span = number("/balance/wet_bulb_humidity") - dry_inlet * inlet_humidity / (dry_inlet + atomising_air);
    EXPECT_NEAR(number("/result/eta_global"), number("/balance/eta"), 0.03 * balance / span);
}

TEST_F(Lab, water_evaporates_as_fast_as_it_is_sprayed)
{
    double const sprayed = number("/water/sprayed_last_two_thirds_kg");
    EXPECT_NEAR(sprayed, spray_rate * (1 - solids_fraction) * 2 * number("/run/simulated_s") / 3, 0.01 * sprayed);
    EXPECT_NEAR(number("/water/evaporated_last_two_thirds_kg"), sprayed, 0.03 * sprayed);
}

TEST_F(Lab, sprayed_solids_are_all_somewhere)
{
    double const sprayed = number("/spray/sprayed_kg");
    EXPECT_NEAR(sprayed, spray_rate * solids_fraction * number("/run/simulated_s"), 1e-3 * sprayed);
    EXPECT_NEAR(number("/spray/deposited_kg") + number("/spray/overspray_kg") + number("/spray/on_walls_kg") +
                    number("/spray/in_flight_kg"),
                sprayed, 1e-9 * sprayed);
    EXPECT_GT(number("/spray/deposited_kg"), 0.8 * sprayed) << "a nozzle above a bed sprays onto the bed";
}

TEST_F(Lab, nothing_is_colder_or_hotter_than_what_makes_it_so)
{
    double const coldest = std::min({feed_temperature, air_temperature, number("/balance/wet_bulb_K")});
    EXPECT_GE(number("/result/coldest_K"), coldest);
    EXPECT_LE(number("/result/hottest_K"), inlet_temperature * (1 + 1e-14));  // to the last digits
    // Droplets may cool to their own equilibrium in the dry air of the nozzle. It lies below the wet bulb of adiabatic
    // saturation, by 1.12 K in dry air of 25 degC (7.15 against 8.27 degC) and by less in colder air.
    double const droplet = air::wet_bulb(air_temperature, 0, math::standard_pressure).temperature - 1.12;
    ASSERT_GT(run.events.rows(), 0u);
    for (auto const* name : {"droplet_temperature", "gas_temperature", "mean_gas_temperature", "granule_temperature",
                             "mean_granule_temperature"})
        for (double const t : run.event(name)) {
            ASSERT_GE(t, name == std::string("droplet_temperature") ? droplet : coldest) << name;
            ASSERT_LE(t, inlet_temperature) << name;
        }
}

TEST_F(Lab, bed_settles_where_its_outlet_is_that_of_the_balance)
{
    // What evaporates above the bed and the nozzle's air cool the gas on its way to the outlet: the bed is warmer.
    double const balance = number("/balance/outlet_temperature_K"), bed = number("/result/bed_temperature_K");
    EXPECT_GE(number("/start/settled_s"), 1.2);
    EXPECT_NEAR(number("/result/outlet_temperature_K"), balance, 1);
    EXPECT_GT(bed, balance + 0.5);
    EXPECT_LT(bed, balance + 4);
    EXPECT_NEAR(number("/heat/to_settle_the_bed_J"), bed_heat_capacity * (bed - balance), 0.15 * bed_heat_capacity);
}

TEST_F(Lab, summary_has_all_keys_and_is_what_was_printed)
{
    for (auto const* key : {"/schema",
                            "/run/wall_s",
                            "/run/simulated_s",
                            "/run/steps",
                            "/run/ranks",
                            "/granules/parcels",
                            "/granules/represented",
                            "/granules/mass_kg",
                            "/gas/cells",
                            "/balance/eta",
                            "/balance/outlet_humidity",
                            "/balance/outlet_temperature_K",
                            "/balance/wet_bulb_K",
                            "/result/eta_global",
                            "/result/outlet_humidity",
                            "/result/outlet_temperature_K",
                            "/result/bed_temperature_K",
                            "/bed/pressure_drop_Pa",
                            "/bed/weight_over_area_Pa",
                            "/bed/height_m",
                            "/spray/sprayed_kg",
                            "/spray/deposited_kg",
                            "/spray/overspray_kg",
                            "/spray/on_walls_kg",
                            "/spray/in_flight_kg",
                            "/water/sprayed_kg",
                            "/water/evaporated_kg",
                            "/ledger/solids/relative_error",
                            "/ledger/water/relative_error",
                            "/ledger/energy/relative_error",
                            "/events/count",
                            "/product/porosity/mean",
                            "/product/porosity/p10",
                            "/product/porosity/p50",
                            "/product/porosity/p90",
                            "/performance/granule_steps_per_s",
                            "/performance/share/contacts",
                            "/performance/share/neighbours",
                            "/performance/share/gas",
                            "/performance/share/exchange",
                            "/performance/share/spray_and_drying",
                            "/performance/share/output",
                            "/performance/gas/us_per_cell_step",
                            "/performance/gas/bytes_per_cell_step",
                            "/performance/gas/triad_bytes_per_s",
                            "/performance/gas/share_of_bandwidth"}) {
        ASSERT_TRUE(run.summary.contains(json::json_pointer(key))) << key;
        if (key != std::string("/schema")) {
            EXPECT_TRUE(run.summary.at(json::json_pointer(key)).is_number()) << key;
        }
    }
    EXPECT_EQ(json::parse(run.said), run.summary) << "--json prints the summary and nothing else";
    EXPECT_EQ(run.summary["ended"], "done");
    EXPECT_NEAR(number("/granules/represented"), 1.0 / (1445 * math::pi / 6 * std::pow(0.6e-3, 3)), 1);
    double share = 0;
    for (auto const& part : run.summary["performance"]["share"]) share += part.get<double>();
    EXPECT_NEAR(share, 1, 1e-9);
}

TEST_F(Lab, summary_says_what_the_series_says)
{
    double const end = number("/run/simulated_s");
    auto const means_agree = [&](std::map<std::string, char const*> const& columns, double from) {
        for (auto const& [key, column] : columns) EXPECT_NEAR(number(key) / run.mean(column, from), 1, 1e-6) << key;
    };
    means_agree({{"/result/eta_global", "drying_potential"},
                 {"/result/outlet_humidity", "outlet_humidity"},
                 {"/result/outlet_temperature_K", "outlet_temperature"},
                 {"/result/bed_temperature_K", "bed_temperature"}},
                std::max(2 * end / 3, number("/start/settled_s")));
    means_agree({{"/bed/pressure_drop_Pa", "pressure_drop"},
                 {"/bed/weight_over_area_Pa", "weight_over_area"},
                 {"/bed/height_m", "bed_height"}},
                end / 3);
    EXPECT_NEAR(run.column("sprayed_solids").back() / number("/spray/sprayed_kg"), 1, 1e-6);
    EXPECT_NEAR(run.column("evaporated_water").back() / number("/water/evaporated_kg"), 1, 1e-6);
}

TEST_F(Lab, every_dried_deposit_left_one_event)
{
    long sprayed = 0;
    double solids = 0, old_solids = 0;
    for (std::size_t row = 0; row < run.events.rows(); ++row) {
        // Droplets that fell on deposits of the start left events with solids of both.
        double const share = run.event("initial")[row], all = run.event("solids")[row];
        bool const old = share >= 1;
        sprayed += !old;
        old_solids += share * all, solids += (1 - share) * all;
        ASSERT_LE(run.event("t_dry_end")[row], number("/run/simulated_s") * (1 + 1e-12));
        ASSERT_EQ(run.event("t_deposit")[row] < 0, old);
    }
    EXPECT_EQ(sprayed, run.summary["events"]["count"].get<long>());
    EXPECT_GT(sprayed, 1000);
    // What was deposited has dried, or is still open; what was there at the start has dried.
    EXPECT_LE(solids, number("/spray/deposited_kg") * (1 + 1e-9));
    EXPECT_GT(solids, 0.9 * number("/spray/deposited_kg"));
    EXPECT_NEAR(old_solids, number("/ledger/solids/start"), 1e-9 * old_solids);
    // The map is a straight line, so the mean layer follows from the mean potential.
    EXPECT_NEAR(number("/product/porosity/mean"),
                porosity_at_zero + porosity_slope * run.event_mean("mean_drying_potential"), 1e-3);
}

TEST_F(Lab, folder_has_what_a_user_is_promised)
{
    for (auto const* file :
         {"summary.json", "timeseries.csv", "events.h5", "snapshots.h5", "granules.pvd", "droplets.pvd", "gas.pvd",
          "walls.pvd", "case.toml", "resolved.txt", "granum.log", "report.html", "vtk/walls.vtp"})
        EXPECT_GT(fs::file_size(run.folder + "/" + file), 0u) << file;
    // A picture at the start and one each tenth of a second.
    for (auto const* kind : {"granules", "droplets", "gas"}) {
        auto const collection = scene::text_of(run.folder + "/" + kind + ".pvd");
        std::size_t listed = 0, written = 0;
        for (std::size_t at = 0; (at = collection.find("file=\"", at)) != std::string::npos; ++at) ++listed;
        for (auto const& file : fs::directory_iterator(run.folder + "/vtk"))
            written += file.path().filename().string().starts_with(kind);
        EXPECT_EQ(listed, 21u) << kind;
        EXPECT_EQ(written, listed) << kind;
    }
    auto const report = scene::text_of(run.folder + "/report.html");
    EXPECT_NE(report.find("map is not validated on a measured product"), std::string::npos);
    EXPECT_EQ(report.find("src=\"http"), std::string::npos) << "complete in itself";
}

// Nothing is merely initialised: a bed that starts 10 K too cold comes back at the rate of a stirred bed, whose gas
// leaves at the bed's temperature T. With C the heat capacity of the bed, E the water that leaves the granules, W the
// water that droplets bring to them (the rest evaporated above the bed, at the cost of the gas there),
//     C dT/dt = m_in (c_air + Y_in c_vapour) (T_in - T) + m_nozzle c_air (T_nozzle - T) - E L(T) - W c_water (T - T_w).
// E is W less the growth of what is on the granules: a cold bed dries more slowly until more of it is wet. The first
// half second, in which that happens and the bed expands, is left out.
TEST_F(Lab, bed_that_starts_too_cold_recovers_at_the_analytic_rate)
{
    auto const& cold = run_of("cold", {{"duration", "\"2 s\""}},
                              "\n[start]\ntemperature_offset = \"-10 K\"\ngas_temperature = \"" +
                                  std::to_string(number("/balance/outlet_temperature_K") - 10) + " K\"\n");
    ASSERT_EQ(cold.status, 0) << cold.errors;
    auto const& right = run_of("right", {{"duration", "\"2 s\""}}, "\n[start]\nsettling = \"0 s\"\n");
    ASSERT_EQ(right.status, 0) << right.errors;
    double const from = 0.5, to = 2;
    EXPECT_NEAR(cold.column("bed_temperature").front(), number("/balance/outlet_temperature_K") - 10, 1e-3);

    auto const spent = [&](Finished const& of) {
        double const at = of.mean("bed_temperature", from, to);
        double const brought = of.slope("deposited_solids", from, to) * of.event_mean("moisture_at_impact");
        double const evaporated = brought - of.slope("water_on_granules", from, to);
        return evaporated * (air::vapour_enthalpy(at) - air::water_enthalpy(at)) +
               brought * air::heat_capacity_water * (at - of.event_mean("droplet_temperature"));
    };
    double const bed = cold.mean("bed_temperature", from, to);
    double const gained =
        dry_inlet * (air::heat_capacity_air + inlet_humidity * air::heat_capacity_vapour) * (inlet_temperature - bed) +
        atomising_air * air::heat_capacity_air * (air_temperature - bed);
    double const measured = cold.slope("bed_temperature", from, to);
    EXPECT_NEAR(measured / ((gained - spent(cold)) / bed_heat_capacity), 1, 0.05);

    // And against the bed that started where the balance has its outlet: the offset goes as exp(-K t / C), K what the
    // gas that leaves takes per kelvin, and as far as less or more evaporates on the granules of a colder bed.
    double const conductance =
        (dry_inlet + atomising_air) *
        (air::heat_capacity_air + number("/balance/outlet_humidity") * air::heat_capacity_vapour);
    double const offset = right.mean("bed_temperature", from, to) - bed;
    EXPECT_NEAR(offset, 10 * std::exp(-conductance * 0.5 * (from + to) / bed_heat_capacity), 0.2);
    // The gas is that much colder too, all of it from the start on: what more or less it carries away shows at the
    // outlet.
    double const closes = measured - right.slope("bed_temperature", from, to);
    double const leaves = right.mean("outlet_temperature", from, to) - cold.mean("outlet_temperature", from, to);
    EXPECT_NEAR(closes / ((conductance * leaves + spent(right) - spent(cold)) / bed_heat_capacity), 1, 0.05);
}

TEST_F(Lab, doubled_spray_dries_more_slowly_and_gives_more_pores)
{
    auto const& doubled = run_of("doubled", {{"rate", "\"2.4 kg/h\""}, {"duration", "\"1 s\""}});
    ASSERT_EQ(doubled.status, 0) << doubled.errors;
    double const potential = run.event_mean("mean_drying_potential");
    double const doubled_potential = doubled.event_mean("mean_drying_potential");
    double const porosity = number("/product/porosity/mean");
    double const doubled_porosity = doubled.summary["product"]["porosity"]["mean"];
    // The whole apparatus loses this much potential; deposits lose about as much.
    double const loss = number("/balance/eta") - doubled.summary["balance"]["eta"].get<double>();
    EXPECT_GT(loss, 0.2);
    EXPECT_LT(doubled_potential, potential - 0.5 * loss);
    EXPECT_GT(doubled_potential, potential - 2 * loss);
    EXPECT_GT(doubled_porosity, porosity - porosity_slope * 0.5 * loss);
    EXPECT_GT(doubled.event_mean("drying_time"), run.event_mean("drying_time"));
}
