// The gas: volume-averaged, low-Mach moist air on the cut cells of a rank.
//
// Stored state is what is conserved: mass, vapour and enthalpy of the gas in each cell (kg, kg, J; voidage and cut
// volume included) and the velocity on the faces. Temperature, mass fraction and density follow from it.
//
// A step is: momentum predictor on the faces (staggered grid, implicit upwind convection and drag); projection onto
// mass fluxes that bring each cell to the mass its equation of state asks for at the end of the step; vapour and heat
// carried by these same fluxes. What is stored changes by fluxes and sources only: conservation does not hang on any
// tolerance. The equations are those of model A: the gas has eps grad p and eps div tau, the granules the rest of both.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"
#include "granum/solve/pressure.hpp"

#include <memory>
#include <optional>

namespace granum::gas
{
using grid::FaceField;
using grid::Field;
using math::Vec3;

//! Gas that enters through the plate (z = 0), uniform over its open area.
struct Inlet
{
    double mass_flow = 0;         //!< kg/s of moist gas, whole plate
    double temperature = 293.15;  //!< K
    double vapour_fraction = 0;   //!< kg/kg moist gas
};

struct Settings
{
    std::optional<Inlet> inlet;  //!< none: a closed or periodic box
    bool outlet = true;          //!< open top at `pressure`
    double pressure = 101325;    //!< Pa
    //! Pressure drop per velocity of what covers the outlet (filter, duct), Pa s/m. It evens out the outflow and keeps
    //! heavier gas from falling in; 0 leaves the top open to still air. Pressures count from the mean below the filter.
    double outlet_resistance = 30;
    Vec3 gravity{0, 0, -9.81};
    std::optional<double> density, viscosity, conductivity;            //!< constant instead of moist air
    double ambient_temperature = 293.15, ambient_vapour_fraction = 0;  //!< of gas drawn in through the outlet
    double tolerance = 1e-6;  //!< of the pressure solve, relative to its right side
};

//! Conserved and derived state. Every field has ghosts.
struct State
{
    Field mass, vapour, enthalpy;  //!< kg, kg, J per cell; enthalpy zero: dry air and liquid water at 0 degC
    FaceField velocity;            //!< interstitial, m/s
    FaceField mass_flux;           //!< through the lower faces in the last step, kg/s
    Field pressure;                //!< Pa above the outlet's, hydrostatic part included
    Field voidage;                 //!< of the open volume
    Field temperature, vapour_fraction, density;  //!< derived: K, kg/kg, kg/m3
};

//! What others do to the gas during one step; cleared by `clear`. Per cell, not per volume.
struct Sources
{
    Field drag_coefficient;              //!< kg/s: sum of the parcels' effective coefficients
    std::array<Field, 3> drag_momentum;  //!< N: sum of coefficient times parcel velocity
    std::array<Field, 3> force;          //!< N, explicit: nozzle, droplets, carried drag
    Field mass, vapour;                  //!< kg/s; gas enters at rest, its momentum belongs into `force`
    Field enthalpy;                      //!< W, explicit, with the enthalpy of what enters
    Field heat_coefficient;              //!< W/K, implicit: Q = heat_value - heat_coefficient (T - 273.15)
    Field heat_value;                    //!< W
    void clear(grid::Grid const& grid);
};

//! What passed the boundaries in the last step (this rank's share), for the ledgers. `in` is the plate; `out` is the
//! top, net of what was drawn in there.
struct Balance
{
    double mass_in = 0, mass_out = 0, vapour_in = 0, vapour_out = 0, enthalpy_in = 0, enthalpy_out = 0;  //!< kg, J
    int pressure_iterations = 0;
    bool pressure_converged = true;
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

    //! Uniform state with the given voidage, temperature and vapour fraction; hydrostatic pressure. The inlet's faces
    //! have the inlet's velocity. Collective.
    State start(Field const& voidage, double temperature, double vapour_fraction, Vec3 velocity) const;

    //! One step: momentum, pressure, vapour, enthalpy. `voidage` is that at the end of the step; `sources` of owned
    //! cells are read. Throws base::NumericsError with field, cell and position where a number is not finite or a cell
    //! runs out of gas. Collective.
    Balance advance(State& state, Sources const& sources, Field const& voidage, double dt);

    //! Step with Courant number `courant` at the largest velocity component, s; infinite for gas at rest. Collective.
    double courant_step(State const& state, double courant) const;

    //! grad p - div tau of the total pressure, Pa/m, and velocity, m/s: means of the cell's faces by FaceWeights,
    //! ghosts filled. A granule of volume V takes the force -V (grad p - div tau) beside its drag. Collective.
    std::array<Field, 3> cell_pressure_gradient(State const& state) const;
    std::array<Field, 3> cell_velocity(State const& state) const;

    //! Temperature that the implicit heat term of the last step was taken at, K: the gas received
    //! heat_value - heat_coefficient (T - 273.15). Differs from State::temperature by the solver's tolerance only.
    Field const& exchanged_temperature() const;

    //! Momentum of the gas on all faces of all ranks, kg m/s. Collective.
    Vec3 momentum(State const& state) const;

    FaceWeights const& weights() const;
    Settings const& settings() const;

    //! @{ What the next step depends on beside the state: the first guess of the pressure's correction (by cell), and
    //! what the pressure solver remembers. Without the latter, or on other ranks, the next step agrees to the solver's
    //! tolerance.
    Field const& correction() const;
    solve::Pressure::Memory const& pressure_memory() const;
    void recall(Field correction, std::optional<solve::Pressure::Memory> memory);
    //! @}

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
