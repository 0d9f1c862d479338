// Water that evaporates: droplets against measured and published courses (reference cases H-03, H-04, H-05 and H-10),
// and the flow that vapour drives in the gas (Stefan), rows E06.
#include "granum/law/droplet/evaporation.hpp"
#include "granum/law/vapour/film.hpp"
#include "granum/spray/flight.hpp"
#include "scene/reference.hpp"
#include "scene/water_drop.hpp"
#include "unit/gas/chamber_with_gas.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;
using math::zero_celsius;

TEST(WetBulbDrop, settles_near_the_wet_bulb_at_every_humidity)
{
    scene::Table const table("h-03.csv");
    auto const settings = scene::water();
    for (std::size_t row = 0; row < table.rows(); ++row) {
        spray::Seen const air{.temperature = 30 + zero_celsius,
                              .vapour_fraction = table.number(row, "vapour_mass_fraction")};
        auto drop = scene::drop_of(1e-3, air.temperature, settings);
        for (int step = 0; step < 2000; ++step) spray::evaporate(drop, settings, air, 3, 0.01);
        double const bulb = table.number(row, "wet_bulb_C"), humidity = table.number(row, "RH_percent");
        // A drop settles at the diffusive wet bulb, lower than the thermodynamic one of the table the drier the air.
        verify::absolute({"H03", fmt::format("MFIX {:+.2f} K", table.number(row, "mfix_steady_C") - bulb)},
                         fmt::format("drop in air of 30 degC, {} % humidity: steady temperature, degC", humidity), bulb,
                         drop.temperature - zero_celsius, humidity >= 30 ? 0.5 : 1.01);
    }
}

TEST(SuspendedDrop, loses_its_surface_as_measured)
{
    scene::Table const d2("h-04-d2.csv"), temperature("h-04-T.csv");
    struct Run
    {
        char const *name, *words;
        double speed, vapour;
    };
    auto const settings = scene::water();
    double const start = 15 + zero_celsius, d0 = 1.2e-3;
    for (auto const& run :
         {Run{"Re60_RH30", "Re 60, 30 %", 0.813, 0.008059}, Run{"Re150_RH30", "Re 150, 30 %", 2.03, 0.008059},
          Run{"Re60_RH0", "Re 60, dry", 0.813, 0}, Run{"Re150_RH0", "Re 150, dry", 2.03, 0}}) {
        spray::Seen const air{.temperature = 30 + zero_celsius, .vapour_fraction = run.vapour};
        auto drop = scene::drop_of(d0, start, settings);
        double worst = 0;
        for (std::size_t row = 1; row < d2.rows(); ++row) {
            double const span = d2.number(row, "t_s") - d2.number(row - 1, "t_s");
            for (int step = 0; step < 500; ++step) spray::evaporate(drop, settings, air, run.speed, span / 500);
            double const now = std::pow(drop.diameter(settings.liquid) / d0, 2);
            worst = std::max(worst, std::abs(now - d2.number(row, run.name)));
        }
        std::string const name = fmt::format("suspended drop, {}: ", run.words);
        verify::below("H04", name + "d^2/d0^2, largest difference from the measured", 0.03, worst);
        if (std::string(run.name) == "Re150_RH30") continue;  // not in the measured temperatures
        double const measured = temperature.number(temperature.rows() - 1, run.name);
        if (run.vapour > 0)
            verify::absolute("H04", name + "last T - T0, K", measured, drop.temperature - start, 1);
        else
            verify::differs("H04", name + "last T - T0, K, from the measured", 3,
                            std::abs(drop.temperature - start - measured),
                            "the support conducts heat: dry wet bulb -4.5 K, measured -2.4 to -2.9 K");
    }
}

TEST(Drop, keeps_the_d2_law)
{
    scene::Table const table("h-10.csv");
    double worst = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.number(row, "Sh") != 2) continue;
        double const d0 = table.number(row, "d0_m"), spalding = table.number(row, "B_M");
        // Dry air of 25 degC over a surface just wet enough for this B: w_s = B / (1 + B). Ours has properties of its
        // own film: the case's K is scaled to them.
        double const ws = spalding / (1 + spalding);
        double const molar =
            ws / material::molar_mass_water / (ws / material::molar_mass_water + (1 - ws) / material::molar_mass_air);
        double const t = 298.15, activity = molar * 101325 / material::saturation_pressure(t);
        auto const film = law::vapour::film(t, activity, t, 0, 101325);
        double const rate = law::droplet::evaporation({d0, t, activity, 0}, {t, 0, 101325}).mass;
        double const expected = table.number(row, "K_m2_per_s") * film.density * film.diffusivity / (1.1 * 2.6e-5);
        worst = std::max(worst, std::abs(4 * rate / (math::pi * 997 * d0) / expected - 1));
    }
    verify::below("H10", "drop in still air, B 0.005 to 0.02: -d(d^2)/dt, largest share off", 1e-3, worst);

    // Lives from an independent program, at the temperature that the drop settles at.
    struct Life
    {
        double celsius, humidity, surface, d0, seconds;
    };
    auto const settings = scene::water();
    for (auto const& life : {Life{25, 0, 7.150, 1.1e-3, 844.5}, Life{60, 0.008, 25.377, 30e-6, 0.300}}) {
        spray::Seen const air{.temperature = life.celsius + zero_celsius,
                              .vapour_fraction = material::fraction(life.humidity)};
        auto drop = scene::drop_of(life.d0, life.surface + zero_celsius, settings);
        for (int step = 0; step < 4000; ++step) spray::evaporate(drop, settings, air, 0, life.seconds / 8000);
        verify::absolute("H10",
                         fmt::format("drop of {:.2g} mm in air of {} degC: diameter at half its life, share",
                                     1e3 * life.d0, life.celsius),
                         0.70711, drop.diameter(settings.liquid) / life.d0, 2e-3);
    }
}

TEST(Spray, that_evaporates_in_a_hot_closed_box_ends_at_the_state_of_the_balance)
{
    // 10 g of water of 20 degC in drops of 0.2 mm, in 1 m3 of dry air of 200 degC.
    gas::Settings const settings{.outlets = {}, .gravity = {}};
    gas::ChamberWithGas box({.size = {1, 1, 1}}, {1, 1, 1}, {}, settings, 200 + zero_celsius, 0);
    auto flight = scene::water();
    auto drop = scene::drop_of(2e-4, 20 + zero_celsius, flight);
    drop.weight = 0.01 / drop.water;
    double const solids = drop.solids();
    double const mass = box.sum(box.state.mass), heat = box.sum(box.state.enthalpy) + drop.enthalpy(flight.liquid);
    double work = 0, most = 0;
    for (int step = 0; step < 4000; ++step) {
        double const dt = 1e-3;
        box.sources.clear(box.grid);
        auto const c = box.grid.at(0, 0, 0);
        flight.pressure = box.state.static_pressure;
        if (drop.water > 0) {
            auto const given = spray::evaporate(drop, flight,
                                                {.temperature = box.state.temperature[c],
                                                 .vapour_fraction = box.state.vapour_fraction[c],
                                                 .density = box.state.density[c]},
                                                0, dt);
            box.sources.mass[c] = box.sources.vapour[c] = given.vapour / dt;
            box.sources.enthalpy[c] = given.enthalpy / dt;
        }
        work += box.step(dt).pressure_work;
        most = std::max(most, std::abs(box.sum(box.state.enthalpy) + drop.enthalpy(flight.liquid) - heat - work));
    }
    auto const c = box.grid.at(0, 0, 0);
    double const t = box.state.temperature[c] - zero_celsius, fall = box.state.static_pressure - 101325;
    EXPECT_LT(drop.liquid_water(), 1e-9);
    // The same balance with the same heat capacities: U = H - p V is kept.
    double const dry = mass, moles = dry / material::molar_mass_air + 0.01 / material::molar_mass_water;
    double const constant = moles * math::gas_constant;
    double const energy = 1006 * dry * 200 + 0.01 * 4186 * 20 - 101325;
    double const exact = (energy - 0.01 * 2501e3 + constant * zero_celsius) / (1006 * dry + 18.60 - constant);
    EXPECT_LT(solids, 1e-10);
    verify::absolute("H05", "spray in a hot box: temperature, degC, by our heat capacities", exact, t, 1e-3);
    verify::relative("H05", "spray in a hot box: pressure, Pa, by our heat capacities",
                     constant * (exact + zero_celsius), box.state.static_pressure, 1e-5);
    verify::relative({"H05", "FDS 2 %"}, "spray in a hot box: temperature, degC", 154.3, t, 0.01);
    verify::relative({"H05", "FDS 2 %"}, "spray in a hot box: pressure, Pa", 101325 - 7813.7, 101325 + fall, 0.01);
    verify::differs({"H05", "FDS 2 %"}, "spray in a hot box: fall of the pressure, share off", 0.035,
                    std::abs(fall / -7813.7 - 1), "heat capacities that do not change with the temperature");
    verify::relative("H05", "spray in a hot box: gain of mass, kg", 0.01, box.sum(box.state.mass) - mass, 1e-6);
    verify::below("H05", "spray in a hot box: energy missing over that of the air", 1e-10, most / heat);
}

//! A tube of 10 x 10 x 100 mm whose bottom gives vapour, in a stream of dry air across its upper end.
struct StefanTube
{
    static constexpr double length = 0.1, side = 0.01, density = 1.1, diffusivity = 1e-3;
    double const vapour = density * diffusivity / length * std::log(5) * side * side;  //!< kg/s
    gas::ChamberWithGas run;
    int cells;

    explicit StefanTube(int number) : run(made(number)), cells(number)
    {
        auto const bottom = run.grid.at(0, 0, 0);
        run.sources.mass[bottom] = run.sources.vapour[bottom] = vapour;
        run.sources.enthalpy[bottom] = vapour * material::vapour_enthalpy(293.15);
        for (int step = 0; step < 400 * cells; ++step) run.step(0.1 / cells);
    }

    static gas::ChamberWithGas made(int number)
    {
        double const low = length * (number - 1) / number;
        auto const top_cell = [low](math::Vec3 const& from, math::Vec3 const& to) {
            return (to.y - from.y) * std::max(0.0, to.z - std::max(from.z, low));
        };
        gas::Settings settings{
            .inlets = {gas::Inlet{.mass_flow = 2e-5, .at = {.direction = 0, .upper = false, .share = top_cell}}},
            .outlets = {gas::Outlet{.resistance = 0, .at = {.direction = 0, .upper = true, .share = top_cell}}},
            .gravity = {},
            .density = density,
            .diffusivity = diffusivity,
            .tolerance = 1e-10};
        return {{.size = {side, side, length}}, {1, 1, number}, {}, settings, 293.15, 0};
    }

    double fraction(int k) const { return run.at(run.state.vapour_fraction, 0, 0, k); }
};

TEST(StefanTube, has_the_profile_and_the_flow_of_the_closed_form)
{
    // Air stands still: rho u = m, ln(1 - w) rises by m dz / (rho D).
    double coarser = 0;
    for (int const cells : {10, 20, 40}) {
        StefanTube const tube(cells);
        double const flux = tube.vapour / (tube.side * tube.side);
        int const last = cells - 2;
        double worst = 0;
        for (int k = 0; k <= last; ++k) {
            double const below = tube.length * (last - k) / cells;
            double const exact =
                1 - (1 - tube.fraction(last)) * std::exp(-flux * below / (tube.density * tube.diffusivity));
            worst = std::max(worst, std::abs(tube.fraction(k) - exact));
        }
        if (coarser > 0)
            verify::between("E06", fmt::format("Stefan tube: order from {} to {} cells", cells / 2, cells), 1.8, 2.2,
                            std::log2(coarser / worst));
        coarser = worst;
        if (cells < 40) continue;
        verify::below("E06", "Stefan tube, 40 cells, vapour up to 0.8: largest fraction off", 1e-3, worst);
        verify::relative("E06", "Stefan tube: speed in its middle, m/s", flux / tube.density,
                         tube.run.at(tube.run.state.velocity[2], 0, 0, cells / 2), 1e-6);
    }
}

TEST(Injection, along_a_channel_accelerates_the_gas_against_the_pressure_of_the_closed_form)
{
    // Mass that enters at rest everywhere: u = m x / rho, and p(0) - p(x) = rho u^2 without friction.
    double const length = 1, side = 0.01, density = 1.2, rate = 1.2e-3;  // kg/s in all: 10 m/s at the end
    double coarser = 0;
    for (int const cells : {20, 40, 80}) {
        gas::Settings settings{.outlets = {gas::Outlet{.resistance = 0, .at = {.direction = 0, .upper = true}}},
                               .walls = {gas::Wall{.slip = true}},
                               .gravity = {},
                               .density = density,
                               .tolerance = 1e-10};
        gas::ChamberWithGas run({.size = {length, side, side}}, {cells, 1, 1}, {}, settings, 293.15, 0);
        grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
            run.sources.mass[c] = rate / cells;
            run.sources.enthalpy[c] = rate / cells * material::enthalpy(293.15, 0);
        });
        for (int step = 0; step < 2000; ++step) run.step(1e-3);
        auto const pressure = [&](int i) { return run.at(run.state.pressure, i, 0, 0); };
        auto const speed = [&](int i) { return rate * (i + 0.5) / cells / (density * side * side); };
        int const to = 3 * cells / 4;
        double const exact = density * (speed(to) * speed(to) - speed(0) * speed(0));
        double const off = std::abs((pressure(0) - pressure(to)) / exact - 1);
        if (coarser > 0)
            verify::between(
                "E06", fmt::format("mass that enters along a channel: order from {} to {} cells", cells / 2, cells),
                1.8, 2.2, std::log2(coarser / off));
        if (cells == 80) {
            verify::below("E06", "mass that enters along a channel: fall of the pressure, share off", 0.02, off);
            verify::relative("E06", "mass that enters along a channel: speed at three quarters, m/s", 7.5,
                             run.at(run.state.velocity[0], 60, 0, 0), 1e-6);
        }
        coarser = off;
    }
}
}
