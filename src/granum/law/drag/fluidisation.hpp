// Two speeds that follow from a drag law and weight alone: where a bed begins to float, and how fast one sphere falls.
#pragma once

#include "granum/law/drag/flow.hpp"
#include "granum/law/drag/schiller_naumann.hpp"
#include "granum/math/constants.hpp"
#include "granum/math/roots.hpp"

namespace granum::law::drag
{
//! The superficial speed, m/s, at which 3 pi mu d U F(phi, Re(U)) = `force` N on one sphere of `diameter` m.
template <class Law>
double superficial_speed(Law const& law, double force, double solid_fraction, double diameter, double gas_density,
                         double viscosity)
{
    double const stokes = 3 * math::pi * viscosity * diameter;
    auto const excess = [&](double speed) {
        return stokes * speed * law(Flow{solid_fraction, gas_density * speed * diameter / viscosity}) - force;
    };
    double high = force / stokes;
    while (excess(high) < 0) high *= 2;
    return math::brent_root(excess, 0, high, 1e-12 * high);
}

//! Superficial speed, m/s, at which the bed of `voidage` is carried: drag / eps = (rho_p - rho) g V on every granule
//! (the pressure gradient carries the rest). Diameter m, densities kg/m3, viscosity Pa s; the granule is the denser.
template <class Law>
double minimum_fluidisation_velocity(Law const& law, double diameter, double density, double gas_density,
                                     double viscosity, double voidage, double gravity = math::standard_gravity)
{
    double const volume = math::pi * diameter * diameter * diameter / 6;
    double const force = voidage * (density - gas_density) * gravity * volume;
    return superficial_speed(law, force, 1 - voidage, diameter, gas_density, viscosity);
}

//! Archimedes number of a granule: its buoyant weight over the viscous forces.
inline double archimedes(double diameter, double density, double gas_density, double viscosity,
                         double gravity = math::standard_gravity)
{
    return diameter * diameter * diameter * gas_density * (density - gas_density) * gravity / (viscosity * viscosity);
}

//! Superficial speed, m/s, at which a bed of unknown voidage begins to float. Source: Wen, Yu, AIChE J. 12 (1966) 610
//! (recalled).
inline double wen_yu_fluidisation_velocity(double diameter, double density, double gas_density, double viscosity,
                                           double gravity = math::standard_gravity)
{
    double const number = archimedes(diameter, density, gas_density, viscosity, gravity);
    return (std::sqrt(33.7 * 33.7 + 0.0408 * number) - 33.7) * viscosity / (gas_density * diameter);
}

//! Speed, m/s, of one sphere that falls steadily through a gas at rest, by the drag of Schiller and Naumann.
inline double terminal_velocity(double diameter, double density, double gas_density, double viscosity,
                                double gravity = math::standard_gravity)
{
    double const volume = math::pi * diameter * diameter * diameter / 6;
    return superficial_speed(SchillerNaumann{}, (density - gas_density) * gravity * volume, 0, diameter, gas_density,
                             viscosity);
}
}
