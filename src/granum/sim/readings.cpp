// What the instruments of the plant would show, from the state of all ranks.
#include "granum/sim/build.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::sim
{
namespace air = material;
using grid::Index;

SprayTotals Simulation::totals() const
{
    SprayTotals all = mine_;
    for (auto const& droplet : droplets_) all.in_flight += droplet.solids();
    std::array<double, 10> sums{all.solids,    all.water,      all.deposited,       all.walls,    all.overspray,
                                all.in_flight, all.evaporated, all.deposited_water, all.splashed, all.abraded};
    comm_.sum(sums);
    return {.solids = sums[0],
            .water = sums[1],
            .deposited = sums[2],
            .walls = sums[3],
            .overspray = sums[4],
            .in_flight = sums[5],
            .evaporated = sums[6],
            .deposited_water = sums[7],
            .splashed = sums[8],
            .abraded = sums[9],
            .hits = comm_.sum(all.hits),
            .rebounds = comm_.sum(all.rebounds)};
}

HeatTotals Simulation::heat() const
{
    std::array<double, 7> sums{heat_.contacts, heat_.film,      heat_.wall_contacts, heat_.wall_film,
                               heat_.wall_gas, heat_.radiation, heat_.settling};
    comm_.sum(sums);
    return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6]};
}

Readings Simulation::readings() const
{
    enum
    {
        capacity,
        heat,
        water,
        dry,
        solids_volume,
        solids_area,
        mass,
        mass_height,
        energy,
        out_mass,
        out_vapour,
        out_enthalpy,
        plate_pressure,
        plate_area,
        count
    };
    std::array<base::ExactSum, count> exact;  // of granules: the order in memory and the ranks do not show
    double coldest = 1e9, hottest = 0, highest = 0;
    double const c_dry = case_.granules.heat_capacity;
    for (std::size_t row = 0; row < granules_.owned; ++row) {
        double const z = granules_.position[row].z, d = granules_.real_diameter(row);
        double const volume = granules_.real_count(row) * math::pi / 6 * d * d * d;
        if (granules_.groups.process) {
            double const solid = granules_.core_mass[row] + granules_.layer_mass[row] + granules_.solute[row];
            double const c = solid * c_dry + granules_.water[row] * air::heat_capacity_water;
            exact[capacity].add(c);
            exact[heat].add(c * granules_.temperature[row]);
            exact[water].add(granules_.water[row]);
            exact[dry].add(solid);
            coldest = std::min(coldest, granules_.temperature[row]);
            hottest = std::max(hottest, granules_.temperature[row]);
        }
        exact[solids_volume].add(volume);
        exact[solids_area].add(volume * case_.chamber.area(std::clamp(z, case_.chamber.bottom(), case_.chamber.top())));
        highest = std::max(highest, z - case_.chamber.bottom());
        exact[mass].add(granules_.mass[row]);
        exact[mass_height].add(granules_.mass[row] * (z - case_.chamber.bottom()));
        exact[energy].add(0.5 * granules_.mass[row] * math::norm2(granules_.velocity[row]));
    }
    comm_.sum(exact);
    std::array<double, count> sums{};
    if (has_gas()) {
        sums[out_mass] = last_.mass_out, sums[out_vapour] = last_.vapour_out, sums[out_enthalpy] = last_.enthalpy_out;
        double const g = -case_.gravity.z, top = case_.chamber.top();
        grid::for_each_cell(grid_, [&](int i, int j, int k, Index cell) {
            if (!grid_.open(cell)) return;
            coldest = std::min(coldest, gas_.temperature[cell]);
            hottest = std::max(hottest, gas_.temperature[cell]);
            if (k == 0 && grid_.at_end(2, false)) {
                // Less the weight of the gas column, as a differential pressure gauge beside the bed would read; the
                // lower half of the cell at the plate falls as steeply as what is above it.
                double const column = gas_.density[cell] * g * (top - grid_.axes[2].face(k));
                double const slope =
                    (gas_.pressure[cell] - gas_.pressure[grid_.at(i, j, k + 1)]) / grid_.axes[2].gap(k + 1);
                double const plate = gas_.pressure[cell] + 0.5 * grid_.axes[2].width(k) * slope;
                double const area = grid_.open_area[2][cell];
                sums[plate_area] += area;
                sums[plate_pressure] += area * (plate - column);
            }
        });
    }
    comm_.sum(sums);
    for (std::size_t k = 0; k < count; ++k) sums[k] += exact[k].value();
    Readings r;
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    r.bed_temperature = sums[capacity] > 0 ? sums[heat] / sums[capacity] : unknown;
    r.bed_moisture = sums[dry] > 0 ? sums[water] / sums[dry] : 0;
    r.water_on_granules = sums[water];
    r.kinetic_energy = sums[energy];
    r.coldest = comm_.min(coldest), r.hottest = comm_.max(hottest);
    if (r.coldest > r.hottest) r.coldest = r.hottest = unknown;
    r.height = sums[mass] > 0 ? 2 * sums[mass_height] / sums[mass] : 0;
    r.highest = comm_.max(highest);
    r.outlet_temperature = r.outlet_humidity = r.eta = unknown;  // nothing has left
    if (!has_gas()) return r;
    if (sums[out_mass] > 0) {
        double const w = sums[out_vapour] / sums[out_mass];
        r.outlet_humidity = air::loading(w);
        r.outlet_temperature = air::temperature(sums[out_enthalpy] / sums[out_mass], w);
        double const span = balance_.wet_bulb_humidity - balance_.inlet_humidity;
        if (span > 0) r.eta = (balance_.wet_bulb_humidity - r.outlet_humidity) / span;
    }
    if (sums[plate_area] > 0) r.pressure_drop = sums[plate_pressure] / sums[plate_area];
    if (sums[solids_volume] > 0) {
        double const humidity = std::isfinite(r.outlet_humidity) ? r.outlet_humidity : case_.gas.inlet.humidity;
        double const density = solver_->settings().density
                                   ? *solver_->settings().density
                                   : air::density(case_.gas.pressure, r.bed_temperature, air::fraction(humidity));
        double const area = sums[solids_area] / sums[solids_volume];
        double downward = 0;  // momentum flow of the nozzles' jets, N
        for (auto const& nozzle : nozzles_) downward -= nozzle.momentum() * nozzle.direction.z;
        double const g = -case_.gravity.z;
        r.weight_over_area = ((sums[mass] - density * sums[solids_volume]) * g + downward) / area;
    }
    return r;
}
}
