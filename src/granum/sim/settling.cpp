// The first seconds, in which the bed is led to the temperature at which the process holds it.
//
// That is not the temperature of the balance's outlet: what evaporates in flight and the atomising air cool the gas
// above the bed, and what is wet on the granules may still grow. A bed takes half a minute to get there by itself.
#include "granum/base/exact_sum.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
namespace
{
constexpr double least = 1.2;    // s: the bed has expanded and the spray has come to it
constexpr double longer = 1.5;   // ratio of the times of two looks
constexpr double enough = 0.02;  // of the water sprayed since the last look, by which what is wet has changed
}

std::array<double, 2> Simulation::bed_temperature() const
{
    std::array<base::ExactSum, 2> sums{};
    for (std::size_t row = 0; row < granules_.owned; ++row) {
        double const capacity = exchange_->heat_capacity(granules_, row);
        sums[0].add(capacity), sums[1].add(capacity * granules_.temperature[row]);
    }
    comm_.sum(sums);
    double const capacity = sums[0].value();
    return {capacity, capacity > 0 ? sums[1].value() / capacity : 0};
}

double Simulation::liquid() const
{
    double sum = 0;
    for (auto const& droplet : droplets_) sum += droplet.liquid_water();
    for (std::size_t row = 0; row < granules_.owned; ++row)
        for (auto const& deposit : deposits_->on(granules_.id[row])) sum += deposit.water;
    return comm_.sum(sum);
}

bool Simulation::look_if_settled()
{
    if (time_ < 0.5 * least || time_ < longer * settling_.since) return false;
    bool const first = settling_.since == 0;
    double const before = settling_.water, sprayed = balance_.water_rate * (time_ - settling_.since);
    settling_.since = time_, settling_.water = deposits_ ? liquid() : 0;
    return !first && time_ >= least && std::abs(settling_.water - before) <= enough * sprayed;
}

void Simulation::settle_bed(double before)
{
    // Where the mean temperature rises or falls, it takes all granules along many times as far, as it would with a
    // response time of a third of the time since the start: a deviation falls with the third power of that time, and
    // what bubbles do to the mean is averaged over ever more of them. Granules keep what they differ by.
    auto const [capacity, mean] = bed_temperature();
    double const moist = material::heat_capacity_air + balance_.outlet_humidity * material::heat_capacity_vapour;
    double const flow = balance_.dry_mass_flow * moist;
    // A response faster than gas takes through the bed, which holds three times the granules' volume, would overshoot.
    double const solids = capacity / (case_.granules.density * case_.granules.heat_capacity);
    double const through = flow > 0 ? 3 * solids * material::density(case_.gas.pressure, mean, 0) * moist / flow : 0;
    double const response = std::max({time_ / 3, least / 30, through});
    double const times = flow > 0 ? std::max(0.0, capacity / flow / response - 1) : 0;
    double const shift = times * (mean - before);
    for (std::size_t const row : mapping_->order()) {
        double const heat = exchange_->heat_capacity(granules_, row) * shift;
        granules_.enthalpy[row] += heat;
        granules_.temperature[row] += shift;
        in_[2] += heat;
        heat_.settling += heat;
    }
    settling_.enough = look_if_settled();
    if (settling_.enough || time_ >= case_.start.settling) settling_.end = time_;
}
}
