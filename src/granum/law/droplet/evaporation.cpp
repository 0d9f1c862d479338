#include "granum/law/droplet/evaporation.hpp"

#include "granum/law/heat/ranz_marshall.hpp"
#include "granum/law/vapour/film.hpp"
#include "granum/math/constants.hpp"
#include "granum/math/roots.hpp"

namespace granum::law::droplet
{
namespace
{
//! ln(1 + b) / b, 1 in the limit.
double log_ratio(double b)
{
    return std::abs(b) < 1e-8 ? 1 - 0.5 * b : std::log1p(b) / b;
}

//! Thickening of the film by the outflow, F(B) of Abramzon and Sirignano.
double thickening(double b)
{
    return std::pow(1 + b, 0.7) * log_ratio(b);
}

//! A transfer number with the film thickened by the outflow of number `b`.
double thickened(double still, double b)
{
    return 2 + (still - 2) / thickening(b);
}
}

Rates evaporation(Drop const& drop, Air const& air)
{
    auto const film =
        vapour::film(drop.temperature, drop.water_activity, air.temperature, air.vapour_fraction, air.pressure);
    double const viscosity = material::viscosity(film.temperature);
    double const conductivity = material::conductivity(film.temperature);
    double const reynolds = film.density * std::abs(drop.slip) * drop.diameter / viscosity;
    double const schmidt = viscosity / (film.density * film.diffusivity);
    double const prandtl = viscosity * material::heat_capacity(film.vapour_fraction) / conductivity;
    heat::RanzMarshall const transfer;

    double const driving = film.driving();
    double const sherwood = thickened(transfer({0, reynolds, schmidt}), std::expm1(driving));
    double const mass = math::pi * drop.diameter * film.density * film.diffusivity * sherwood * driving;

    // The number of heat depends on itself through the film's thickness: a contraction, since the outflow is weak.
    double const still = transfer({0, reynolds, prandtl});
    double const sensible = mass * material::heat_capacity_vapour / (math::pi * drop.diameter * conductivity);
    double nusselt = still, outflow = 0;
    for (int iteration = 0; iteration < 20; ++iteration) {
        outflow = std::expm1(sensible / nusselt);
        double const next = thickened(still, outflow);
        bool const settled = std::abs(next - nusselt) < 1e-12 * nusselt;
        nusselt = next;
        if (settled) break;
    }
    double const heat =
        math::pi * drop.diameter * conductivity * nusselt * (air.temperature - drop.temperature) * log_ratio(outflow);
    return {mass, heat, sherwood * film.diffusivity};
}

double convection(Drop const& drop, Air const& air)
{
    double const temperature = drop.temperature + (air.temperature - drop.temperature) / 3;
    double const viscosity = material::viscosity(temperature), conductivity = material::conductivity(temperature);
    double const density = material::density(air.pressure, temperature, air.vapour_fraction);
    double const prandtl = viscosity * material::heat_capacity(air.vapour_fraction) / conductivity;
    double const reynolds = density * std::abs(drop.slip) * drop.diameter / viscosity;
    double const nusselt = heat::RanzMarshall{}({0, reynolds, prandtl});
    return math::pi * drop.diameter * conductivity * nusselt * (air.temperature - drop.temperature);
}

double equilibrium_temperature(Drop drop, Air const& air)
{
    auto const surplus = [&](double temperature) {
        drop.temperature = temperature;
        auto const rates = evaporation(drop, air);
        return rates.heat - rates.mass * material::evaporation_enthalpy(temperature);
    };
    // Air above saturation warms the drop, so the upper end may lie above the air; at boiling all heat is spent.
    double const high = surplus(air.temperature) > 0 ? std::max(air.temperature, 373.15) : air.temperature;
    return math::brent_root(surplus, std::min(193.15, air.temperature - 1), high, 1e-9);
}

double water_activity(double moisture, double solubility, double molar_mass, double dissociation)
{
    if (solubility <= 0) return 1;
    double const dissolved = std::max(moisture, 1 / solubility);
    return 1 / (1 + dissociation * material::molar_mass_water / (molar_mass * dissolved));
}
}
