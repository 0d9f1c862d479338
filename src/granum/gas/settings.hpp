// What a run says of its gas: properties, where it enters and leaves, what its walls are like.
#pragma once

#include "granum/law/turbulence/all.hpp"
#include "granum/law/turbulence/wall.hpp"
#include "granum/law/viscosity/all.hpp"
#include "granum/math/vec3.hpp"
#include "granum/solve/pressure.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace granum::gas
{
using math::Vec3;

//! How pressure and stress are shared between gas and granules (Zhou et al., J. Fluid Mech. 661 (2010) 482).
enum class Model
{
    a,  //!< eps grad p and eps div tau on the gas, the rest on the granules
    b   //!< all of both on the gas; granules feel the hydrostatic pressure only
};

enum class Compressibility
{
    constant,  //!< Settings::density
    low_mach,  //!< ideal gas at one pressure: that of the outlet, or of a closed box what its mass and heat make it
    full       //!< ideal gas at the pressure of each cell
};

//! A part of an end of the domain.
struct Opening
{
    std::string name;
    std::size_t direction = 2;  //!< across which it lies
    bool upper = false;         //!< at the upper end of the domain in this direction
    //! Integral over a rectangle of that end of what is relative to the rest of the opening, m2: of an outlet its area;
    //! of an inlet the mass flow per area, of any scale. Nothing: the whole end, evenly.
    std::function<double(Vec3 const& low, Vec3 const& high)> share;
};

struct Inlet
{
    double mass_flow = 0;                     //!< kg/s of moist gas
    double temperature = 293.15;              //!< K
    double vapour_fraction = 0;               //!< kg/kg moist gas
    double tracer_fraction = 0;               //!< kg/kg moist gas
    double turbulence_intensity = 0.05;       //!< root mean square of a fluctuation over the superficial velocity
    std::optional<double> turbulence_length;  //!< of its eddies, m; none: 0.07 diameters of a disc of the inlet's area
    Opening at{};
};

struct Outlet
{
    double pressure = 0;  //!< above Settings::pressure, Pa
    //! Pressure drop per velocity of what covers it (filter, duct), Pa s/m. It evens out the outflow and keeps heavier
    //! gas from falling in; 0 leaves it open to still air. Pressures count from the mean below the filter.
    double resistance = 30;
    double ambient_temperature = 293.15, ambient_vapour_fraction = 0,
           ambient_tracer_fraction = 0;  //!< of what is drawn in
    Opening at{.direction = 2, .upper = true};
};

struct Wall
{
    bool slip = false;                  //!< no friction
    Vec3 velocity{};                    //!< along the wall, m/s
    std::optional<double> temperature;  //!< K; none: by loss
    double loss = 0;                    //!< W/m2/K to `outside`; 0: adiabatic
    double outside = 293.15;            //!< K
};

//! A further component of the gas that nothing takes up. Without a molar mass it does not change the density.
struct Tracer
{
    double diffusivity = 2e-5;  //!< m2/s
    std::optional<double> molar_mass;
};

//! How viscosity depends on the rate of shear: what comes beside the viscosity at rest.
struct Thinning
{
    law::viscosity::Any law{};
    double infinite = 0;  //!< Pa s
    double time = 0;      //!< s
    double exponent = 1;
};

//! What granules do to turbulence (after Crowe, recalled): where they are, k changes per volume by the sum of
//! beta (wake |u - v|^2 - 2 k T_p / (T + T_p)), T = lagrangian k/epsilon, T_p their time of relaxation.
struct GranuleTurbulence
{
    bool on = false;
    double wake = 0;            //!< share of the work of drag that becomes k
    double lagrangian = 0.3;    //!< 0.2 to 0.32 (recalled)
    double rate = 1.5;          //!< C_3 of the dissipation's equation, 1.2 to 1.8 (recalled)
    double solids_density = 0;  //!< kg/m3
};

struct Turbulence
{
    law::turbulence::Any model{};
    law::turbulence::WallLaw wall{};
    double prandtl = 0.85, schmidt = 0.85;  //!< of the eddies: 0.7 to 0.9
    double dense = 0.7, free = 0.95;  //!< voidages below which there is no eddy viscosity, and beyond it the whole
    std::optional<double> energy;     //!< k at the start, m2/s2; none: that of the inlet with most, or 1e-4
    std::optional<double> length;     //!< of eddies at the start, m; none: 0.07 of the narrowest side
    GranuleTurbulence granules{};
};

struct Settings
{
    std::vector<Inlet> inlets;
    std::vector<Outlet> outlets{Outlet{}};
    std::vector<Wall> walls{Wall{}};
    //! Which of `walls` a point of a wall belongs to. Nothing: the first.
    std::function<std::size_t(Vec3 const&)> wall_at;

    Model model = Model::a;
    Compressibility compressibility = Compressibility::low_mach;
    bool second_order = true;  //!< convection: bounded of second order, or upwind of first

    double pressure = 101325;  //!< Pa, absolute, where pressures count from
    Vec3 gravity{0, 0, -9.81};
    Vec3 push{};                                          //!< force on the gas per volume, N/m3
    std::optional<double> density;                        //!< constant, kg/m3
    double expansion = 0;                                 //!< of a constant density in the weight (Boussinesq), 1/K
    double expansion_temperature = 293.15;                //!< where the density is the given one, K
    std::optional<double> viscosity, conductivity;        //!< constant instead of those of moist air
    std::optional<double> diffusivity;                    //!< of vapour
    std::optional<double> molar_mass, vapour_molar_mass;  //!< kg/mol, instead of those of air and water
    std::optional<Tracer> tracer;
    Turbulence turbulence{};
    Thinning thinning{};
    solve::Method pressure_solver = solve::Method::multigrid;
    double tolerance = 1e-6;  //!< of the pressure solve, relative to its right side
};
}
