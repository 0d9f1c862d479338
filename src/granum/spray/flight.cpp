#include "granum/spray/flight.hpp"

#include "granum/law/droplet/crust.hpp"
#include "granum/law/droplet/evaporation.hpp"

#include <algorithm>
#include <cmath>

namespace granum::spray
{
namespace air = material;

namespace
{
double capture_efficiency(law::capture::Any const& chosen, double stokes, double reynolds)
{
    return std::visit([=](auto const& l) { return l(law::capture::Flow{stokes, reynolds}); }, chosen);
}

//! Drag relaxation rate of a sphere by Schiller and Naumann, 1/s.
double drag_rate(double diameter, double mass, double slip, Seen const& seen)
{
    double const reynolds = seen.density * slip * diameter / seen.viscosity;
    double const factor = reynolds < 1000 ? 1 + 0.15 * std::pow(reynolds, 0.687) : 0.44 * reynolds / 24;
    return 3 * math::pi * seen.viscosity * diameter * factor / mass;
}

//! Held gas: exact relaxation towards it with gravity. Returns the impulse that the gas received from one droplet.
Vec3 move(Droplet& droplet, double diameter, Seen const& seen, Vec3 const& gravity, double dt)
{
    double const mass = droplet.water + droplet.solute;
    Vec3 const slip = droplet.velocity - seen.gas_velocity;
    double const rate = drag_rate(diameter, mass, math::norm(slip), seen);
    double const x = rate * dt, decay = std::exp(-x), gain = -std::expm1(-x) / rate;
    Vec3 const settled = gravity / rate;  // slip it would settle to
    Vec3 const before = droplet.velocity;
    droplet.velocity = seen.gas_velocity + settled + decay * (slip - settled);
    Vec3 const hop = dt * (seen.gas_velocity + settled) + gain * (slip - settled);
    droplet.position += hop;
    droplet.path += math::norm(hop);
    droplet.age += dt;
    return mass * (before + dt * gravity - droplet.velocity);
}

//! Three standard normal numbers.
Vec3 normals(base::Random& random)
{
    double const x = random.normal(), y = random.normal(), z = random.normal();
    return {x, y, z};
}

//! What a droplet sees of the turbulence, and how long its hops may be for it.
class Fluctuations
{
  public:
    Fluctuations(FlightSettings const& settings, Droplet& droplet, double dt, std::uint32_t step)
        : law_(settings.dispersion),
          on_(!std::holds_alternative<law::dispersion::NoDispersion>(law_)),
          random_(settings.seed, base::Purpose::dispersion, droplet.id, step),
          least_(dt / most_hops)
    {
        // As if it had been in the gas for long.
        if (on_ && droplet.age == 0) droplet.eddy = {normals(random_), 0};
    }

    //! The hop, at most `wanted` s, for which the droplet sees one velocity.
    double hop(Seen const& seen, double wanted) const
    {
        if (!on_ || seen.turbulent_energy <= 0) return wanted;
        double const memory = quarter_of_memory * seen.turbulent_energy / seen.dissipation;
        return std::min(wanted, std::max(memory, least_));
    }
    //! Adds u' to the gas that is seen.
    void add(Seen& seen, Droplet& droplet, double h)
    {
        if (!on_) return;
        law::dispersion::Turbulence const gas{.energy = seen.turbulent_energy,
                                              .dissipation = seen.dissipation,
                                              .gradient = seen.energy_gradient,
                                              .slip = math::norm(seen.gas_velocity - droplet.velocity)};
        seen.gas_velocity += law::dispersion::fluctuation(law_, droplet.eddy, gas, h, normals(random_));
    }

  private:
    static constexpr int most_hops = 50;
    static constexpr double quarter_of_memory = 0.07;  // of k/epsilon

    law::dispersion::Any const& law_;
    bool on_;
    base::Random random_;
    double least_;
};

//! Locks the solids where those at the surface of a droplet that loses `rate` kg/s leave no more room between them.
void lock(Droplet& droplet, Liquid const& liquid, double diameter, double rate)
{
    double const now = droplet.diameter(liquid);
    double const solids = droplet.solute / liquid.solids_density / (math::pi / 6 * now * now * now);
    double const recedes = std::max(0.0, 4 * rate / (math::pi * diameter * air::water_density));  // m2/s
    double const peclet = liquid.solids_diffusivity > 0 ? recedes / (8 * liquid.solids_diffusivity) : 0;
    if (law::droplet::surface_enrichment(peclet) * solids >= liquid.locking) droplet.crust = now;
}

void lose(Losses& losses, Droplet const& droplet, Liquid const& liquid)
{
    losses.solids += droplet.solids();
    losses.water += droplet.liquid_water();
    losses.enthalpy += droplet.enthalpy(liquid);
}
}

namespace
{
//! A melt between solid and liquid keeps its melting point; below and above it relaxes towards the gas and stops there.
Given cool(Droplet& droplet, FlightSettings const& settings, Seen const& seen, double slip, double dt)
{
    Liquid const& liquid = settings.liquid;
    double const before = droplet.enthalpy(liquid), melting = liquid.melting_point;
    law::droplet::Air const gas{seen.temperature, seen.vapour_fraction, settings.pressure};
    auto const heat_at = [&](double temperature) {
        return law::droplet::convection({droplet.diameter(liquid), temperature, 0, slip}, gas);
    };
    double const heat = heat_at(droplet.temperature);
    bool const solid = droplet.molten <= 0, liquefied = droplet.molten >= droplet.solute;
    if (droplet.temperature == melting && !(solid && heat < 0) && !(liquefied && heat > 0)) {
        droplet.molten = std::clamp(droplet.molten + heat * dt / liquid.fusion_heat, 0.0, droplet.solute);
    } else {
        double const capacity = droplet.solute * liquid.solids_heat_capacity;
        double const slope = std::min(0.0, (heat_at(droplet.temperature + 0.05) - heat) / 0.05);
        double const next = droplet.temperature + heat * dt / (capacity - slope * dt);
        droplet.temperature = solid ? std::min(next, melting) : std::max(next, melting);
    }
    return {.vapour = 0, .enthalpy = before - droplet.enthalpy(liquid), .momentum = {}};
}
}

Given evaporate(Droplet& droplet, FlightSettings const& settings, Seen const& seen, double slip, double dt)
{
    Liquid const& liquid = settings.liquid;
    if (liquid.melt()) return cool(droplet, settings, seen, slip, dt);
    double const before = droplet.enthalpy(liquid);
    double const moisture = droplet.water / droplet.solute;
    double const activity =
        law::droplet::water_activity(moisture, liquid.solubility, liquid.molar_mass, liquid.dissociation);
    law::droplet::Air const gas{seen.temperature, seen.vapour_fraction, settings.pressure};
    double const diameter = droplet.diameter(liquid);
    auto const rates_at = [&](double temperature) {
        law::droplet::Drop const drop{diameter, temperature, activity, slip};
        auto rates = law::droplet::evaporation(drop, gas);
        if (droplet.water <= 0) rates.mass = 0;
        if (droplet.crust > 0 && liquid.crust_diffusivity > 0) {
            double const solids = droplet.solute / liquid.solids_density / (math::pi / 6 * std::pow(diameter, 3));
            double const core = law::droplet::wet_core(droplet.water / air::water_density, diameter, 1 - solids);
            rates.mass *= law::droplet::through_crust(rates.transfer, liquid.crust_diffusivity, core);
        }
        return rates;
    };
    auto const rates = rates_at(droplet.temperature);
    auto const warmer = rates_at(droplet.temperature + 0.05);
    // Temperature by one linearised implicit step: small droplets relax faster than dt.
    auto const net = [](law::droplet::Rates const& r, double t) {
        return r.heat - r.mass * air::evaporation_enthalpy(t);
    };
    double const gain = net(rates, droplet.temperature);
    double const slope = std::min(0.0, (net(warmer, droplet.temperature + 0.05) - gain) / 0.05);
    double const capacity = droplet.water * air::heat_capacity_water + droplet.solute * liquid.solids_heat_capacity;
    double const rise = gain * dt / (capacity - slope * dt);
    // The mass leaves at the rate of the temperature in mid-step.
    double const mass_slope = (warmer.mass - rates.mass) / 0.05;
    double const leaving = std::clamp((rates.mass + 0.5 * rise * mass_slope) * dt, -droplet.water, droplet.water);
    double const vapour = droplet.weight * leaving;
    double const enthalpy = vapour * air::vapour_enthalpy(droplet.temperature);
    droplet.water -= leaving;
    droplet.temperature += rise;
    if (liquid.locking > 0 && droplet.crust == 0) lock(droplet, liquid, diameter, leaving / dt);
    // Whatever the droplet's enthalpy changed by, beyond the vapour's, was heat of the gas.
    double const heat = droplet.enthalpy(liquid) - before + enthalpy;
    return {.vapour = vapour, .enthalpy = enthalpy - heat, .momentum = vapour * droplet.velocity};
}

void fly(std::vector<Droplet>& droplets, FlightSettings const& settings, geometry::Chamber const& chamber,
         Surroundings& around, double dt, std::uint32_t step, Outcome& outcome)
{
    Liquid const& liquid = settings.liquid;
    std::vector<Target> targets;
    std::size_t kept = 0;
    for (std::size_t n = 0; n < droplets.size(); ++n) {
        Droplet droplet = droplets[n];
        base::Random random(settings.seed, base::Purpose::capture, droplet.id, step);
        Fluctuations fluctuations(settings, droplet, dt, step);
        double left = dt - droplet.delay;
        droplet.delay = 0;
        bool gone = false;
        while (left > 0 && !gone) {
            Seen seen = around.seen(droplet.position);
            double const fastest = std::max(math::norm(droplet.velocity), math::norm(seen.gas_velocity));
            double const h = fluctuations.hop(seen, std::min(left, settings.longest_hop / std::max(fastest, 1e-3)));
            fluctuations.add(seen, droplet, h);
            double const diameter = droplet.diameter(liquid);
            Vec3 const place = droplet.position;
            double const slip = math::norm(droplet.velocity - seen.gas_velocity);
            Given given = evaporate(droplet, settings, seen, slip, h);
            outcome.evaporated += given.vapour;
            given.momentum += droplet.weight * move(droplet, diameter, seen, settings.gravity, h);
            around.give(place, given);
            left -= h > 0.999999 * left ? left : h;

            if (!chamber.inside(droplet.position) || chamber.parted(place, droplet.position)) {
                lose(droplet.position.z >= chamber.top() ? outcome.overspray : outcome.walls, droplet, liquid);
                gone = true;
            } else if (seen.solids_fraction > 1e-6) {
                around.targets(place, targets);
                double total = 0;
                for (Target& target : targets) {
                    double const speed = math::norm(droplet.velocity - target.velocity);
                    double const stokes =
                        liquid.density * diameter * diameter * speed / (18 * seen.viscosity * target.diameter);
                    double const reynolds = seen.density * speed * target.diameter / seen.viscosity;
                    double const cross = math::pi / 4 * (target.diameter + diameter) * (target.diameter + diameter);
                    target.chance *= cross * speed * capture_efficiency(settings.capture, stokes, reynolds);
                    total += target.chance;
                }
                if (total > 0 && random.uniform() < -std::expm1(-total * h)) {
                    double pick = random.uniform() * total;
                    std::size_t choice = 0;
                    while (choice + 1 < targets.size() && (pick -= targets[choice].chance) > 0) ++choice;
                    outcome.hits.push_back(
                        {droplet, targets[choice].row, math::norm(droplet.velocity - targets[choice].velocity), left});
                    gone = true;
                }
            }
            if (!gone && left > 0 && !around.mine(droplet.position)) {
                // Crosses to a neighbour in mid-step, which flies it in the next step for what is left of this one too.
                droplet.delay = -left;
                left = 0;
            }
        }
        if (gone) continue;
        if (around.mine(droplet.position))
            droplets[kept++] = droplet;
        else
            outcome.leaving.push_back(droplet);
    }
    droplets.resize(kept);
}
}
