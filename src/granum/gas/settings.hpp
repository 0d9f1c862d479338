// What a run says of its gas: properties, where it enters and leaves, what its walls are like.
#pragma once

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
    double mass_flow = 0;         //!< kg/s of moist gas
    double temperature = 293.15;  //!< K
    double vapour_fraction = 0;   //!< kg/kg moist gas
    double tracer_fraction = 0;   //!< kg/kg moist gas
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
    solve::Method pressure_solver = solve::Method::multigrid;
    double tolerance = 1e-6;  //!< of the pressure solve, relative to its right side
};
}
