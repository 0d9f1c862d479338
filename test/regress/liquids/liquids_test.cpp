// A solution, a suspension and a melt in the same granulator differ in their deposits as physics has it, and all
// ledgers close.
#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "scene/lab.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace
{
using namespace granum;
using nlohmann::json;

struct Finished
{
    json summary;
    io::Series series;
    io::EventTable events;

    double number(std::string const& pointer) const { return summary.at(json::json_pointer(pointer)); }
    //! Of a column over the solids of sprayed deposits.
    double mean(char const* name) const
    {
        double sum = 0, solids = 0;
        for (std::size_t row = 0; row < events.rows(); ++row) {
            double const sprayed = (1 - (*events.find("initial"))[row]) * (*events.find("solids"))[row];
            sum += sprayed * (*events.find(name))[row];
            solids += sprayed;
        }
        return sum / solids;
    }
};

//! The reduced example, once for all tests.
Finished const& run_of(std::string const& example)
{
    static scene::TemporaryFolder const folder;
    static std::map<std::string, Finished> runs;
    if (auto const made = runs.find(example); made != runs.end()) return made->second;
    auto const path = folder / (example + ".toml"), place = folder / example;
    scene::write_lab_case(path, {{"duration", "\"0.5 s\""}, {"parcels", "2500"}, {"cells", "[10, 10, 40]"}}, "",
                          example);
    scene::Program program({"run", path, "-n", "1", "-o", place, "--json"}, folder / (example + ".said"));
    if (program.wait() != 0) throw std::runtime_error(program.errors());
    return runs[example] = {.summary = json::parse(scene::text_of(place + "/summary.json")),
                            .series = io::read_series(place + "/timeseries.csv"),
                            .events = io::read_events(place + "/events.h5")};
}

Finished const& solution()
{
    return run_of("01-lab-layering");
}
Finished const& suspension()
{
    return run_of("09-suspension");
}
Finished const& melt()
{
    return run_of("10-melt");
}
}

TEST(Liquids, close_every_ledger)
{
    for (auto const* run : {&solution(), &suspension(), &melt()}) {
        SCOPED_TRACE(run->summary.at("title").get<std::string>());
        EXPECT_LT(run->number("/ledger/solids/relative_error"), 1e-9);
        EXPECT_LT(run->number("/ledger/water/relative_error"), 1e-9);
        EXPECT_LT(run->number("/ledger/energy/relative_error"), 1e-6);
        EXPECT_LT(run->number("/ledger/momentum/relative_error"), 1e-9);
        EXPECT_GT(run->events.rows(), 1000u);
    }
}

TEST(Suspension, dries_at_a_constant_rate_where_a_solution_saturates)
{
    // A solution is saturated once the first third of its water has gone; a suspension never is.
    EXPECT_GT(solution().mean("constant_rate_time"), 0);
    EXPECT_EQ(suspension().mean("constant_rate_time"), 0);
    // So its flux at the best is nearer to what it is on the whole.
    auto const peak = [](Finished const& run) { return run.mean("max_flux") / run.mean("mean_flux"); };
    EXPECT_LT(peak(suspension()), 1.1 * peak(solution()));
    // Wetter feed: more water for a kg of layer.
    EXPECT_GT(suspension().mean("moisture_at_impact"), solution().mean("moisture_at_impact"));
}

TEST(Melt, brings_no_water_and_is_solid_long_before_a_solution_is_dry)
{
    EXPECT_EQ(melt().mean("moisture_at_impact"), 0);
    EXPECT_EQ(melt().mean("mean_flux"), 0);
    EXPECT_LT(melt().mean("drying_time"), 0.1 * solution().mean("drying_time"));
    EXPECT_GT(melt().mean("drying_time"), 0);
    // What leaves is as humid as what came in.
    EXPECT_NEAR(melt().number("/result/outlet_humidity"), melt().number("/balance/outlet_humidity"), 1e-5);
    // Its heat warms the bed above the air that enters with 90 degC.
    EXPECT_GT(melt().number("/balance/outlet_temperature_K"), 363.15 + 4);
    double const outlet = melt().number("/result/outlet_temperature_K"),
                 bed = melt().number("/result/bed_temperature_K");
    EXPECT_NEAR(outlet, melt().number("/balance/outlet_temperature_K"), 1);
    // What solidifies in flight warms the gas above the bed.
    EXPECT_LT(bed, outlet);
    EXPECT_GT(bed, outlet - 4);
}
