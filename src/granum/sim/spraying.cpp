// The spray in the simulation: air of the nozzles into the gas, droplets through it and onto granules.
#include "granum/base/error.hpp"
#include "granum/drying/impact.hpp"
#include "granum/math/random_direction.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace granum::sim
{
namespace air = material;
using grid::Index;

namespace
{
constexpr std::uint32_t most_splashes = 3;  // of a droplet, one out of the other
constexpr std::uint32_t most_rounds = 8;    // of flight and impact in a step; what time is left then is let go
constexpr double kept_speed = 0.5;          // of that at impact by what flies on from a granule
}

void Simulation::find_nozzle_cells()
{
    around_ = std::make_unique<DropletSurroundings>(grid_, *mapping_, nozzles_, *partition_, comm_.rank(),
                                                    capture_reach(case_));
    nozzle_weights_.clear();
    for (auto const& nozzle : nozzles_) {
        double const cell = grid::widest_at(lines_, nozzle.position);
        grid::Field share = grid_.make_field();
        double sum = 0;
        grid::for_each_cell(grid_, [&](int i, int j, int k, Index c) {
            share[c] = nozzle.source_weight(grid_.centre(i, j, k), cell) * grid_.open_volume[c] / grid_.volume(i, j, k);
            sum += share[c];
        });
        sum = comm_.sum(sum);
        base::require(sum > 0, "the air of the nozzle at ({}, {}, {}) m meets no open cell", nozzle.position.x,
                      nozzle.position.y, nozzle.position.z);
        for (double& s : share) s /= sum;
        nozzle_weights_.push_back(std::move(share));
    }
}

void Simulation::nozzle_air(double dt)
{
    for (std::size_t n = 0; n < nozzles_.size(); ++n) {
        auto const& nozzle = nozzles_[n];
        double const enthalpy =
            nozzle.air_mass_flow * air::enthalpy(nozzle.air_temperature, nozzle.air_vapour_fraction);
        double const vapour = nozzle.air_mass_flow * nozzle.air_vapour_fraction;
        double share = 0;
        grid::for_each_cell(grid_, [&](int, int, int, Index cell) {
            double const s = nozzle_weights_[n][cell];
            if (s == 0) return;
            share += s;
            sources_.mass[cell] += s * nozzle.air_mass_flow;
            sources_.vapour[cell] += s * vapour;
            sources_.enthalpy[cell] += s * enthalpy;
            for (std::size_t d = 0; d < 3; ++d) sources_.force[d][cell] += s * nozzle.momentum() * nozzle.direction[d];
        });
        in_[1] += share * vapour * dt;
        in_[2] += share * enthalpy * dt;
    }
}

void Simulation::fly_droplets(double dt)
{
    spray::Liquid const& liquid = flight_.liquid;
    for (auto const& nozzle : nozzles_) {
        if (partition_->owner(nozzle.position) != comm_.rank()) continue;
        for (auto& droplet : nozzle.emit(time_, dt, liquid, case_.seed)) {
            mine_.solids += droplet.solids();
            mine_.water += droplet.liquid_water();
            in_[0] += droplet.solids();
            in_[1] += droplet.liquid_water();
            in_[2] += droplet.enthalpy(liquid);
            droplets_.push_back(droplet);
        }
    }
    around_->prepare(*solver_, gas_, granules_, sources_, dt, case_.spray.dispersion != "none");
    spray::Outcome outcome;
    std::vector<spray::Droplet> flying = std::move(droplets_), landed;
    droplets_.clear();
    for (std::uint32_t round = 0; !flying.empty(); ++round) {
        // Each round of a step draws from streams of its own.
        std::uint32_t const stream = static_cast<std::uint32_t>(steps_) + (round << 28);
        spray::fly(flying, flight_, case_.chamber, *around_, dt, stream, outcome);
        droplets_.insert(droplets_.end(), flying.begin(), flying.end());
        flying.clear();
        std::stable_sort(outcome.hits.begin(), outcome.hits.end(),
                         [](auto const& a, auto const& b) { return a.droplet.id < b.droplet.id; });
        for (auto const& hit : outcome.hits)
            if (auto rest = receive(hit, stream)) {
                bool const here = partition_->owner(rest->position) == comm_.rank();
                rest->delay = here && round + 1 < most_rounds ? dt - hit.left : 0;
                (!here ? outcome.leaving : rest->delay > 0 ? flying : droplets_).push_back(*rest);
            }
        outcome.hits.clear();
    }
    mine_.evaporated += outcome.evaporated;
    mine_.walls += outcome.walls.solids;
    mine_.overspray += outcome.overspray.solids;
    for (auto const* losses : {&outcome.walls, &outcome.overspray}) {
        out_[0] += losses->solids;
        out_[1] += losses->water;
        out_[2] += losses->enthalpy;
    }
    exchange_droplets(std::move(outcome.leaving));
}

std::optional<spray::Droplet> Simulation::receive(spray::Hit const& hit, std::uint32_t stream)
{
    auto const& liquid = flight_.liquid;
    auto const& striking = hit.droplet;
    std::size_t const row = hit.row;
    base::Random random(case_.seed, base::Purpose::impact, striking.id, stream);
    double const sine = std::sqrt(random.uniform()), draw = random.uniform();
    auto const fly_on = [&](spray::Droplet& rest) {
        Vec3 const before = rest.velocity;
        rest.velocity = granules_.velocity[row] + kept_speed * hit.speed * math::random_direction(random);
        granules_.velocity[row] += rest.mass() / granules_.mass[row] * (before - rest.velocity);
    };
    // What is dry sticks where it falls on a wet spot only.
    bool const dry = striking.dry(liquid, case_.drying.end_moisture);
    auto const& open = deposits_->on(granules_.id[row]);
    if (dry && draw >= drying::Drying::coverage(open, granules_.count[row], granules_.diameter[row])) {
        ++mine_.rebounds;
        auto rest = striking;
        fly_on(rest);
        return rest;
    }
    law::impact::Impact const impact{liquid.density, liquid.viscosity, liquid.surface_tension,
                                     hit.speed * std::sqrt(1 - sine * sine), striking.diameter(liquid)};
    bool const may_splash = !dry && striking.splashes < most_splashes;
    double const share = may_splash ? flight_.splash.share(impact.mundo(), random.uniform()) : 0;
    auto staying = striking;
    staying.water *= 1 - share, staying.solute *= 1 - share, staying.molten *= 1 - share;
    // The granule gets what the melt is worth when solid at its melting point; the rest comes as it solidifies.
    double const heat = liquid.melt() ? staying.heat_until_solid(liquid) : 0;
    drying::Arrival const arrival{.weight = staying.weight,
                                  .water = staying.water,
                                  .solute = staying.solute,
                                  .diameter = striking.diameter(liquid),
                                  .temperature = staying.temperature,
                                  .enthalpy = staying.enthalpy(liquid) - heat,
                                  .heat = heat,
                                  .age = staying.age,
                                  .path = staying.path,
                                  .position = staying.position,
                                  .velocity = staying.velocity,
                                  .density = liquid.density,
                                  .viscosity = liquid.viscosity,
                                  .surface_tension = liquid.surface_tension,
                                  .contact_angle = liquid.contact_angle,
                                  .sine = sine,
                                  .splashed = share,
                                  .dry = dry,
                                  .draw = case_.drying.merge ? draw : 1};
    drying::Local const local{.gas_temperature = seen_.temperature[row],
                              .gas_humidity = air::loading(seen_.vapour_fraction[row]),
                              .pressure = case_.gas.pressure,
                              .drying_potential = potential_[row],
                              .solids_fraction = seen_.solids_fraction[row],
                              .slip = seen_.slip[row]};
    drying::deposit(granules_, row, *deposits_, arrival, local, time_);
    mine_.deposited += staying.solids();
    mine_.deposited_water += staying.liquid_water();
    ++mine_.hits;
    if (share == 0) return std::nullopt;
    auto rest = striking;
    rest.id += std::uint64_t{++rest.splashes} << 56;
    rest.weight *= flight_.splash.droplets;
    for (double spray::Droplet::*part : {&spray::Droplet::water, &spray::Droplet::solute, &spray::Droplet::molten})
        rest.*part *= share / flight_.splash.droplets;
    fly_on(rest);
    mine_.splashed += rest.solids();
    return rest;
}

void Simulation::exchange_droplets(std::vector<spray::Droplet> leaving)
{
    if (comm_.size() == 1) return;
    // Everybody sees who leaves and keeps what is its own: droplets are few, and any distance may be crossed.
    auto const bytes = std::as_bytes(std::span(leaving));
    auto all = comm_.gather(bytes);
    comm_.broadcast(all);
    for (std::size_t at = 0; at + sizeof(spray::Droplet) <= all.size(); at += sizeof(spray::Droplet)) {
        spray::Droplet droplet;
        std::memcpy(&droplet, all.data() + at, sizeof droplet);
        if (partition_->owner(droplet.position) == comm_.rank()) droplets_.push_back(droplet);
    }
}
}
