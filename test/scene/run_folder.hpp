// A run folder as a small spray run leaves it, made up from random numbers: for tests of the report and to look at.
#pragma once

#include "granum/base/random.hpp"
#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "granum/io/snapshot_file.hpp"
#include "granum/io/text_file.hpp"
#include "granum/math/constants.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace granum::scene
{
struct RunFolderScene
{
    std::string title = "Lab layering of sodium benzoate";
    int granules = 11000;
    int events = 6000;
    int rows = 600;  //!< of the time series
};

//! Uniform numbers in [0, 1), the same in every test.
class Numbers
{
  public:
    double operator()() { return base::philox({count_++, 7, 0, 0}, {1, 2})[0] / 4294967296.0; }
    double normal() { return std::sqrt(-2 * std::log(1 - (*this)())) * std::cos(2 * math::pi * (*this)()); }

  private:
    std::uint32_t count_ = 0;
};

//! Chamber of the lab granulator: plate 180 mm, cone to 250 mm over 450 mm, 1 m high.
inline geometry::Chamber lab_chamber()
{
    geometry::Chamber chamber;
    chamber.shape = geometry::Chamber::Shape::revolution;
    chamber.profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}};
    return chamber;
}

inline io::Snapshot bed_snapshot(RunFolderScene const& scene)
{
    Numbers number;
    io::Snapshot out;
    out.time = 3.0;
    auto const chamber = lab_chamber();
    out.outline = io::mid_plane_outline(chamber);
    out.mid_plane = io::mid_plane(chamber);
    out.nozzles = {{0, 0, 0.3}};
    auto radius_at = [](double z) { return 0.09 + 0.035 * std::min(1.0, z / 0.45); };
    for (int g = 0; g < scene.granules; ++g) {
        double const z = 0.003 + 0.16 * number() + (number() < 0.12 ? 0.1 * number() : 0);
        double const r = (radius_at(z) - 0.004) * std::sqrt(number()), angle = 2 * math::pi * number();
        math::Vec3 const x{r * std::cos(angle), r * std::sin(angle), z};
        double const spray = std::exp(-(r * r) / 0.0012) * std::exp(-std::pow((z - 0.2) / 0.07, 2));
        out.granules.position.push_back(x);
        out.granules.radius.push_back(2.25e-3);
        out.granules.temperature.push_back(338.7 + 0.8 * number.normal() - 9 * spray);
        out.granules.moisture.push_back(std::max(0.0, 0.0008 + 0.0004 * number.normal() + 0.008 * spray));
        out.granules.diameter.push_back(0.6e-3 * (1 + 0.002 * number()));
        out.granules.count.push_back(430);
        bool const layered = number() < 0.8;
        out.granules.porosity.push_back(layered ? 0.36 + 0.02 * number.normal()
                                                : std::numeric_limits<double>::quiet_NaN());
        out.granules.layer_mass.push_back(layered ? 1e-8 * (0.2 + number()) : 0);
    }
    for (int d = 0; d < scene.granules / 15; ++d) {
        double const fall = 0.15 * number();
        double const r = 0.3 * fall * std::sqrt(number()), angle = 2 * math::pi * number();
        out.droplets.position.push_back({r * std::cos(angle), r * std::sin(angle), 0.3 - fall});
        out.droplets.diameter.push_back(40e-6);
    }
    auto& gas = out.gas;
    gas.nx = 25, gas.nz = 100;
    gas.x0 = -0.125, gas.dx = gas.dz = 0.01;
    for (int k = 0; k < gas.nz; ++k)
        for (int i = 0; i < gas.nx; ++i) {
            double const x = gas.x0 + (i + 0.5) * gas.dx, z = (k + 0.5) * gas.dz;
            gas.open.push_back(std::abs(x) < radius_at(z) ? 1 : 0);
            gas.speed.push_back(1.6 + 0.5 * std::sin(40 * x + 30 * z) +
                                9 * std::exp(-x * x / 4e-4 - std::pow((z - 0.26) / 0.05, 2)));
            gas.temperature.push_back(338 + 15 * std::exp(-z / 0.02));
            gas.humidity.push_back(0.0138);
            gas.voidage.push_back(z < 0.18 ? 0.6 : 1);
            gas.drying_potential.push_back(0.72);
        }
    return out;
}

inline nlohmann::json run_summary(RunFolderScene const& scene)
{
    return {
        {"schema", 1},
        {"title", scene.title},
        {"ended", "done"},
        {"run", {{"wall_s", 412.3}, {"simulated_s", 3.0}, {"steps", 120000}, {"ranks", 2}}},
        {"granules", {{"parcels", scene.granules}, {"represented", 6.12e6}, {"mass_kg", 1.0}}},
        {"gas", {{"cells", 16200}}},
        {"balance",
         {{"eta", 0.71749}, {"outlet_humidity", 0.0138333}, {"outlet_temperature_K", 338.76}, {"wet_bulb_K", 304.016}}},
        {"result",
         {{"eta_global", 0.7161},
          {"outlet_humidity", 0.01386},
          {"outlet_temperature_K", 338.6},
          {"bed_temperature_K", 338.5}}},
        {"bed", {{"pressure_drop_Pa", 331.0}, {"weight_over_area_Pa", 336.2}, {"height_m", 0.17}}},
        {"spray",
         {{"sprayed_kg", 3e-4},
          {"deposited_kg", 2.7e-4},
          {"overspray_kg", 1.6e-5},
          {"on_walls_kg", 4e-6},
          {"in_flight_kg", 1e-5}}},
        {"water", {{"sprayed_kg", 7e-4}, {"evaporated_kg", 6.93e-4}}},
        {"ledger",
         {{"solids", {{"relative_error", 3.1e-14}}},
          {"water", {{"relative_error", 2.2e-12}}},
          {"energy", {{"relative_error", 4.8e-6}}}}},
        {"events", {{"count", scene.events}}},
        {"product",
         {{"validated", false},
          {"porosity",
           {{"mean", 0.361},
            {"p10", 0.334},
            {"p50", 0.360},
            {"p90", 0.389},
            {"interval_low", 0.23},
            {"interval_high", 0.49}}},
          {"size_m", {{"d10", 0.6001e-3}, {"d50", 0.6006e-3}, {"d90", 0.6011e-3}}}}},
        {"performance",
         {{"granule_steps_per_s", 3.1e6},
          {"share",
           {{"contacts", 0.41},
            {"neighbours", 0.07},
            {"gas", 0.22},
            {"exchange", 0.15},
            {"spray and drying", 0.11},
            {"output", 0.04}}}}},
        {"warnings", {"drag law beetstra: 12 parcels were above its range of Reynolds numbers (1000)"}}};
}

inline void write_run_series(std::string const& path, RunFolderScene const& scene)
{
    Numbers number;
    io::SeriesWriter series(path, {{"time", "s"},
                                   {"bed_temperature", "K"},
                                   {"outlet_temperature", "K"},
                                   {"outlet_humidity", "kg/kg"},
                                   {"drying_potential", "1"},
                                   {"pressure_drop", "Pa"},
                                   {"sprayed_water", "kg"},
                                   {"evaporated_water", "kg"},
                                   {"bed_moisture", "kg/kg"},
                                   {"bed_height", "m"}});
    for (int row = 0; row < scene.rows; ++row) {
        double const t = 0.005 * row;
        double const wander = 0.2 * std::sin(3 * t) + 0.03 * number.normal();
        series.append(std::vector<double>{t, 338.5 + 0.3 * wander, 338.6 + wander, 0.01385 - 1e-4 * wander,
                                          0.716 + 0.005 * wander, 331 + 40 * number.normal(), 2.333e-4 * t, 2.31e-4 * t,
                                          1.1e-3 + 2e-5 * wander, 0.17 + 0.01 * number.normal()});
    }
}

inline void write_run_events(std::string const& path, RunFolderScene const& scene)
{
    Numbers number;
    io::EventsWriter events(path, {{"granule", "1", "identity of the granule parcel"},
                                   {"solids", "kg", "dry solids that the deposit left"},
                                   {"droplet_diameter", "m", "of a real droplet at impact"},
                                   {"moisture_at_impact", "kg/kg", "water per solids of the droplet at impact"},
                                   {"drying_potential", "1", "local, at impact"},
                                   {"drying_time", "s", "from impact to dry"},
                                   {"mean_drying_potential", "1", "mean over the drying time"},
                                   {"normal_speed", "m/s", "of the impact"},
                                   {"initial", "1", "share placed by the quasi-steady start"},
                                   {"porosity", "1", "of the layer element"}});
    for (int event = 0; event < scene.events; ++event) {
        double const eta = 0.68 + 0.05 * number.normal();
        events.append(std::vector<double>{1.0 * event, 1e-10 * std::exp(number.normal()),
                                          40e-6 * std::exp(0.47 * number.normal()), 2.1 + 0.15 * number.normal(), eta,
                                          0.05 * std::exp(0.8 * number.normal()), eta + 0.01 * number.normal(),
                                          8 * std::exp(0.4 * number.normal()), event % 10 == 0 ? 1.0 : 0.0,
                                          0.70 - 0.5 * eta + 0.02 * number.normal()});
    }
}

//! All that the report reads, in the folder `path`.
inline void write_run_folder(std::string const& path, RunFolderScene const& scene = {})
{
    std::filesystem::create_directories(path);
    io::replace_text(path + "/summary.json", run_summary(scene).dump(2));
    write_run_series(path + "/timeseries.csv", scene);
    write_run_events(path + "/events.h5", scene);
    io::write_snapshot(path + "/snapshots.h5", bed_snapshot(scene));
    io::replace_text(path + "/resolved.txt", "title = \"" + scene.title +
                                                 "\"\n\n[granules]\ndiameter = \"0.6 mm\"  # given\nmass = \"1 kg\"\n");
    io::replace_text(path + "/granum.log", "Granum\nwarning: made for a test\n");
}
}
