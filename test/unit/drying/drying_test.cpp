// Deposits dry at the law's rate, nothing of them is lost on the way into the layer, and the event says how it went.
#include "bed.hpp"

#include "granum/base/random.hpp"
#include "granum/drying/impact.hpp"
#include "granum/law/heat/ranz_marshall.hpp"
#include "granum/law/wetting/footprint.hpp"
#include "granum/material/moist_air.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace
{
using namespace granum;
using namespace granum::drying;
using math::zero_celsius;
using test::Bed;

//! physics.md 5.2: a droplet of 40 um of 30 % suspension of 1100 kg/m3 on a granule of 0.6 mm at the wet bulb of air of
//! 60 degC and 12 g/kg, contact angle 40 degrees, all of the water evaporating at water activity 1.
struct Stated
{
    static constexpr double angle = 40 * math::pi / 180;
    double volume = math::pi / 6 * std::pow(40e-6, 3);
    double water = 0.7 * 1100 * volume, solute = 0.3 * 1100 * volume;
    double base = law::wetting::cap_base_radius(40e-6, angle);
    //! So that the volumes of water and solids add up to the droplet's.
    double solids_density = solute / (volume - water / material::water_density);

    Bed bed(law::deposit::Any combine, double sherwood) const
    {
        Bed out(1);
        out.settings.combine = combine;
        out.settings.liquid = {.density = 1100, .solids_density = solids_density, .feed_moisture = 7.0 / 3};
        out.settings.end_moisture = 0;
        out.sherwood[0] = sherwood;
        out.wet(0, 1, water, solute, base);
        return out;
    }

    //! s to dry where the rate follows the angle as `of_angle` says (1 at the stated angle) and took `time` without:
    //! the contact line is pinned, so the cap flattens. Midpoint rule over the water.
    template <class Shape>
    double pinned(double time, Shape&& of_angle) const
    {
        double sum = 0;
        int const parts = 2000;
        for (int n = 0; n < parts; ++n) {
            double const left = (n + 0.5) / parts;
            double const v = left * water / material::water_density + solute / solids_density;
            // Angle of a cap of volume v: bisection in pi a^3 / 6 t (3 + t^2), t = tan(angle / 2).
            double low = 0, high = 1;
            for (int i = 0; i < 60; ++i) {
                double const t = 0.5 * (low + high);
                (math::pi * base * base * base / 6 * t * (3 + t * t) < v ? low : high) = t;
            }
            sum += time / parts / of_angle(2 * std::atan(low));
        }
        return sum;
    }
};

TEST(Drying, through_the_boundary_layer_begins_at_the_independent_rate_and_slows_as_the_cap_flattens)
{
    Stated const stated;
    for (auto const& [sherwood, time] : {std::pair{4.154, 1.815}, {5.731, 1.316}, {7.277, 1.036}}) {
        auto bed = stated.bed(law::deposit::BoundaryLayer{}, sherwood);
        bed.advance(1e-5);
        EXPECT_NEAR(bed.evaporated[0] / 1e-5, stated.water / time, 1e-3 * stated.water / time);
        while (bed.events.empty() && bed.now < 5) bed.advance(1e-3);
        double const expected =
            stated.pinned(time, [&](double angle) { return (1 + std::cos(Stated::angle)) / (1 + std::cos(angle)); });
        ASSERT_EQ(bed.events.size(), 1u);
        EXPECT_GT(expected, time);
        EXPECT_NEAR(bed.events[0].drying_time, expected, 2e-3 * expected);
    }
}

TEST(Drying, of_an_isolated_cap_begins_at_the_independent_rate_and_slows_as_the_cap_flattens)
{
    Stated const stated;
    auto bed = stated.bed(law::deposit::Cap{}, 5.731);
    bed.advance(1e-6);
    EXPECT_NEAR(bed.evaporated[0] / 1e-6, stated.water / 0.381, 2e-3 * stated.water / 0.381);
    while (bed.events.empty() && bed.now < 5) bed.advance(2e-4);
    auto const shape = [](double angle) { return 0.27 * angle * angle + 1.30; };
    double const expected = stated.pinned(0.381, [&](double angle) { return shape(angle) / shape(Stated::angle); });
    ASSERT_EQ(bed.events.size(), 1u);
    EXPECT_NEAR(bed.events[0].drying_time, expected, 3e-3 * expected);
}

TEST(Drying, slows_below_the_critical_moisture_along_an_exponential)
{
    // On a base so wide that the deposit is flat, the rate R0 is constant: X0/2 after (X0/2) m_s / R0, then
    // X = X_cr exp(-R0 t / (m_s X_cr)); physics.md 5.2.
    Bed bed(1);
    bed.settings.combine = law::deposit::BoundaryLayer{};
    bed.settings.liquid = {.density = 1100, .feed_moisture = 2};
    bed.settings.stages = law::deposit::FallingRate{.critical = 1};
    double const solute = 1e-12;
    bed.wet(0, 1, 2 * solute, solute, 1e-4);
    auto const moisture = [&] { return bed.granules.water[0] / solute; };
    double const dt = 1e-5;
    bed.advance(dt);
    double const rate = bed.evaporated[0] / dt, half = solute / rate;
    while (moisture() > 1) bed.advance(dt);
    EXPECT_NEAR(bed.now, half, 2 * dt);
    for (double const later : {0.5, 1.0, 2.0}) {
        while (bed.now < half + later * half) bed.advance(dt);
        EXPECT_NEAR(moisture(), std::exp(-later), 2e-3 * std::exp(-later));
    }
    while (bed.events.empty()) bed.advance(dt);
    EXPECT_NEAR(bed.events[0].drying_time, half * (1 + std::log(1 / 0.02)), 2e-3 * bed.events[0].drying_time);
}

TEST(Drying, of_a_granule_that_is_covered_is_that_of_one_film)
{
    // Two deposits of different width that together cover 0.95 of the granule, of pure suspension: what leaves is what
    // leaves a granule that is wet all over, and each gives by its area.
    Bed bed(1);
    bed.settings.combine = law::deposit::Cap{};
    bed.settings.liquid = {.density = 1100, .feed_moisture = 2};
    double const d = 0.6e-3, narrow = 1e-5, wide = 3e-5, solute = 1e-12;
    double const number = 0.95 * d * d / (narrow * narrow + wide * wide);
    bed.wet(0, number, 2 * solute, solute, narrow);
    bed.wet(0, number, 18 * solute, 9 * solute, wide);
    double const dt = 1e-6;
    bed.advance(dt);
    // Flux of the boundary layer at Sh 5.731 without slowing: 3.760 g/m2/s (physics.md 5.2, 1.5 m/s).
    EXPECT_NEAR(bed.evaporated[0] / dt, 3.760e-3 * math::pi * d * d, 2e-3 * 3.760e-3 * math::pi * d * d);
    auto const& open = bed.deposits.on(0);
    double const from_narrow = number * 2 * solute - open[0].water, from_wide = number * 18 * solute - open[1].water;
    EXPECT_NEAR(from_wide / from_narrow, 9, 1e-6);
    // Covered a little less they dry as isolated caps, several times as fast.
    bed.settings.film_coverage = 0.99;
    bed.advance(dt);
    EXPECT_GT(bed.evaporated[0] / dt, 3 * 3.760e-3 * math::pi * d * d);
}

TEST(Drying, by_reaction_engineering_ends_in_equilibrium_with_the_gas)
{
    Bed bed(1);
    bed.settings.combine = law::deposit::BoundaryLayer{};
    bed.settings.liquid = {.density = 1100, .feed_moisture = 2};
    bed.settings.liquid.solubility = 0.63;  // of a solution the law is the same
    bed.settings.stages = law::deposit::ReactionEngineering{.a = 1, .b = 2, .c = 1};
    bed.settings.end_moisture = 0;
    double const solute = 1e-12, celsius = 60;
    bed.granules.temperature[0] = celsius + zero_celsius;  // as warm as the gas: only its humidity keeps water
    bed.wet(0, 1, 2 * solute, solute, 1e-4);
    double const humidity = material::relative_humidity(celsius + zero_celsius, 0.012, 101325);
    // Rates from the activity rh^f, f = exp(-2 X), all through the same film.
    auto const moisture = [&] { return bed.granules.water[0] / solute; };
    auto const drive = [&](double x) {
        auto film =
            law::deposit::film(celsius + zero_celsius, 1.0, celsius + zero_celsius, material::fraction(0.012), 101325);
        double const activity = std::pow(humidity, std::exp(-2 * x));
        film.surface_fraction =
            law::vapour::mass_fraction(activity * material::saturation_pressure(celsius + zero_celsius) / 101325);
        return film.driving();
    };
    bed.advance(1e-6);
    double const first = bed.evaporated[0], at_first = drive(2);
    while (moisture() > 0.5) bed.advance(1e-4);
    double const x = moisture();
    bed.advance(1e-6);
    EXPECT_NEAR(bed.evaporated[0] / first, drive(x) / at_first, 2e-3);
    bed.settings.equilibrium_moisture = 0.3;
    while (bed.events.empty() && bed.now < 100) bed.advance(1e-3);
    EXPECT_TRUE(bed.events.empty());  // there is no end: the rate falls with what is left above equilibrium
    EXPECT_GT(moisture(), 0.3);
    EXPECT_LT(moisture(), 0.31);
}

TEST(Drying, leaves_the_moisture_of_equilibrium_in_the_layer)
{
    Bed bed(1);
    bed.settings.liquid = {.density = 1100, .feed_moisture = 2};
    bed.settings.equilibrium_moisture = 0.05;
    double const solute = 1e-12;
    bed.wet(0, 3, 2 * solute, solute, 4e-5);
    while (bed.events.empty()) bed.advance(1e-3);
    EXPECT_NEAR(bed.granules.water[0], 3 * 0.05 * solute, 1e-9 * solute);
    EXPECT_EQ(bed.granules.solute[0], 0);
    EXPECT_NEAR(bed.granules.layer_mass[0], 3 * solute, 1e-12 * solute);
}

TEST(Impact, on_a_wet_deposit_joins_it)
{
    // 100 caps; 60 droplets fall on them: 40 stay as they were, 60 hold both, and nothing is lost.
    Bed bed(1);
    double const solute = 1e-12, base = 4e-5;
    bed.wet(0, 100, solute, solute, base);
    double const mass = bed.granules.water[0] + bed.granules.solute[0];
    Arrival arrival{.weight = 60,
                    .water = 2 * solute,
                    .solute = solute,
                    .diameter = 20e-6,
                    .temperature = 300,
                    .density = 1100,
                    .viscosity = 2e-3,
                    .surface_tension = 0.06,
                    .contact_angle = 0.7};
    arrival.velocity = bed.granules.velocity[0];
    double const coverage = Drying::coverage(bed.deposits.on(0), 1, bed.granules.diameter[0]);
    arrival.draw = 0.999 * coverage;
    deposit(bed.granules, 0, bed.deposits, arrival, {}, 1.0);
    auto const& open = bed.deposits.on(0);
    ASSERT_EQ(open.size(), 2u);
    EXPECT_NEAR(open[0].weight, 40, 1e-12);
    EXPECT_NEAR(open[0].water, 40 * solute, 1e-24);
    EXPECT_EQ(open[0].record.merged, 0);
    EXPECT_NEAR(open[1].weight, 60, 1e-12);
    EXPECT_NEAR(open[1].water, 60 * 3 * solute, 1e-24);
    EXPECT_NEAR(open[1].solute, 60 * 2 * solute, 1e-24);
    EXPECT_EQ(open[1].record.merged, 1);
    EXPECT_EQ(open[1].record.t_deposit, 1.0);
    EXPECT_GE(open[1].base_radius, base);
    EXPECT_NEAR(bed.granules.water[0] + bed.granules.solute[0], mass + 60 * 3 * solute, 1e-20);
    // 150 more on the 60, under which half of the wet area is: two and a half on each.
    arrival.weight = 150;
    arrival.draw = 0.9 * Drying::coverage(bed.deposits.on(0), 1, bed.granules.diameter[0]);
    deposit(bed.granules, 0, bed.deposits, arrival, {}, 2.0);
    ASSERT_EQ(open.size(), 2u);
    EXPECT_NEAR(open[1].weight, 60, 1e-12);
    EXPECT_NEAR(open[1].water, (60 * 3 + 150 * 2) * solute, 1e-22);
    EXPECT_NEAR(open[1].record.merged, 1 + 2.5, 1e-12);
    // Beyond the coverage they fall on dry ground.
    arrival.draw = 0.999;
    deposit(bed.granules, 0, bed.deposits, arrival, {}, 3.0);
    ASSERT_EQ(open.size(), 3u);
    EXPECT_EQ(open.back().record.merged, 0);
    EXPECT_NEAR(open.back().weight, 150, 1e-12);
}

TEST(Drying, ends_within_a_step_when_the_water_is_gone_whatever_the_step)
{
    std::vector<double> times;
    for (double const dt : {1e-4, 7e-4, 1e-2, 10.0}) {
        Bed bed(1);
        bed.settings.combine = law::deposit::BoundaryLayer{};
        bed.settings.liquid = {.feed_moisture = 2};
        bed.wet(0, 3, 2e-12, 1e-12, 1e-4);
        while (bed.events.empty()) bed.advance(dt);
        times.push_back(bed.events[0].drying_time);
        EXPECT_NEAR(bed.events[0].t_dry_end, times.back(), 1e-12);
        EXPECT_LE(times.back(), bed.now + 1e-15);
        EXPECT_NEAR(times.back(), times.front(), 1e-4 * times.front());
        EXPECT_LE(bed.events[0].mean_flux, bed.events[0].max_flux * (1 + 1e-12));
        EXPECT_EQ(bed.granules.water[0], 0);
    }
}

//! Droplets on granules as they come, for a second, with gas that changes all the time.
struct Rain
{
    Bed bed{5, 27};
    double water = 0, solute = 0, enthalpy = 0, evaporated = 0;
    std::vector<double> heat_left = std::vector<double>(5, 0.0);
    Vec3 momentum;
    long droplets = 0;

    explicit Rain(double solubility = 0)
    {
        bed.settings.liquid = {.density = 1130,
                               .solids_density = 1440,
                               .solubility = solubility,
                               .molar_mass = 0.1441,
                               .dissociation = 2,
                               .feed_moisture = 7.0 / 3};
        bed.settings.porosity = [](double potential, double, double) { return 0.7 - 0.5 * potential; };
        for (std::size_t row = 0; row < 5; ++row) bed.granules.temperature[row] = 310 + 8.0 * static_cast<double>(row);
    }

    void arrive(std::size_t row, base::Random& random)
    {
        double const d = (20 + 40 * random.uniform()) * 1e-6, mass = 1130 * math::pi / 6 * d * d * d;
        Arrival droplet{.weight = 20 * random.uniform(),
                        .water = 0.6 * mass,
                        .solute = 0.3 * mass,
                        .diameter = d,
                        .temperature = 303,
                        .position = {0.1, 0.2, 0.3},
                        .velocity = {1, 2, -12},
                        .density = 1130,
                        .viscosity = 3e-3,
                        .surface_tension = 0.063,
                        .contact_angle = 0.7,
                        .sine = std::sqrt(random.uniform())};
        droplet.enthalpy =
            droplet.weight * (droplet.water * material::heat_capacity_water + droplet.solute * 1400) * 29.85;
        momentum += droplet.weight * (droplet.water + droplet.solute) * droplet.velocity;
        drying::deposit(bed.granules, row, bed.deposits, droplet,
                        {.gas_temperature = bed.temperature[row],
                         .gas_humidity = material::loading(bed.vapour[row]),
                         .drying_potential = bed.potential[row],
                         .solids_fraction = 0.4,
                         .slip = bed.slip[row]},
                        bed.now);
        water += droplet.weight * droplet.water, solute += droplet.weight * droplet.solute;
        enthalpy += droplet.enthalpy;
        ++droplets;
    }

    void step(int number, double dt, bool raining)
    {
        base::Random random(5, base::Purpose::test, static_cast<std::uint64_t>(number), 0);
        for (std::size_t row = 0; row < 5; ++row) {
            bed.temperature[row] = 320 + 30 * random.uniform();
            bed.vapour[row] = 0.008 + 0.01 * random.uniform();
            bed.potential[row] = 0.4 + 0.3 * random.uniform();
            bed.slip[row] = 1 + random.uniform();
            bed.granules.velocity[row] = {};
            if (raining && random.uniform() < 0.5) arrive(row, random);
        }
        bed.advance(dt);
        for (std::size_t row = 0; row < 5; ++row) {
            evaporated += bed.evaporated[row];
            heat_left[row] += bed.evaporated[row] * material::vapour_enthalpy(bed.granules.temperature[row]);
        }
    }
};

double sum(std::vector<double> const& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Drying, keeps_every_gram_of_water_and_solids_and_every_joule)
{
    for (double const solubility : {0.0, 0.63}) {
        Rain rain(solubility);
        auto& granules = rain.bed.granules;
        double largest = 0;
        for (int n = 0; n < 4000; ++n) {
            rain.step(n, 1e-3, n < 1000);
            double water = 0, solute = 0;
            for (std::size_t id = 0; id < 5; ++id)
                for (auto const& deposit : rain.bed.deposits.on(id)) water += deposit.water, solute += deposit.solute;
            largest = std::max(largest, water / rain.water);
            ASSERT_NEAR(sum(granules.water.values), water, 1e-14 * rain.water);
            ASSERT_NEAR(sum(granules.solute.values), solute, 1e-14 * rain.solute);
            ASSERT_NEAR(sum(granules.water.values) + rain.evaporated, rain.water, 1e-13 * rain.water);
            ASSERT_NEAR(sum(granules.solute.values) + sum(granules.layer_mass.values), rain.solute,
                        1e-13 * rain.solute);
            ASSERT_NEAR(sum(granules.enthalpy.values) + sum(rain.heat_left), rain.enthalpy, 1e-12 * rain.enthalpy);
        }
        EXPECT_GT(largest, 0.05);  // some were wet meanwhile
        EXPECT_EQ(static_cast<long>(rain.bed.events.size()), rain.droplets);
        double layer = 0, volume = 0;
        for (auto const& event : rain.bed.events) {
            layer += event.solids;
            volume += event.solids / (1440 * (1 - event.porosity));
        }
        EXPECT_NEAR(layer / rain.solute, 1, 1e-12);
        EXPECT_NEAR(sum(granules.layer_volume.values) / volume, 1, 1e-12);
        EXPECT_EQ(sum(granules.water.values), 0);
        for (std::size_t row = 0; row < 5; ++row) {
            double const d = granules.diameter[row];
            EXPECT_NEAR(27 * math::pi / 6 * (d * d * d - std::pow(0.6e-3, 3)), granules.layer_volume[row],
                        1e-10 * granules.layer_volume[row]);
            EXPECT_NEAR(granules.radius[row], 1.5 * d, 1e-15);
            EXPECT_NEAR(granules.mass[row], granules.core_mass[row] + granules.layer_mass[row],
                        1e-15 * granules.mass[row]);
        }
    }
}

TEST(Event, tells_of_each_deposit_what_it_really_met)
{
    Rain rain(0.63);
    for (int n = 0; n < 4000; ++n) rain.step(n, 1e-3, n < 1000);
    ASSERT_GT(rain.bed.events.size(), 1000u);
    for (auto const& e : rain.bed.events) {
        EXPECT_NEAR(e.t_dry_end - e.t_deposit, e.drying_time, 1e-9);
        EXPECT_GT(e.drying_time, 0);
        EXPECT_TRUE(e.mean_gas_temperature >= 320 && e.mean_gas_temperature <= 350) << e.mean_gas_temperature;
        EXPECT_TRUE(e.mean_gas_humidity >= material::loading(0.008) && e.mean_gas_humidity <= material::loading(0.018));
        EXPECT_TRUE(e.mean_drying_potential >= 0.4 && e.mean_drying_potential <= 0.7);
        EXPECT_TRUE(e.mean_slip >= 1 && e.mean_slip <= 2);
        EXPECT_NEAR(e.mean_granule_temperature, e.granule_temperature, 1e-9);
        EXPECT_NEAR(e.porosity, 0.7 - 0.5 * e.mean_drying_potential, 1e-12);
        EXPECT_GT(e.mean_flux, 0);
        EXPECT_LE(e.mean_flux, e.max_flux * (1 + 1e-12));
        EXPECT_TRUE(e.constant_rate_time > 0 && e.constant_rate_time < e.drying_time);
        EXPECT_NEAR(e.moisture_at_impact, 2, 1e-12);
        EXPECT_NEAR(std::hypot(e.normal_speed, e.tangential_speed), std::sqrt(1 + 4 + 144.0), 1e-3);
        EXPECT_NEAR(e.mundo, std::sqrt(e.weber) * std::pow(e.reynolds, 0.25), 1e-9 * e.mundo);
        EXPECT_NEAR(e.ohnesorge, std::sqrt(e.weber) / e.reynolds, 1e-9 * e.ohnesorge);
        EXPECT_TRUE(e.coverage >= 0 && e.coverage <= 1);
        EXPECT_EQ(e.initial, 0);
    }
}

// Water of 40 um on pores of 1 um that are a fifth of the core: by hand, V^(2/3) = 1.039e-9 m2, 1.35 V^(2/3) 3e-3 /
// (0.04 1e-6 0.063 cos 40) = 2.180e-3 s.
TEST(Imbibition, takes_the_time_and_the_share_of_solids_that_it_should)
{
    law::wetting::Pores const pores{.share = 0.2,
                                    .radius = 1e-6,
                                    .viscosity = 3e-3,
                                    .surface_tension = 0.063,
                                    .contact_angle = 40 * math::pi / 180};
    double const volume = math::pi / 6 * std::pow(40e-6, 3);
    EXPECT_NEAR(law::wetting::penetration_time(volume, pores), 2.180e-3, 1e-6);
    EXPECT_EQ(law::wetting::entered(0.25, 1), 0.5);
    EXPECT_EQ(law::wetting::entered(2, 1), 1);
    auto repelled = pores;
    repelled.contact_angle = 2;
    EXPECT_EQ(law::wetting::entered(1, law::wetting::penetration_time(volume, repelled)), 0);

    // Pores so narrow that half of each deposit enters; none has a layer when the first dries.
    Stated const stated;
    auto bed = stated.bed(law::deposit::Cap{}, 5.731);
    bed.settings.pores = pores;
    auto const dry = [&] {
        auto const before = bed.events.size();
        while (bed.events.size() == before) bed.advance(1e-3);
        return bed.events.back();
    };
    auto const first = dry();
    EXPECT_EQ(first.imbibed, 1);
    EXPECT_EQ(bed.granules.layer_volume[0], 0);
    EXPECT_NEAR(bed.granules.layer_mass[0], stated.solute, 1e-12 * stated.solute);
    bed.settings.pores.radius = 1e-6 * 2.180e-3 / (4 * first.drying_time);
    bed.wet(0, 1, stated.water, stated.solute, stated.base);
    EXPECT_NEAR(dry().imbibed, 0.5, 2e-3);
    // A layer as thick as one deposit's leaves exp(-1) of the core bare.
    bed.granules.layer_volume[0] = stated.solute / (stated.solids_density * 0.6) /
                                   (math::pi * stated.base * stated.base) * math::pi *
                                   std::pow(bed.granules.diameter[0], 2);
    bed.wet(0, 1, stated.water, stated.solute, stated.base);
    EXPECT_NEAR(dry().imbibed, 0.5 * std::exp(-1), 5e-3);  // the granule has grown
}

// By hand: K a = 0.4, 0.04 * 10 * 0.4 / (0.6 * 4.6) = 0.05797.
TEST(Sorption, comes_to_the_isotherm_exponentially_and_keeps_water_and_heat)
{
    EXPECT_NEAR(law::vapour::Gab{}(0.5), 0.4 * 0.4 / (0.6 * 4.6), 1e-12);
    Bed bed(1);
    bed.settings.sorption = law::vapour::Gab{};
    bed.settings.sorption_time = 2;
    double const held =
        Drying(bed.settings).equilibrium(bed.granules.temperature[0], bed.temperature[0], bed.vapour[0]);
    EXPECT_GT(held, 0.03);
    double const core = bed.granules.core_mass[0], before = bed.granules.enthalpy[0];
    double taken = 0;
    for (int n = 0; n < 200; ++n) bed.advance(0.01), taken -= bed.evaporated[0];
    EXPECT_NEAR(bed.granules.absorbed[0], held * core * (1 - std::exp(-1)), 1e-9 * core);
    EXPECT_NEAR(bed.granules.water[0], taken, 1e-12 * core);
    EXPECT_NEAR(bed.granules.enthalpy[0] - before, taken * material::vapour_enthalpy(bed.granules.temperature[0]),
                1e-9 * taken * 2.5e6);
    EXPECT_NEAR(bed.granules.mass[0], core + taken, 1e-12 * core);
}

TEST(Event, tells_the_crystals_of_its_deposit)
{
    Rain rain(0.63);
    rain.bed.settings.crystallisation = law::deposit::NucleationGrowth{};
    for (int n = 0; n < 4000; ++n) rain.step(n, 1e-3, n < 1000);
    ASSERT_GT(rain.bed.events.size(), 1000u);
    for (auto const& e : rain.bed.events) {
        EXPECT_GT(e.supersaturation, 1.05);
        EXPECT_GT(e.crystals, 1);
        double const solids = e.solids / e.weight;
        EXPECT_NEAR(e.crystals * 0.5 * rain.bed.settings.liquid.solids_density * std::pow(e.crystal_size, 3), solids,
                    1e-9 * solids);
    }
}

TEST(Event, of_a_droplet_that_arrives_dry_tells_the_gas_it_arrived_in)
{
    Bed bed(1);
    bed.settings.liquid = {.feed_moisture = 2};
    bed.wet(0, 1, 0.02e-12, 1e-12, 30e-6);  // just at the end moisture of 1 %
    bed.wet(0, 1, 0.019e-12, 1e-12, 30e-6);
    bed.advance(1e-3);
    ASSERT_EQ(bed.events.size(), 2u);
    for (auto const& event : bed.events) {
        EXPECT_NEAR(event.mean_gas_temperature, 60 + zero_celsius, 1e-6);
        EXPECT_NEAR(event.mean_drying_potential, 0.6, 1e-9);
        EXPECT_NEAR(event.mean_slip, 1.5, 1e-9);
        EXPECT_GE(event.mean_flux, 0);
        EXPECT_LE(event.mean_flux, event.max_flux);
        EXPECT_LT(event.drying_time, 1e-6);
    }
}

TEST(Impact, gives_the_granule_the_droplet_s_momentum)
{
    Rain rain;
    rain.bed.granules.velocity[2] = {0.5, -1, 0.2};
    Vec3 const before = rain.bed.granules.mass[2] * rain.bed.granules.velocity[2];
    base::Random random(5, base::Purpose::test, 1, 0);
    for (int n = 0; n < 10; ++n) rain.arrive(2, random);
    Vec3 const after = rain.bed.granules.mass[2] * rain.bed.granules.velocity[2];
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(after[d] - before[d], rain.momentum[d], 1e-12 * math::norm(before));
}

TEST(Layer, of_a_batch_grows_as_the_independent_numbers_say)
{
    // 1 kg of cores of 0.6 mm and 1445 kg/m3, 1.2 kg/h of 30 % solution, layer of 1440 * 0.6 kg/m3: physics.md 5.3.
    double const count = 1 / (1445 * math::pi / 6 * std::pow(0.6e-3, 3));
    Bed bed(1, count);
    bed.settings.liquid = {.solids_density = 1440, .feed_moisture = 7.0 / 3};
    double const each = 1.2 / 3600 * 0.3 * 10;  // kg of solids in 10 s
    auto spray_until = [&, sprayed = 0.0](double end) mutable {
        for (; sprayed < end - 5; sprayed += 10) {
            bed.wet(0, 1e8, each * 0.1e-8, each * 1e-8, 30e-6);
            while (!bed.deposits.on(0).empty()) bed.advance(10);
        }
        return 1e6 * bed.granules.diameter[0];
    };
    EXPECT_NEAR(count, 6118991, 1);
    EXPECT_NEAR(spray_until(600), 619.433, 1e-3);
    EXPECT_NEAR(spray_until(1800), 655.011, 1e-3);
    EXPECT_NEAR(spray_until(3600), 702.069, 1e-3);
    EXPECT_NEAR(bed.granules.layer_mass[0], 0.36, 1e-12);
}

TEST(Deposits, travel_with_their_granule)
{
    Rain rain(0.63);
    for (int n = 0; n < 30; ++n) rain.step(n, 1e-3, true);
    Deposits there(5);
    long moved = 0;
    for (particle::Id id : {0u, 3u}) {
        auto const before = rain.bed.deposits.on(id);
        ASSERT_FALSE(before.empty());
        std::vector<std::byte> bytes(5);  // others have written before
        rain.bed.deposits.take(id, bytes);
        EXPECT_TRUE(rain.bed.deposits.on(id).empty());
        there.give(id, std::span(bytes).subspan(5));
        ASSERT_EQ(there.on(id).size(), before.size());
        for (std::size_t k = 0; k < before.size(); ++k, ++moved) {
            EXPECT_EQ(there.on(id)[k].water, before[k].water);
            EXPECT_EQ(there.on(id)[k].solute, before[k].solute);
            EXPECT_EQ(there.on(id)[k].time, before[k].time);
            EXPECT_EQ(there.on(id)[k].record.weber, before[k].record.weber);
        }
    }
    EXPECT_GT(moved, 10);
    std::vector<std::byte> none;
    rain.bed.deposits.take(0, none);
    EXPECT_TRUE(none.empty());
    there.give(0, none);
    EXPECT_TRUE(there.on(0).empty());
}

TEST(Coverage, is_the_share_of_the_surface_under_the_deposits_and_at_most_all)
{
    Bed bed(1, 10);
    bed.wet(0, 40, 1e-12, 1e-12, 30e-6);
    EXPECT_NEAR(Drying::coverage(bed.deposits.on(0), 10, 0.6e-3), 4 * std::pow(30.0 / 600, 2), 1e-12);
    bed.wet(0, 1e6, 1e-12, 1e-12, 30e-6);
    EXPECT_EQ(Drying::coverage(bed.deposits.on(0), 10, 0.6e-3), 1);
}
}
