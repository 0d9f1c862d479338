// Rows P25 and P26 and the reference cases g-01, g-03, g-05 and g-06: layers, how evenly they come, what is sprayed,
// and what must leave with the air.
#include "verify/table.hpp"

#include "granum/law/droplet/size.hpp"
#include "granum/law/layer/growth.hpp"
#include "granum/law/layer/renewal.hpp"
#include "granum/law/wetting/coalescence.hpp"
#include "granum/population/balance.hpp"
#include "granum/product/surface.hpp"
#include "granum/sim/balance.hpp"
#include "scene/reference.hpp"

#include <algorithm>
#include <cmath>

namespace
{
using namespace granum;
using math::pi;

//! Of a sample of granules, each with as many deposits as chance has it.
product::SurfaceStatistics deposited(std::size_t granules, std::size_t panels, double deposits, double radius,
                                     double base, std::uint32_t stream)
{
    std::vector<product::Surface> sample(granules, product::Surface(panels));
    for (std::size_t n = 0; n < granules; ++n) {
        base::Random random(5, base::Purpose::test, n, stream);
        product::fall(sample[n], {deposits, radius, base, 1e-16}, random);
    }
    return product::statistics(sample);
}

TEST(Coverage, is_that_of_deposits_that_fall_at_random)
{
    double const radius = 3e-4, base = 3e-5, share = 0.5 * (1 - std::cos(base / radius));
    std::uint32_t stream = 0;
    for (double const hits : {0.1, 1.0, 2.0, 3.0, 5.0}) {
        double const deposits = hits / share;
        auto const granules = static_cast<std::size_t>(std::ceil(1.5e5 / deposits));
        verify::relative("P25", fmt::format("coverage after {} deposits over each place, {} granules", hits, granules),
                         1 - std::exp(-hits), deposited(granules, 1000, deposits, radius, base, ++stream).coverage,
                         0.01);
    }
}

TEST(Spread, of_the_layers_mass_falls_with_the_root_of_passes)
{
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    constexpr std::array passes{30.0, 100.0, 300.0, 1000.0};
    std::uint32_t stream = 100;
    for (double const n : passes) {
        double const x = std::log(n), y = std::log(deposited(4000, 64, n, 3e-4, 2e-4, ++stream).variation_between);
        sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
    }
    double const count = passes.size();
    verify::absolute("P26", "slope of log variation between granules against log of passes", -0.5,
                     (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x), 0.02);
}

//! Passes of one granule through the spray, by their own random times and masses, until `end`.
double coated(double cycle, double of_cycle, double of_mass, double end, base::Random& random)
{
    // Gamma distributions; of variation 0.3, 0.5 or 1: of shape 11.1, 4 or 1. Sums of exponentials where the shape is
    // whole, else log-normal: the long-time variation asks for mean and variance alone.
    auto const draw = [&](double variation) {
        if (variation == 0) return 1.0;
        if (variation == 1) return -std::log(random.uniform());
        double const s2 = std::log1p(variation * variation);
        return std::exp(std::sqrt(s2) * random.normal() - 0.5 * s2);
    };
    double mass = 0;
    for (double time = random.uniform() * cycle * draw(of_cycle); time < end; time += cycle * draw(of_cycle))
        mass += draw(of_mass);
    return mass;
}

TEST(Renewal, has_the_spread_of_cycles_and_passes)
{
    scene::Table const table("g-03.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const cycle = table.number(row, "mean_cycle_time_s"), of_cycle = table.number(row, "cv_cycle");
        double const of_mass = table.number(row, "cv_mass_per_pass"), end = table.number(row, "process_time_s");
        auto const words = fmt::format("variation of the layer's mass, cycles {} s +- {}, passes +- {}, {} s", cycle,
                                       of_cycle, of_mass, end);
        verify::relative("G03", words, table.number(row, "CV_theory"),
                         law::layer::renewal_variation(end, cycle, of_mass, of_cycle), 1e-5);
        double sum = 0, squares = 0;
        constexpr int granules = 8000;
        for (int n = 0; n < granules; ++n) {
            base::Random random(6, base::Purpose::test, static_cast<std::uint64_t>(n), static_cast<std::uint32_t>(row));
            double const mass = coated(cycle, of_cycle, of_mass, end, random);
            sum += mass, squares += mass * mass;
        }
        double const mean = sum / granules;
        verify::relative("G03", "the same of 8000 granules, each with its own passes", table.number(row, "CV_theory"),
                         std::sqrt(squares / granules - mean * mean) / mean, 0.1);
    }
}

TEST(Growth, of_a_batch_has_the_thickness_of_its_layer)
{
    scene::Table const table("g-01.csv");
    double const solids = 1400, rate = 1e-4;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const time = table.number(row, "t_s"), thickness = table.number(row, "layer_thickness_m");
        std::string const name = table.text(row, "case");
        if (thickness == 0) continue;
        if (name.starts_with("mono")) {
            double const porosity = name == "mono_eps0" ? 0 : 0.4, cores = 1 / 1500.0 / (pi / 6 * 1e-9);
            double const grown =
                law::layer::grown_diameter(1e-3, law::layer::layer_volume(rate * time / cores, solids, porosity));
            verify::relative("G01", fmt::format("layer on equal cores after {:.0f} s, porosity {}, m", time, porosity),
                             thickness, 0.5 * (grown - 1e-3), 1e-3);
        } else if (name == "poly_0.0006") {
            auto classes = population::Classes::even(0.58e-3, 1.6e-3, 2000);
            for (auto const& [diameter, number] :
                 {std::pair{0.6e-3, 4e5}, std::pair{0.8e-3, 3e5}, std::pair{1.0e-3, 2e5}, std::pair{1.2e-3, 1e5}})
                classes.add(diameter, number);
            double const before = classes.mean_diameter();
            population::Rates const rates{.layer = rate / (solids * (1 - 0.2))};
            population::advance(classes, rates, time);
            verify::relative("G01", fmt::format("layer on four sizes of cores after {:.0f} s, m", time), thickness,
                             0.5 * (classes.mean_diameter() - before), 2e-3);
        }
    }
}

TEST(Agglomeration, of_equal_chances_follows_smoluchowski)
{
    scene::Table const table("g-02.csv");
    // Volumes in units of v0; a pair joins at the rate 2, of one granule in all at the start: T = t.
    population::Rates rates;
    rates.agglomeration = [](double, double) { return 2.0; };
    double const v0 = pi / 6;
    auto equal = population::Classes::even(0.9, 7.5, 1320);
    equal.add(1.0, 1);
    auto spread = population::Classes::even(0.02, 8.5, 1300);
    for (std::size_t k = 0; k < spread.size(); ++k) {
        auto const above = [&](double edge) { return std::exp(-edge * edge * edge); };
        spread.number[k] = above(spread.edges[k]) - above(spread.edges[k + 1]);
    }
    auto const of_size = [&](double volume) {
        double sum = 0;
        for (std::size_t k = 0; k < equal.size(); ++k)
            if (std::abs(equal.volume(k) / v0 - volume) < 0.5) sum += equal.number[k];
        return sum;
    };
    auto const second = [&](population::Classes const& classes) {
        double sum = 0;
        for (std::size_t k = 0; k < classes.size(); ++k) sum += classes.number[k] * std::pow(classes.volume(k) / v0, 2);
        return sum;
    };
    // Between the two classes around it, in logarithms.
    auto const density = [&](double volume) {
        auto const at = [&](std::size_t k) {
            double const width = std::pow(spread.edges[k + 1], 3) - std::pow(spread.edges[k], 3);
            return std::pair{spread.volume(k) / v0, std::log(spread.number[k] / width)};
        };
        std::size_t k = 0;
        while (spread.volume(k + 1) / v0 < volume) ++k;
        auto const [below, low] = at(k);
        auto const [above, high] = at(k + 1);
        return std::exp(low + (high - low) * (volume - below) / (above - below));
    };
    double const square = second(equal), volume = equal.total_volume();
    double now = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const until = table.number(row, "T");
        population::advance(equal, rates, until - now);
        population::advance(spread, rates, until - now);
        now = until;
        auto const words = fmt::format("constant kernel, T = {}: ", until);
        verify::relative("G02", words + "granules", table.number(row, "N_over_N0"), equal.total(), 1e-2);
        verify::relative("G02", words + "granules, exponential start", table.number(row, "N_over_N0"), spread.total(),
                         1e-2);
        verify::relative("G02", words + "volume", volume, equal.total_volume(), 1e-9);
        for (int k : {1, 2, 3, 5})
            if (double const share = table.number(row, fmt::format("N{}_over_N0", k)); share > 1e-3)
                verify::relative("G02", fmt::format("{}granules of {}", words, k), share, of_size(k), 1e-2);
        verify::relative("G02", words + "second moment of the volume", table.number(row, "M2_over_M2_0"),
                         second(equal) / square, 3e-2);
        verify::relative("G02", words + "density at v0, exponential start",
                         table.number(row, "exp_start_n_at_v0_times_v0_over_N0"), density(1), 1e-2);
        verify::relative("G02", words + "density at 3 v0, exponential start",
                         table.number(row, "exp_start_n_at_3v0_times_v0_over_N0"), density(3), 1e-2);
    }
}

TEST(Coalescence, is_decided_by_the_viscous_stokes_number)
{
    scene::Table const table("g-04.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto const number = [&](char const* name) { return table.number(row, name); };
        double const stokes = law::wetting::viscous_stokes(number("rho_kg_per_m3"), number("r_m"), number("U_m_per_s"),
                                                           number("mu_Pa_s"));
        double const critical = law::wetting::critical_stokes(number("e"), number("h_m"), number("h_a_m"));
        auto const words = fmt::format("granules of {:.0f} um at {} m/s: ", 1e6 * number("r_m"), number("U_m_per_s"));
        verify::relative("G04", words + "viscous Stokes number", number("St_v"), stokes, 1e-6);
        verify::relative("G04", words + "critical number", number("St_crit"), critical, 1e-6);
        verify::absolute("G04", words + "stick", number("coalesces"), stokes < critical, 0);
    }
}

TEST(Droplets, of_rosin_and_rammler_are_drawn_as_the_distribution_has_them)
{
    scene::Table const table("g-05.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        law::droplet::RosinRammler const size{table.number(row, "d_prime_m"), table.number(row, "n")};
        base::Random random(7, base::Purpose::test, row, 0);
        std::vector<double> drawn(100000);
        double inverse = 0;
        for (double& d : drawn) inverse += 1 / (d = size.quantile(random.uniform()));
        std::nth_element(drawn.begin(), drawn.begin() + 50000, drawn.end());
        auto const words = fmt::format("of 1e5 droplets, {:.0f} um, n {}", 1e6 * size.scale, size.exponent);
        verify::relative("G05", "d50 " + words + ", m", table.number(row, "d50_m"), drawn[50000], 0.01);
        verify::relative("G05", "d32 " + words + ", m", table.number(row, "d32_m"), 1e5 / inverse, 0.02);
    }
}

TEST(Outlet, has_the_temperature_of_its_balance)
{
    scene::Table const table("g-06.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        sim::Case data;
        data.gas.present = data.spray.present = true;
        data.gas.inlets.resize(1);
        static_cast<sim::FlowCase&>(data.gas.inlets.front()) = {.dry_mass_flow = table.number(row, "dry_air_kg_per_s"),
                                                                .velocity = -1,
                                                                .temperature = table.number(row, "T_in_C") + 273.15,
                                                                .humidity = table.number(row, "Y_in")};
        data.spray.rate = table.number(row, "water_kg_per_s");
        data.spray.solids_fraction = 0;
        data.spray.temperature = table.number(row, "T_liq_C") + 273.15;
        auto const balance = sim::balance(data);
        auto const words =
            fmt::format("{} degC, {} g/s of water: ", table.number(row, "T_in_C"), 1e3 * data.spray.rate);
        verify::absolute("G06", words + "outlet, degC", table.number(row, "T_out_C"),
                         balance.outlet_temperature - 273.15, 0.2);
        verify::relative("G06", words + "relative humidity there", table.number(row, "RH_out"),
                         balance.outlet_relative_humidity, 0.01);
    }
}
}
