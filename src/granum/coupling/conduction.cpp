#include "granum/coupling/conduction.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::coupling
{
namespace
{
// Share of the way to its neighbours' temperature that a granule may go in one part of the interval.
constexpr double longest_way = 0.1;
constexpr double most_parts = 10000;

// The share of a kelvin of the smaller partner to which heat is rounded, as a power of two: sums of such multiples are
// exact up to two thousand kelvin.
constexpr int quantum_exponent = -41;

struct Link
{
    std::uint32_t low, high;  // rows
    double conductance;       // W/K
    double rounder;           // 1.5 * 2^52 times the quantum, J
};
}

Conduction::Conduction(law::conduction::Any law, std::vector<Conductor> materials, par::Communicator const& comm)
    : law_(std::move(law)), materials_(std::move(materials)), comm_(comm)
{
}

bool Conduction::passes_heat() const
{
    return !std::holds_alternative<law::conduction::NoConduction>(law_) &&
           std::any_of(materials_.begin(), materials_.end(), [](auto const& m) { return m.conductivity > 0; });
}

double Conduction::conductance(dem::Contact const& contact, Conductor const& one, Conductor const& other) const
{
    double overlap = contact.overlap;
    if (one.youngs_modulus > 0 && other.youngs_modulus > 0) {
        auto const yields = [](Conductor const& m) {
            return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
        };
        overlap = law::conduction::overlap_at(contact.elastic_force, contact.reduced_radius,
                                              1 / (yields(one) + yields(other)));
    }
    double const circle = law::conduction::circle(law_, {contact.reduced_radius, std::max(overlap, 0.0)});
    return law::conduction::conductance(circle, one.conductivity, other.conductivity);
}

int Conduction::pass(dem::Engine const& engine, particle::Store& granules, std::span<double const> capacity,
                     double dt) const
{
    if (!passes_heat()) return 0;
    std::size_t const owned = granules.owned;
    std::vector<double> material(owned);
    for (std::size_t row = 0; row < owned; ++row) material[row] = granules.material[row];
    auto const all_materials = engine.known_here(material);
    auto const all_capacities = engine.known_here(capacity);

    std::vector<Link> links;
    std::vector<double> rate(all_capacities.size(), 0.0);  // W/K of all contacts
    for (auto const& contact : engine.contacts()) {
        if (contact.wall) continue;
        auto const [low, high] = contact.rows;
        double const between = conductance(contact, materials_[static_cast<std::size_t>(all_materials[low])],
                                           materials_[static_cast<std::size_t>(all_materials[high])]);
        if (between == 0) continue;
        rate[low] += between, rate[high] += between;
        int const kelvin = std::ilogb(std::min(all_capacities[low], all_capacities[high]));
        links.push_back({low, high, between, 1.5 * std::ldexp(1.0, 52 + kelvin + quantum_exponent)});
    }
    double fastest = 0;  // 1/s
    for (std::size_t row = 0; row < owned; ++row) fastest = std::max(fastest, rate[row] / capacity[row]);
    double const needed = std::ceil(comm_.max(fastest) * dt / longest_way);
    base::require(
        needed <= most_parts,
        "heat between granules that touch would need {:.3g} parts of a step of {:.3g} s: a granule follows its "
        "neighbours within {:.3g} s",
        needed, dt, dt / needed / longest_way);
    int const parts = std::max(1, static_cast<int>(needed));

    std::vector<double> temperature(owned), gained(all_capacities.size());
    for (int part = 0; part < parts; ++part) {
        for (std::size_t row = 0; row < owned; ++row) temperature[row] = granules.temperature[row];
        auto const now = engine.known_here(temperature);
        std::fill(gained.begin(), gained.end(), 0.0);
        for (auto const& link : links) {
            double const passed = link.conductance * (now[link.high] - now[link.low]) * (dt / parts);
            double const rounded = (passed + link.rounder) - link.rounder;
            gained[link.low] += rounded;
            gained[link.high] -= rounded;
        }
        for (std::size_t row = 0; row < owned; ++row) {
            if (gained[row] == 0) continue;
            granules.enthalpy[row] += gained[row];
            granules.temperature[row] = math::zero_celsius + granules.enthalpy[row] / capacity[row];
        }
    }
    return parts;
}
}
