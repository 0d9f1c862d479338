// The gas: volume-averaged, low-Mach moist air on the cut cells of a rank.
//
// Stored state is what is conserved: mass, vapour and enthalpy of the gas in each cell (kg, kg, J; voidage and cut
// volume included) and the velocity on the faces. Temperature, mass fraction and density follow from it.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

#include <memory>
#include <optional>

namespace granum::gas
{
using grid::Field;
using grid::FaceField;
using math::Vec3;

//! Gas that enters through the plate (z = 0), uniform over its open area.
struct Inlet
{
    double mass_flow = 0;      //!< kg/s of moist gas, whole plate
    double temperature = 293.15;  //!< K
    double vapour_fraction = 0;   //!< kg/kg moist gas
};

struct Settings
{
    std::optional<Inlet> inlet;     //!< none: a closed or periodic box
    bool outlet = true;             //!< open top at `pressure`
    double pressure = 101325;       //!< Pa
    Vec3 gravity{0, 0, -9.81};
    std::optional<double> density, viscosity;  //!< constant instead of moist air
    double ambient_temperature = 293.15, ambient_vapour_fraction = 0;  //!< of gas drawn in through the outlet
    double tolerance = 1e-8;        //!< of the pressure solve, relative to the first residual
};

//! Conserved and derived state. Every field has ghosts.
struct State
{
    Field mass, vapour, enthalpy;     //!< kg, kg, J per cell; enthalpy zero: dry air and liquid water at 0 degC
    FaceField velocity;               //!< interstitial, m/s
    Field pressure;                   //!< Pa above the outlet's, hydrostatic part included
    Field voidage;                    //!< of the open volume
    Field temperature, vapour_fraction, density;  //!< derived: K, kg/kg, kg/m3
};

//! What others do to the gas during one step; cleared by `clear`. Per cell, not per volume.
struct Sources
{
    Field drag_coefficient;           //!< kg/s: sum of the parcels' effective coefficients
    std::array<Field, 3> drag_momentum;  //!< N: sum of coefficient times parcel velocity
    std::array<Field, 3> force;       //!< N, explicit: nozzle, droplets, carried drag
    Field mass, vapour;               //!< kg/s
    Field enthalpy;                   //!< W, explicit, with the enthalpy of what enters
    Field heat_coefficient;           //!< W/K, implicit: Q = heat_value - heat_coefficient (T - 273.15)
    Field heat_value;                 //!< W
    void clear(grid::Grid const& grid);
};

//! What passed the boundaries in the last step (this rank's share), for the ledgers.
struct Balance
{
    double mass_in = 0, mass_out = 0, vapour_in = 0, vapour_out = 0, enthalpy_in = 0, enthalpy_out = 0;  //!< kg, J
    int pressure_iterations = 0;
};

//! Weights of the lower and upper face of each cell for the cell's mean velocity, by direction: sum to one, boundary
//! and closed faces have none. The same weights spread a cell's force to its faces, so exchange is reciprocal.
struct FaceWeights
{
    std::array<Field, 3> lower, upper;
};

class Solver
{
  public:
    Solver(Settings settings, grid::Grid const& grid, par::Communicator const& comm);
    ~Solver();

    //! Uniform state with the given voidage, temperature and vapour fraction; hydrostatic pressure.
    State start(Field const& voidage, double temperature, double vapour_fraction, Vec3 velocity) const;

    //! One step: momentum, pressure, vapour, enthalpy. `voidage` is that at the end of the step. Collective.
    Balance advance(State& state, Sources const& sources, Field const& voidage, double dt);

    //! Largest stable or accurate step: Courant number `courant` on the present velocities.
    double courant_step(State const& state, double courant) const;

    //! Pressure gradient plus hydrostatic-free viscous part per cell, Pa/m: the mean of the cell's faces by FaceWeights.
    std::array<Field, 3> cell_pressure_gradient(State const& state) const;
    std::array<Field, 3> cell_velocity(State const& state) const;

    FaceWeights const& weights() const;
    Settings const& settings() const;

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
