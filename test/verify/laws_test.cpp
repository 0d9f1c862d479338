// Rows P11, P17 (table) and P19 to P24: the laws as such and the balance, against an independent small program.
#include "granum/law/drag/all.hpp"
#include "granum/law/droplet/evaporation.hpp"
#include "granum/law/heat/all.hpp"
#include "granum/law/layer/growth.hpp"
#include "granum/law/wetting/footprint.hpp"
#include "granum/spray/flight.hpp"
#include "scene/case_text.hpp"
#include "scene/drag_table.hpp"
#include "scene/water_drop.hpp"
#include "table.hpp"

#include <map>

namespace
{
using namespace granum;
using namespace granum::law;
using math::zero_celsius;

TEST(DragLaws, agree_with_the_table)
{
    for (std::size_t n = 0; n < scene::drag_table_laws.size(); ++n) {
        std::string const name = scene::drag_table_laws[n];
        auto const law = *drag::All::make(name);
        double worst = 0;
        for (auto const& row : scene::drag_table)
            worst = std::max(worst, std::abs(drag::force_ratio(law, {1 - row[0], row[1]}) / row[2 + n] - 1));
        verify::below("P11", "drag " + name + ": largest share off, 14 entries", 1e-4, worst);
    }
}

TEST(HeatLaws, agree_with_the_table)
{
    std::vector<std::string> const names{"ranz-marshall", "gunn", "sun"};
    double const rows[][5] = {{1, 0.5, 2.5353, 5.6632, 5.1993},
                              {10, 0.5, 3.6927, 8.3892, 6.8814},
                              {100, 0.5, 7.3527, 17.9838, 15.3122},
                              {50, 0.7, 5.7849, 9.0787, 7.0917},
                              {50, 1, 5.7849, 6.5244, 4.3450}};
    for (std::size_t n = 0; n < names.size(); ++n) {
        auto const law = *heat::All::make(names[n]);
        double worst = 0;
        for (auto const& row : rows)
            worst = std::max(worst, std::abs(heat::nusselt(law, {1 - row[1], row[0], 0.71}) / row[2 + n] - 1));
        verify::below("P17", "Nusselt number " + names[n] + ": largest share off, 5 entries", 1e-4, worst);
    }
}

TEST(Balance, of_the_worked_examples_has_their_drying_potential)
{
    struct Expected
    {
        int number;
        double eta, wet_bulb, outlet;  //!< 1, degC, degC
    };
    for (auto const& row : {Expected{1, 0.71749, 30.8663, 65.610}, Expected{2, 0.43499, 30.8663, 51.519},
                            Expected{3, 0.58389, 26.5031, 45.820}, Expected{4, 0.79107, 30.3651, 80.850}}) {
        auto const file = fmt::format("{}/examples/balance/{}.toml", GRANUM_SOURCE_DIR, row.number);
        auto const ours = sim::balance(sim::read_case(file, sim::Purpose::balance).data);
        auto const name = fmt::format("balance example {}: ", row.number);
        verify::absolute("P19", name + "drying potential", row.eta, ours.eta, 1e-4);
        verify::absolute("P19", name + "wet bulb, degC", row.wet_bulb, ours.wet_bulb - zero_celsius, 1e-3);
        verify::absolute("P19", name + "outlet, degC", row.outlet, ours.outlet_temperature - zero_celsius, 0.02);
    }
}

TEST(WetBulbDrop, settles_where_measured)
{
    auto const settings = scene::water();
    spray::Seen const air{.temperature = 30 + zero_celsius, .vapour_fraction = 0.013135};
    auto drop = scene::drop_of(1e-3, air.temperature, settings);
    for (int step = 0; step < 6000; ++step) spray::evaporate(drop, settings, air, 0, 0.01);
    verify::between("P20", "drop of 1 mm in air of 30 degC, 50 % humidity: steady temperature, degC", 21.5, 22.1,
                    drop.temperature - zero_celsius);
}

TEST(DryingDrop, loses_its_surface_at_the_rate_of_the_d2_law)
{
    auto const settings = scene::water();
    spray::Seen const air{.temperature = 25 + zero_celsius, .vapour_fraction = 0};
    double const diameter = 1.1e-3;
    auto drop = scene::drop_of(diameter, 7.15 + zero_celsius, settings);
    double const step = 0.01, time = 400;
    for (int n = 0; n < std::lround(time / step); ++n) spray::evaporate(drop, settings, air, 0, step);
    double const d = drop.diameter(settings.liquid);
    verify::relative("P21", "drop in dry air of 25 degC: -d(d^2)/dt, m2/s", 1.4328e-9,
                     (diameter * diameter - d * d) / time, 5e-3);
    verify::relative("P21", "drop in dry air of 25 degC: steady temperature, degC", 7.150,
                     drop.temperature - zero_celsius, 5e-3);
}

//! A slab of `phi` solids below z = 0.5 m, made of `sizes` in equal number, in gas that moves with the droplets and
//! takes no water from them.
struct Slab : spray::Surroundings
{
    static constexpr double top = 0.5;  //!< m
    double phi = 0.3, viscosity = 1e-9;
    math::Vec3 velocity{0, 0, -3};
    std::vector<double> sizes{0.6e-3};

    spray::Seen seen(math::Vec3 const& x) const override
    {
        double const temperature = 20 + zero_celsius;
        return {
            .gas_velocity = velocity,
            .temperature = temperature,
            .vapour_fraction = material::fraction(material::saturation_humidity(temperature, math::standard_pressure)),
            .viscosity = viscosity,
            .solids_fraction = x.z < top + 1e-9 ? phi : 0};
    }
    void give(math::Vec3 const&, spray::Given const&) override {}
    bool mine(math::Vec3 const&) const override { return true; }
    void targets(math::Vec3 const&, std::vector<spray::Target>& out) const override
    {
        double volume = 0;
        for (double const d : sizes) volume += math::pi / 6 * d * d * d;
        out.clear();
        for (std::size_t row = 0; row < sizes.size(); ++row)
            out.push_back({.row = row, .chance = phi / volume, .velocity = {}, .diameter = sizes[row]});
    }
};

//! `count` droplets of 0.6 um that enter the slab at 3 m/s; hits after `depth`.
spray::Outcome shower(Slab& slab, int count, double depth, double hop)
{
    auto settings = scene::water();
    settings.liquid.density = 1100;
    settings.capture = capture::Simple{};
    settings.longest_hop = hop;
    geometry::Chamber const chamber{.shape = geometry::Chamber::Shape::revolution, .profile = {{0, 1}, {1, 1}}};
    std::vector<spray::Droplet> droplets;
    for (int n = 0; n < count; ++n) {
        auto droplet = scene::drop_of(0.6e-6, 20 + zero_celsius, settings);
        droplet.id = static_cast<std::uint64_t>(n);
        droplet.position = {0, 0, Slab::top};
        droplet.velocity = slab.velocity;
        droplets.push_back(droplet);
    }
    spray::Outcome outcome;
    spray::fly(droplets, settings, chamber, slab, depth / 3, 0, outcome);
    return outcome;
}

TEST(Slab, catches_droplets_along_their_path_like_a_filter)
{
    Slab slab;
    // Of 0.9 efficiency by the simple law: St / (St + 0.25) = sqrt(0.9).
    double const share = std::sqrt(0.9), stokes = 0.25 * share / (1 - share);
    slab.viscosity = 1100 * 0.6e-6 * 0.6e-6 * 3 / (18 * stokes * 0.6e-3);
    double const free_path = 1.481e-3, hop = 0.05e-3, bin = 0.5e-3;
    int const count = 100000, bins = 20;
    auto const outcome = shower(slab, count, bins * bin, hop);
    std::vector<int> caught(bins);
    double sum = 0;
    for (auto const& hit : outcome.hits) {
        double const depth = Slab::top - hit.droplet.position.z;
        ++caught[static_cast<std::size_t>(std::min(bins - 1.0, (depth - 0.5 * hop) / bin))];
        sum += depth - 0.5 * hop;
    }
    // Mean free path by the likelihood of what was caught and what passed.
    double const passed = count - static_cast<double>(outcome.hits.size());
    verify::relative("P22", "slab of 0.3 solids: mean free path of 1e5 droplets, m", free_path,
                     (sum + passed * bins * bin) / static_cast<double>(outcome.hits.size()), 0.01);
    double chi2 = 0;
    for (int n = 0; n < bins; ++n) {
        double const expected = count * (std::exp(-n * bin / free_path) - std::exp(-(n + 1) * bin / free_path));
        chi2 += std::pow(caught[static_cast<std::size_t>(n)] - expected, 2) / expected;
    }
    double const left = count * std::exp(-bins * bin / free_path);
    chi2 += std::pow(passed - left, 2) / left;
    // 20 degrees of freedom: 45.3 is exceeded by one table in a thousand.
    verify::between("P22", "slab of 0.3 solids: chi-square of the depths, 20 degrees of freedom", 0, 45.3, chi2);
}

TEST(Slab, of_three_sizes_catches_by_their_surface)
{
    Slab slab;
    slab.sizes = {0.4e-3, 0.2e-3, 0.6e-3};
    auto const outcome = shower(slab, 100000, 20e-3, 0.05e-3);
    double const expected[] = {0.2857, 0.0714, 0.6429};
    double chi2 = 0, total = static_cast<double>(outcome.hits.size());
    for (std::size_t size = 0; size < 3; ++size) {
        double count = 0;
        for (auto const& hit : outcome.hits) count += hit.row == size;
        chi2 += std::pow(count - total * expected[size], 2) / (total * expected[size]);
        verify::absolute("P22", fmt::format("share caught by granules of {} mm, by surface", 1e3 * slab.sizes[size]),
                         expected[size], count / total, 4 * std::sqrt(expected[size] * (1 - expected[size]) / total));
    }
    verify::between("P22", "three sizes: chi-square, 2 degrees of freedom", 0, 13.8, chi2);
}

TEST(Cap, has_the_shape_of_the_table)
{
    double const theta = 40 * math::pi / 180, base = wetting::cap_base_radius(40e-6, theta);
    verify::relative("P23", "cap of a 40 um droplet at 40 deg: base radius, um", 38.289, 1e6 * base, 1e-4);
    verify::relative("P23", "cap of a 40 um droplet at 40 deg: height, um", 13.936,
                     1e6 * wetting::cap_height(base, theta), 1e-4);
}

TEST(LayerGrowth, of_a_batch_agrees_with_the_table)
{
    double const solids = 1.2 / 3600 * 0.3 * 3600;
    verify::relative("P24", "1 kg of 0.6 mm after an hour of 1.2 kg/h: diameter, um", 702.069,
                     1e6 * layer::batch_diameter(0.6e-3, 1, 1445, solids, 864), 1e-4);
}
}
