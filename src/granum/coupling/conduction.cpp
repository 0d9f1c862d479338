#include "granum/coupling/conduction.hpp"

#include "granum/base/error.hpp"
#include "granum/law/conduction/softened.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

//! Of two materials, Pa: 1 / E* = (1 - nu^2) / E of one + that of the other; a rigid one adds nothing. 0: unknown.
double effective_modulus(Conductor const& one, Conductor const& other, double Conductor::*modulus)
{
    auto const yields = [&](Conductor const& m) {
        return m.rigid ? 0 : (1 - m.poisson_ratio * m.poisson_ratio) / m.*modulus;
    };
    for (auto const* m : {&one, &other})
        if (!m->rigid && !(m->*modulus > 0)) return 0;
    double const sum = yields(one) + yields(other);
    return sum > 0 ? 1 / sum : 0;
}
}

//! A way between two granules, or from a granule to a wall.
struct Conduction::Link
{
    std::uint32_t low, high;  // rows; of a wall both are the granule
    bool wall;
    double outside;        // temperature of the wall, K
    double contact, film;  // W/K
    double rounder;        // 1.5 * 2^52 times the quantum, J

    double conductance() const { return contact + film; }
};

Conduction::Conduction(Paths paths, par::Communicator const& comm) : paths_(std::move(paths)), comm_(comm)
{
    touches_ =
        !std::holds_alternative<law::conduction::NoConduction>(paths_.contact) &&
        std::any_of(paths_.materials.begin(), paths_.materials.end(), [](auto const& m) { return m.conductivity > 0; });
    films_ = !std::holds_alternative<law::film::NoFilm>(paths_.film);
}

double Conduction::real_overlap(dem::Contact const& contact, Conductor const& one, Conductor const& other) const
{
    double const modulus = effective_modulus(one, other, &Conductor::youngs_modulus);
    if (modulus == 0 || contact.overlap <= 0) return contact.overlap;
    return law::conduction::overlap_at(contact.elastic_force, contact.reduced_radius, modulus);
}

double Conduction::through_contact(dem::Contact const& contact, Conductor const& one, Conductor const& other) const
{
    double const overlap = real_overlap(contact, one, other);
    double const circle = law::conduction::circle(paths_.contact, {contact.reduced_radius, std::max(overlap, 0.0)});
    double const conductance = law::conduction::conductance(circle, one.conductivity, other.conductivity);
    if (!paths_.collisions) return conductance;
    double const soft = effective_modulus(one, other, &Conductor::softened_modulus);
    double const real = effective_modulus(one, other, &Conductor::youngs_modulus);
    return soft > 0 && real > 0 ? conductance * law::conduction::short_contact_factor(soft, real) : conductance;
}

double Conduction::through_film(double radius, double other, double gap, double temperature) const
{
    law::film::Pair const pair{
        .radius = radius, .other = other, .gap = gap, .lens = paths_.lens, .shortest = paths_.shortest};
    return law::film::conductance(paths_.film, pair, paths_.gas.value_or(material::conductivity(temperature)));
}

std::vector<Conduction::Link> Conduction::links(dem::Engine const& engine, particle::Store const& granules,
                                                std::span<double const> capacities) const
{
    std::vector<double> own(granules.owned);
    auto const known = [&](auto const& column) {
        for (std::size_t row = 0; row < granules.owned; ++row) own[row] = static_cast<double>(column[row]);
        return engine.known_here(own);
    };
    auto const material = known(granules.material), temperature = known(granules.temperature);
    auto const radius = known(granules.radius);
    double largest = 0;
    for (double const r : radius) largest = std::max(largest, r);
    auto const made_of = [&](double number) -> Conductor const& {
        return paths_.materials[static_cast<std::size_t>(number)];
    };

    std::vector<Link> out;
    for (auto const& contact : engine.contacts(std::min(reach(largest), engine.settings().sight))) {
        auto const [low, high] = contact.rows;
        Link link{.low = low, .high = high, .wall = contact.wall, .outside = 0, .contact = 0, .film = 0, .rounder = 0};
        double other = std::numeric_limits<double>::infinity(), between = temperature[low];
        Conductor const* partner = nullptr;
        if (contact.wall) {
            auto const& wall = contact.high < paths_.walls.size() ? paths_.walls[contact.high] : std::nullopt;
            if (!wall) continue;
            partner = &made_of(engine.settings().walls[contact.high].material);
            link.outside = *wall;
            between = 0.5 * (temperature[low] + *wall);
        } else {
            partner = &made_of(material[high]);
            other = radius[high];
            between = 0.5 * (temperature[low] + temperature[high]);
        }
        Conductor const& one = made_of(material[low]);
        if (touches_ && contact.overlap > 0) link.contact = through_contact(contact, one, *partner);
        if (films_) link.film = through_film(radius[low], other, -real_overlap(contact, one, *partner), between);
        if (link.conductance() == 0) continue;
        int const kelvin = std::ilogb(std::min(capacities[low], capacities[high]));
        link.rounder = 1.5 * std::ldexp(1.0, 52 + kelvin + quantum_exponent);
        out.push_back(link);
    }
    return out;
}

PassedHeat Conduction::pass(dem::Engine const& engine, particle::Store& granules, std::span<double const> capacity,
                            double dt) const
{
    PassedHeat passed;
    if (!passes_heat()) return passed;
    std::size_t const owned = granules.owned;
    auto const capacities = engine.known_here(capacity);
    auto const ways = links(engine, granules, capacities);

    std::vector<double> rate(capacities.size(), 0.0);  // W/K of all links
    for (auto const& link : ways) {
        rate[link.low] += link.conductance();
        if (!link.wall) rate[link.high] += link.conductance();
    }
    double fastest = 0;  // 1/s
    for (std::size_t row = 0; row < owned; ++row) fastest = std::max(fastest, rate[row] / capacity[row]);
    double const needed = std::ceil(comm_.max(fastest) * dt / longest_way);
    base::require(
        needed <= most_parts,
        "heat between granules that touch would need {:.3g} parts of a step of {:.3g} s: a granule follows its "
        "neighbours within {:.3g} s",
        needed, dt, dt / needed / longest_way);
    passed.parts = std::max(1, static_cast<int>(needed));

    std::vector<double> temperature(owned), gained(capacities.size());
    for (int part = 0; part < passed.parts; ++part) {
        for (std::size_t row = 0; row < owned; ++row) temperature[row] = granules.temperature[row];
        auto const now = engine.known_here(temperature);
        std::fill(gained.begin(), gained.end(), 0.0);
        for (auto const& link : ways) {
            double const there = link.wall ? link.outside : now[link.high];
            double const flows = link.conductance() * (there - now[link.low]) * (dt / passed.parts);
            double const rounded = (flows + link.rounder) - link.rounder;
            double const of_contact = link.contact / link.conductance() * rounded;
            gained[link.low] += rounded;
            if (link.wall) {
                passed.wall_contacts -= of_contact;
                passed.wall_film -= rounded - of_contact;
                continue;
            }
            gained[link.high] -= rounded;
            // Each rank counts the side that it owns.
            double const mine = 0.5 * ((link.low < owned) + (link.high < owned));
            passed.contacts += mine * std::abs(of_contact);
            passed.film += mine * std::abs(rounded - of_contact);
        }
        for (std::size_t row = 0; row < owned; ++row) {
            if (gained[row] == 0) continue;
            granules.enthalpy[row] += gained[row];
            granules.temperature[row] = math::zero_celsius + granules.enthalpy[row] / capacity[row];
        }
    }
    return passed;
}
}
